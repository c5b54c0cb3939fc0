// SPDX-License-Identifier: BSD-3-Clause
// A run that is killed, stopped, or runs out of disk, as often as you like, loses nothing that was committed
// and ends with the bytes of one that was left alone.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <random>
#include <thread>

#include "TableLogs.h"
#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/MapCheck.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;
using Clock = std::chrono::steady_clock;

/// `hoctomap build --continue`, at work.
class RunningBuild {
 public:
  RunningBuild(const std::string& log, const std::string& map)
      : child_({.program = HOCTOMAP_PROGRAM,
                .arguments = {"build", "-q", "-i", log, "-o", map, "--continue", "--set",
                              "mapping.checkpoint_scans=1"},
                .output = ChildProcess::Stream::null}) {}
  void signal(int number) { child_.kill(number); }
  [[nodiscard]] bool ended() { return child_.poll().has_value(); }
  ExitStatus wait() { return child_.wait(); }

 private:
  ChildProcess child_;
};

/// What happens to the names in a directory, from now on.
class NameChanges {
 public:
  explicit NameChanges(const std::string& directory) : fd_(inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
    inotify_add_watch(fd_.get(), directory.c_str(), IN_CREATE | IN_MOVED_TO | IN_CLOSE_WRITE | IN_DELETE);
  }
  /// Waits for the next change; false if there is none within `milliseconds`.
  bool next(int milliseconds) {
    if (left_ > 0) return --left_, true;
    pollfd wait{fd_.get(), POLLIN, 0};
    if (poll(&wait, 1, milliseconds) <= 0) return false;
    alignas(inotify_event) char buffer[4096];
    const auto size = read(fd_.get(), buffer, sizeof buffer);
    for (ssize_t at = 0; at < size;) {
      const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
      at += static_cast<ssize_t>(sizeof *event + event->len);
      ++left_;
    }
    return left_ > 0 && (--left_, true);
  }

 private:
  UniqueFd fd_;
  int left_ = 0;
};

/// Until the build has committed for the first time, or ended.
void waitForCommit(RunningBuild& run, const std::string& map) {
  NameChanges changes(map);
  while (!std::filesystem::exists(map + "/hierarchy.yaml") && !run.ended()) changes.next(5);
}

class Kills : public ::testing::Test {
 protected:
  Kills() {
    setenv("HOCTOMAP_MRPT", HOCTOMAP_HELPER, 1);
    test::simulate("demo", log);
    const auto start = Clock::now();
    EXPECT_EQ(RunningBuild(log, folder / "whole").wait().code, 0);
    duration = Clock::now() - start;
    expected = test::reproducibleFiles(folder / "whole");
  }

  /// Runs until one ends by itself; `disturb` kills it or not. @return the number of runs it killed
  int runToTheEnd(const std::string& map, const std::function<void(RunningBuild&)>& disturb) {
    for (int kills = 0;; ++kills) {
      RunningBuild run(log, map);
      disturb(run);
      const ExitStatus status = run.wait();
      if (std::filesystem::exists(map + "/hierarchy.yaml")) {
        for (const Damage& damage : checkMap(map).damage) ADD_FAILURE() << damage.path << ": " << damage.what;
      }
      if (status.signal == 0) {
        EXPECT_EQ(status.code, 0);
        EXPECT_EQ(test::reproducibleFiles(map), expected) << "after " << kills << " kills";
        return kills;
      }
    }
  }

  TemporaryFolder folder;
  const std::string log = folder / "a.rawlog";
  Clock::duration duration{};
  std::map<std::string, std::string> expected;
};

TEST_F(Kills, AtRandomTimes) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(0.05, 1.2);
  int kills = 0;
  for (int episode = 0; kills < 40; ++episode) {
    kills += runToTheEnd(folder / ("map" + std::to_string(episode)), [&](RunningBuild& run) {
      const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(part(random) * duration);
      while (Clock::now() < end && !run.ended()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      run.signal(SIGKILL);
    });
  }
}

TEST_F(Kills, AroundCommits) {
  std::mt19937_64 random(8);
  int kills = 0;
  for (int episode = 0; kills < 20; ++episode) {
    const std::string map = folder / ("map" + std::to_string(episode));
    std::filesystem::create_directory(map);
    kills += runToTheEnd(map, [&](RunningBuild& run) {
      NameChanges changes(map);
      int before = std::uniform_int_distribution<int>(1, 40)(random);
      while (before > 0 && !run.ended()) before -= changes.next(5) ? 1 : 0;
      run.signal(SIGKILL);
    });
  }
}

