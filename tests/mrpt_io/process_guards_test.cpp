// SPDX-License-Identifier: BSD-3-Clause
// How a log reader that a log brings down says so, in processes of their own. Its clock is struck by hand.
#include "ProcessGuards.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <string>

#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/ScanStream.h"

namespace hoctomap {
namespace {

constexpr int kSurvived = 77;

struct End {
  int code = 0;
  UniqueFd said;
};

/// A process that reads object 7 of a log, at byte 1000, and does this meanwhile.
End readerThat(LastWord kind, const std::function<void(ReadProgress&)>& act) {
  int pipe[2];
  EXPECT_EQ(::pipe2(pipe, O_CLOEXEC), 0);
  UniqueFd from(pipe[0]);
  const UniqueFd to(pipe[1]);
  const pid_t child = ::fork();
  if (child == 0) {
    if (kind == LastWord::stream_message) ScanStreamWriter begun(to.get());
    ReadProgress progress;
    progress.set({0, 7, 1000});
    reportCrashes(kind, to.get(), {"a.rawlog"}, progress);
    act(progress);
    ::_exit(kSurvived);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  return {WEXITSTATUS(status), std::move(from)};
}

void strike(int seconds) {
  for (int i = 0; i < seconds; ++i) ::raise(SIGPROF);
}

TEST(ProcessGuards, ACrashIsAMessageWithItsPlace) {
  const End end = readerThat(LastWord::stream_message, [](ReadProgress&) { ::raise(SIGSEGV); });
  EXPECT_EQ(end.code, 3);
  ScanStreamReader reader(end.said.get());
  const auto error = std::get<StreamError>(reader.read());
  EXPECT_EQ(error.exit_code, 3);
  EXPECT_NE(error.text.find("a.rawlog: object 7 at byte 1000"), std::string::npos) << error.text;
}

TEST(ProcessGuards, OrALineOfText) {
  const End end = readerThat(LastWord::line_of_text, [](ReadProgress&) { ::raise(SIGABRT); });
  EXPECT_EQ(end.code, 3);
  char text[200] = {};
  EXPECT_GT(::read(end.said.get(), text, sizeof text - 1), 0);
  EXPECT_EQ(
      std::string(text),
      "hoctomap-mrpt: a.rawlog: object 7 at byte 1000: crashes the log reader (signal 6): it is damaged\n");
}

TEST(ProcessGuards, AnObjectHasItsTime) {
  const End end = readerThat(LastWord::stream_message, [](ReadProgress& progress) {
    progress.in_object = true;
    strike(8);
  });
  EXPECT_EQ(end.code, 6);
  ScanStreamReader reader(end.said.get());
  EXPECT_NE(std::get<StreamError>(reader.read()).text.find("object 7 at byte 1000: takes too long"),
            std::string::npos);
}

TEST(ProcessGuards, LargeObjectsHaveMoreAndOthersHaveTheirOwn) {
  const auto survives = [](const std::function<void(ReadProgress&)>& act) {
    return readerThat(LastWord::stream_message, act).code == kSurvived;
  };
  const auto reads = [](std::uint64_t bytes) {
    return [bytes](ReadProgress& progress) {
      progress.in_object = true;
      progress.read = 1000 + bytes;
      strike(20);
    };
  };
  EXPECT_TRUE(survives(reads(std::uint64_t{80} << 20)));
  EXPECT_FALSE(survives(reads(std::uint64_t{8} << 20)));
  EXPECT_TRUE(survives([](ReadProgress& progress) {  // twenty objects
    progress.in_object = true;
    for (std::uint64_t object = 0; object < 20; ++object) {
      progress.set({0, object, 0});
      strike(3);
    }
  }));
  EXPECT_TRUE(survives([](ReadProgress&) { strike(100); }));  // at work on something else
}

}  // namespace
}  // namespace hoctomap
