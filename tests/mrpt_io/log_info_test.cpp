// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/mrpt_io/LogInfo.h"
#include "log_objects.h"

namespace hoctomap {
namespace {

LogInfo infoOf(const std::string& bytes) {
  const test::Folder folder;
  ReadProgress progress;
  return describeLog(test::optionsFor(folder.write("log.rawlog", bytes)), progress);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(LogInfo, TellsSensorsPosesAndThatItCanBeBuilt) {
  const LogInfo info = infoOf(test::gz(test::sweep(3) + test::imuObject(1.0)));
  EXPECT_FALSE(info.damaged);
  EXPECT_TRUE(has(info.text, "scans:    3 over 2.000 s")) << info.text;
  EXPECT_TRUE(has(info.text, "'RGBD': 3 x CObservation3DRangeScan, 8 x 6")) << info.text;
  EXPECT_TRUE(has(info.text, "(no 3D points: ignored)"));
  EXPECT_TRUE(has(info.text, "can be built: yes, with robot poses 'groundtruth'")) << info.text;
  EXPECT_TRUE(has(info.json, "\"buildable\": true"));
}

TEST(LogInfo, TellsWhyNotAndWhatToDo) {
  const LogInfo info = infoOf(test::depthObject({}));
  EXPECT_FALSE(info.damaged);
  EXPECT_TRUE(has(info.json, "\"buildable\": false"));
  EXPECT_TRUE(has(info.text, "--poses identity")) << info.text;
}

TEST(LogInfo, TellsDamageAndWhatStandsBeforeIt) {
  const LogInfo info = infoOf(test::sweep(3) + "junk");
  EXPECT_TRUE(info.damaged);
  EXPECT_TRUE(has(info.json, "\"scans\": 3"));
  EXPECT_TRUE(has(info.text, "object 6")) << info.text;
  EXPECT_TRUE(has(info.text, "--salvage"));
}

TEST(LogInfo, AMissingLogIsAnInputError) {
  ReadProgress progress;
  EXPECT_THROW((void)describeLog(test::optionsFor("/no/such.rawlog"), progress), InputError);
}

}  // namespace
}  // namespace hoctomap