TEST_F(Kills, ASignalCommitsAndSaysSo) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string map = folder / ("map" + std::to_string(signal));
    std::filesystem::create_directory(map);
    {
      RunningBuild run(log, map);
      waitForCommit(run, map);
      run.signal(signal);
      const ExitStatus status = run.wait();
      ASSERT_EQ(status.signal, 0);
      if (status.code != 0) {
        EXPECT_EQ(status.code, 128 + signal);
      }
    }
    EXPECT_GT(readManifest(map).scans, 0U);
    EXPECT_EQ(runToTheEnd(map, [](RunningBuild&) {}), 0);
  }
}

/// The alarm that the first signal sets comes at once here, wherever the run stands.
TEST_F(Kills, AStopThatTakesTooLongLeavesTheLastCommit) {
  int ended_at_once = 0;
  for (const int changes_before : {1, 10, 25, 40}) {
    const std::string map = folder / ("map" + std::to_string(changes_before));
    std::filesystem::create_directory(map);
    {
      RunningBuild run(log, map);
      NameChanges changes(map);
      int before = changes_before;
      while (before > 0 && !run.ended()) before -= changes.next(5) ? 1 : 0;
      run.signal(SIGINT);
      run.signal(SIGALRM);
      const ExitStatus status = run.wait();
      ASSERT_EQ(status.signal, 0);
      EXPECT_EQ(status.code, 128 + SIGINT);
    }
    const std::string log_file = map + "/log.txt";  // the run may end before it begins one
    const bool orderly = std::filesystem::exists(log_file) &&
                         test::readFile(log_file).find("stopped by signal") != std::string::npos;
    ended_at_once += orderly ? 0 : 1;
    if (std::filesystem::exists(map + "/hierarchy.yaml")) {
      for (const Damage& damage : checkMap(map).damage) ADD_FAILURE() << damage.path << ": " << damage.what;
    }
    EXPECT_EQ(runToTheEnd(map, [](RunningBuild&) {}), 0);
  }
  EXPECT_GT(ended_at_once, 0);
}

TEST_F(Kills, ASecondSignalEndsItAtOnceAndSafely) {
  const std::string map = folder / "map";
  std::filesystem::create_directory(map);
  {
    RunningBuild run(log, map);
    waitForCommit(run, map);
    run.signal(SIGINT);
    run.signal(SIGTERM);  // another one, too
    const ExitStatus status = run.wait();
    EXPECT_TRUE(status.signal == SIGINT || status.signal == SIGTERM || status.code == 128 + SIGINT ||
                status.code == 128 + SIGTERM || status.code == 0)
        << status.signal << " " << status.code;
  }
  EXPECT_EQ(runToTheEnd(map, [](RunningBuild&) {}), 0);
}

TEST_F(Kills, ASecondWriterIsRefusedWithThePidOfTheFirst) {
  const std::string map = folder / "map";
  std::filesystem::create_directory(map);
  RunningBuild first(log, map);
  NameChanges changes(map);
  std::error_code not_yet;
  while (std::filesystem::file_size(map + "/.lock", not_yet) == 0 || not_yet) changes.next(5);
  first.signal(SIGSTOP);
  ASSERT_FALSE(first.ended());
  const std::string pid = std::to_string(std::stoi(test::readFile(map + "/.lock")));
  for (const char* mode : {"--continue", "--overwrite"}) {
    const auto second =
        test::hoctomap({"build", "-q", "-i", log, "-o", map, mode, "--set", "mapping.checkpoint_scans=1"});
    EXPECT_EQ(second.exit_code, 5) << second.err;
    EXPECT_NE(second.err.find("process " + pid), std::string::npos) << second.err;
  }
  first.signal(SIGCONT);
  EXPECT_EQ(first.wait().code, 0);
  EXPECT_EQ(test::reproducibleFiles(map), expected);
}

/// A limit on file sizes, inherited by the program, stands for a full disk.
TEST_F(Kills, AFullDiskIsExit5AndTheMapStaysWhole) {
  const std::string map = folder / "map";
  test::build(log, map, {"--max-scans", "2", "--set", "mapping.checkpoint_scans=1"});
  const auto before = test::reproducibleFiles(map);
  const rlim_t largest = std::filesystem::file_size(map + "/" + readManifest(map).nodes.at(0).ot.path);
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{largest / 2, largest / 2};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto outcome = test::hoctomap(
        {"build", "-q", "-i", log, "-o", map, "--continue", "--set", "mapping.checkpoint_scans=1"});
    const bool told = outcome.err.find("cannot write") != std::string::npos;
    ::_exit(told ? outcome.exit_code : 99);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 5);
  auto after = test::reproducibleFiles(map);
  EXPECT_EQ(after.at("hierarchy.yaml"), before.at("hierarchy.yaml"));
  EXPECT_EQ(runToTheEnd(map, [](RunningBuild&) {}), 0) << "with room again it goes on";
}

}  // namespace
}  // namespace hoctomap
