// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/PipeSource.h"

namespace hoctomap {
namespace {

using Stream = ChildProcess::Stream;

ChildProcess::Options shell(const std::string& script) {
  return {.program = "/bin/sh", .arguments = {"-c", script}, .output = Stream::pipe};
}

std::string readToEnd(int fd) {
  std::string text;
  char buffer[256];
  for (ssize_t n = 0; (n = ::read(fd, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  return text;
}

/// A folder for one test, removed behind it.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "hoctomap_XXXXXX").string();
    path = ::mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
};

/// A stand-in for the helper: a script named by $HOCTOMAP_MRPT for the time of one test.
class FakeHelper {
 public:
  explicit FakeHelper(const std::string& script) {
    const auto file = folder_.path / "helper";
    std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    ::setenv("HOCTOMAP_MRPT", file.c_str(), 1);
  }
  ~FakeHelper() { ::unsetenv("HOCTOMAP_MRPT"); }

 private:
  Folder folder_;
};

TEST(ChildProcess, PassesArgumentsAndReturnsItsExitCode) {
  ChildProcess child({.program = "/bin/sh",
                      .arguments = {"-c", "printf '%s|%s' \"$1\" \"$2\"; exit 7", "sh", "a b", "--x='\"$"},
                      .output = Stream::pipe});
  EXPECT_EQ(readToEnd(child.outputFd()), "a b|--x='\"$");
  EXPECT_EQ(child.wait().code, 7);
  EXPECT_EQ(child.wait().code, 7);  // asked again
}

TEST(ChildProcess, CarriesInputToOutput) {
  ChildProcess child({.program = "/bin/cat", .arguments = {}, .input = Stream::pipe, .output = Stream::pipe});
  ASSERT_EQ(::write(child.inputFd(), "through", 7), 7);
  child.closeInput();
  EXPECT_EQ(readToEnd(child.outputFd()), "through");
  EXPECT_EQ(child.wait().code, 0);
}

TEST(ChildProcess, TellsTheSignalThatKilledIt) {
  ChildProcess child(shell("kill -SEGV $$"));
  EXPECT_EQ(child.wait().signal, SIGSEGV);
}

TEST(ChildProcess, InheritsNoOtherDescriptor) {
  ChildProcess other({.program = "/bin/cat", .arguments = {}, .input = Stream::pipe, .output = Stream::pipe});
  ChildProcess child(shell("ls /proc/$$/fd"));
  const std::string descriptors = readToEnd(child.outputFd());
  EXPECT_EQ(descriptors.find(std::to_string(other.inputFd()) + "\n"), std::string::npos) << descriptors;
  EXPECT_EQ(descriptors.find(std::to_string(other.outputFd()) + "\n"), std::string::npos) << descriptors;
}

TEST(ChildProcess, IsReapedWhenDestroyedEarly) {
  pid_t pid = 0;
  {
    ChildProcess child(shell("trap '' TERM HUP PIPE; while :; do sleep 1; done"));
    pid = child.pid();
  }
  EXPECT_EQ(::kill(pid, 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

TEST(ChildProcess, AProgramThatIsNotThereIsAFileError) {
  EXPECT_THROW(ChildProcess({.program = "/no/such/program", .arguments = {}}), FileError);
}

TEST(FindHelper, NamesTheVariableThatPointsNowhere) {
  ::setenv("HOCTOMAP_MRPT", "/no/such/helper", 1);
  EXPECT_THROW((void)findHelper(), FileError);
  ::unsetenv("HOCTOMAP_MRPT");
}

std::string errorOfPipeSource() {
  try {
    LogReadOptions options;
    options.logs = {"kitchen.rawlog"};
    PipeSource source(options, {}, nullptr);
    while (source.next()) {
    }
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(PipeSource, ACrashOfTheHelperIsAnInputErrorThatNamesTheLog) {
  const FakeHelper helper("kill -SEGV $$");
  const std::string error = errorOfPipeSource();
  EXPECT_NE(error.find("crashed"), std::string::npos) << error;
  EXPECT_NE(error.find("kitchen.rawlog, object 0 at byte 0"), std::string::npos) << error;
}

TEST(PipeSource, NonsenseFromTheHelperIsAnInputError) {
  const FakeHelper helper("echo this is no scan stream at all, but long enough; exec sleep 60");
  EXPECT_NE(errorOfPipeSource().find("not a scan stream"), std::string::npos);
}

TEST(PipeSource, AnEarlyEndIsAnInputError) {
  const FakeHelper helper("printf 'HOCTSCAN\\003\\000\\000\\000'");
  EXPECT_NE(errorOfPipeSource().find("ends before its end"), std::string::npos);
}

TEST(LogReadOptions, BecomeTheHelpersCommandLine) {
  LogReadOptions options;
  options.logs = {"a b.rawlog", "-c.rawlog"};
  options.poses = "identity";
  options.up = {0.0, 0.5, -1.0};
  options.every = 3;
  options.max_scans = 9;
  const auto arguments = toArguments(options);
  EXPECT_EQ(arguments.front(), "read");
  for (const char* expected : {"--input=a b.rawlog", "--input=-c.rawlog", "--poses=identity", "--up=0,0.5,-1",
                               "--every=3", "--max-scans=9"})
    EXPECT_NE(std::find(arguments.begin(), arguments.end(), expected), arguments.end()) << expected;
}

}  // namespace
}  // namespace hoctomap
