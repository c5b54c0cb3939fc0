// SPDX-License-Identifier: BSD-3-Clause
// What a log reader cannot do, should a log take it over.
#include "Confinement.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "hoctomap/io/PipeSource.h"
#include "log_objects.h"

namespace hoctomap {
namespace {

/// Whether `deed` can be done in a confined process of its own.
bool canDo(const std::function<bool()>& deed) {
  const pid_t child = ::fork();
  if (child == 0) {
    confine();
    ::_exit(deed() ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  return WEXITSTATUS(status) == 0;
}

bool kernelHasLandlock() {
  return ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) >= 1;
}

bool kernelHasSeccomp() {
  return ::prctl(PR_GET_SECCOMP) >= 0;
}

TEST(Confinement, ReadingStaysPossible) {
  const test::Folder folder;
  const auto file = folder.write("file", "text");
  EXPECT_TRUE(canDo([&] {
    std::string text;
    std::getline(std::ifstream(file), text);
    return text == "text";
  }));
  EXPECT_TRUE(canDo([] {  // memory and threads
    int sum = 0;
    std::thread([&] { sum = static_cast<int>(std::vector<int>(1'000'000, 1).size()); }).join();
    return sum == 1'000'000;
  }));
  EXPECT_TRUE(canDo([] { return ::write(STDERR_FILENO, "", 0) == 0; }));
}

TEST(Confinement, FilesCannotBeChanged) {
  if (!kernelHasLandlock()) GTEST_SKIP() << "no Landlock in this kernel";
  const test::Folder folder;
  const std::string file = folder.write("file", "text");
  const std::string fresh = folder.path / "fresh";
  EXPECT_FALSE(canDo([&] { return ::open(file.c_str(), O_WRONLY) >= 0; }));
  EXPECT_FALSE(canDo([&] { return ::open(file.c_str(), O_RDWR) >= 0; }));
  EXPECT_FALSE(canDo([&] { return ::open(file.c_str(), O_RDONLY | O_TRUNC) >= 0; }));
  EXPECT_FALSE(canDo([&] { return ::open(fresh.c_str(), O_RDONLY | O_CREAT, 0600) >= 0; }));
  EXPECT_FALSE(canDo([&] { return ::unlink(file.c_str()) == 0; }));
  EXPECT_FALSE(canDo([&] { return ::rename(file.c_str(), fresh.c_str()) == 0; }));
  EXPECT_FALSE(canDo([&] { return ::link(file.c_str(), fresh.c_str()) == 0; }));
  EXPECT_FALSE(canDo([&] { return ::mkdir(fresh.c_str(), 0700) == 0; }));
  EXPECT_TRUE(std::filesystem::exists(file));
  EXPECT_EQ(std::filesystem::file_size(file), 4U);
  EXPECT_FALSE(std::filesystem::exists(fresh));
}

TEST(Confinement, NothingElseCanBeReached) {
  if (!kernelHasSeccomp()) GTEST_SKIP() << "no seccomp in this kernel";
  const test::Folder folder;
  const std::string file = folder.write("file", "text");
  EXPECT_FALSE(canDo([] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; }));
  EXPECT_FALSE(canDo([] { return ::socket(AF_UNIX, SOCK_STREAM, 0) >= 0; }));
  EXPECT_FALSE(canDo([] { return ::kill(::getppid(), 0) == 0; }));
  EXPECT_FALSE(canDo([&] { return ::chmod(file.c_str(), 0777) == 0; }));
  EXPECT_FALSE(canDo([] { return ::execl("/bin/true", "true", nullptr) != -1; }));
  EXPECT_FALSE(canDo([] {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    return child > 0;
  }));
}

/// The process that `parent` has started, once it has.
pid_t childOf(pid_t parent) {
  for (int i = 0; i < 500; ++i) {
    const std::string task = "/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent);
    pid_t child = 0;
    if (std::ifstream(task + "/children") >> child) return child;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return 0;
}

bool isAlive(pid_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(in, text);
  const auto name_end = text.rfind(')');
  return name_end != std::string::npos && text.at(name_end + 2) != 'Z';  // a zombie is not
}

TEST(Confinement, TheReaderDiesWithItsParent) {
  const test::Folder folder;
  const auto options = test::optionsFor(folder.write("log.rawlog", test::sweep(3000)));
  const pid_t parent = ::fork();
  if (parent == 0) {
    PipeSource source(options, {}, nullptr);  // more than a pipe holds, and nobody takes it
    ::pause();
  }
  const pid_t reader = childOf(parent);
  ASSERT_GT(reader, 0);
  EXPECT_TRUE(isAlive(reader));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  for (int i = 0; i < 500 && isAlive(reader); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(isAlive(reader));
}

}  // namespace
}  // namespace hoctomap
