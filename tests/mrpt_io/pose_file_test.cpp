// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/PoseTrack.h"
#include "log_objects.h"

namespace hoctomap {
namespace {

using test::errorOf;

std::string errorFor(const std::string& content) {
  const test::Folder folder;
  const auto file = folder.write("poses.txt", content);
  return errorOf<InputError>([&] { (void)readPoseFile(file); });
}

TEST(PoseFile, ReadsBothFormatsToTheSamePoses) {
  const test::Folder folder;
  const auto mrpt =
      folder.write("mrpt.txt", "% t x y z yaw pitch roll\n1.5 1 2 3 0.5 0 0\n2.5 1 2 4 0.5 0 0\n");
  // half of 0.5 rad: sin 0.25, cos 0.25
  const auto tum = folder.write("tum.txt",
                                "# TUM\n\n1.5 1 2 3 0 0 0.24740395925452294 0.9689124217106447\r\n"
                                "2.5\t1 2 4 0 0 0.24740395925452294 0.9689124217106447");
  const PoseTrack a = readPoseFile(mrpt);
  const PoseTrack b = readPoseFile(tum);
  ASSERT_EQ(a.size(), 2U);
  ASSERT_EQ(b.size(), 2U);
  for (const double t : {1.5, 2.0, 2.5}) {
    const Eigen::Matrix4d expected = toIsometry(Pose(1, 2, 3 + (t - 1.5), 0.5, 0, 0)).matrix();
    EXPECT_LT((toIsometry(*a.at(t, 1.0)).matrix() - expected).norm(), 1e-12);
    EXPECT_LT((toIsometry(*b.at(t, 1.0)).matrix() - expected).norm(), 1e-12);
  }
}

TEST(PoseFile, EveryDefectIsNamedWithItsLine) {
  const std::string good = "# comment\n1 0 0 0 0 0 0\n";
  const struct {
    const char* line;
    const char* expected;
  } defects[] = {
      {"2 0 0 0 0 0", "columns"},
      {"2 0 0 0 0 0 0 1", "columns"},  // after lines of 7
      {"2 0 0 0 0 0 0 0 0", "columns"},
      {"2 0,5 0 0 0 0 0", "decimal point"},
      {"2, 0, 0, 0, 0, 0, 0", "decimal point"},
      {"2 nan 0 0 0 0 0", "not finite"},
      {"2 0 0 0 inf 0 0", "not finite"},
      {"2 0 0 0 1e999 0 0", "not a number"},
      {"2 0 0 0 12junk 0 0", "not a number"},
      {"0.5 0 0 0 0 0 0", "ascending"},
      {"1 0 0 0 0.1 0 0", "same time"},
  };
  for (const auto& defect : defects) {
    const std::string error = errorFor(good + defect.line + "\n");
    EXPECT_NE(error.find("poses.txt:3: "), std::string::npos) << error;
    EXPECT_NE(error.find(defect.expected), std::string::npos) << error;
  }
  EXPECT_NE(errorFor("1 0 0 0 0 0 0 0\n").find(":1: the quaternion"), std::string::npos);
  EXPECT_NE(errorFor("1 0 0 0 0 0 0 2\n").find(":1: the quaternion"), std::string::npos);
  EXPECT_NE(errorFor("# nothing\n").find("no pose"), std::string::npos);
}

TEST(PoseFile, ControlCharactersAreEscaped) {
  const std::string error = errorFor("1 \x1b[31m 0 0 0 0 0\n");
  EXPECT_EQ(error.find('\x1b'), std::string::npos);
  EXPECT_NE(error.find("\\x1b"), std::string::npos);
}

TEST(PoseFile, MissingAndSpecialFilesAreInputErrors) {
  EXPECT_THROW((void)readPoseFile("/no/such/file"), InputError);
  EXPECT_THROW((void)readPoseFile("/"), InputError);
  EXPECT_THROW((void)readPoseFile("/dev/null"), InputError);
}

}  // namespace
}  // namespace hoctomap
