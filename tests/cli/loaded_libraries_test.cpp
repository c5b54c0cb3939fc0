// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "Program.h"

namespace hoctomap {
namespace {

/// What the dynamic linker says it loads for a command, of this program and of those that it becomes or
/// starts.
std::string loadedBy(const std::vector<std::string>& arguments) {
  return test::runProgram(HOCTOMAP_PROGRAM, arguments,
                          {{"HOCTOMAP_MRPT", HOCTOMAP_HELPER}, {"LD_DEBUG", "libs"}})
      .err;
}

TEST(LoadedLibraries, AreThoseOfTheCommand) {
  const test::TemporaryFolder folder;
  const std::string asking = loadedBy({"verify", folder / "no-map"});
  EXPECT_NE(asking.find("liboctomap"), std::string::npos);
  for (const char* library : {"libembree", "libassimp", "libmrpt-obs", "libmrpt-maps", "libmrpt-opengl",
                              "libmrpt-img", "libopencv", "libOpen3D"})
    EXPECT_EQ(asking.find(library), std::string::npos) << library;

  const std::string simulating = loadedBy({"simulate", "-c", folder / "no-scene", "-o", folder / "log"});
  EXPECT_NE(simulating.find("libembree"), std::string::npos);
  EXPECT_EQ(simulating.find("libopencv"), std::string::npos);
}

}  // namespace
}  // namespace hoctomap
