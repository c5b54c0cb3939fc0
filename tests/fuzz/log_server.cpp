// SPDX-License-Identifier: BSD-3-Clause
// The log reader on mutated logs, a process for each, forked from one that has everything loaded: a thousand
// times faster than starting `hoctomap-mrpt`, with the same guards. The parent reads what comes as `hoctomap`
// does.
//   fuzz_logs [--rounds N] [--seed S] [--keep DIR]
// Dies if a reader ends by a signal, hangs, or with another exit code than 0, 3 and 6 (2: a map of poses
// of its own cannot be read with --poses), or if what it sends is neither whole nor an error. --keep: where
// the log that did it is left.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <thread>

#include "Confinement.h"
#include "Mutation.h"
#include "ProcessGuards.h"
#include "StreamLog.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/mrpt_io/LogReader.h"
#include "mrpt_io/log_objects.h"

namespace hoctomap {
namespace {

std::vector<std::string> seedLogs() {
  const std::string clouds = test::cloudObject(100.0, "c", PointCloud(20, Eigen::Vector3f(1, 2, 3)));
  const std::string laser = test::laserObject(100.5, std::vector<float>(20, 1.F), 5.F);
  const std::string log = test::sweep(3) + clouds + laser + test::odometryObject(101.0, 0.1) +
                          test::imuObject(101.0) + test::nullObject();
  return {log, test::sweep(2) + test::actionAndFrame(102.0, 0.1) + test::frameObject({{}, {}}),
          test::rawlogObject({{}, {}}), test::simpleMapObject({}, Pose(1, 2, 3, 0.1, 0.2, 0.3)),
          test::gz(log)};
}

/// The reader's life: as `hoctomap-mrpt read` (command_read.cpp), without starting it.
[[noreturn]] void beReader(const LogReadOptions& options, int pipe) {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDERR_FILENO);
  limitProcess(options);
  const rlimit seconds{10, 10};
  ::setrlimit(RLIMIT_CPU, &seconds);
  setAllocationCeiling(kLargestArray);
  confine();
  ::_exit(streamLog(options, pipe));
}

/// What `hoctomap` makes of the stream: its exit code.
int readStream(int pipe) {
  try {
    ScanStreamReader reader(pipe);
    for (;;) {
      const StreamMessage message = reader.read();
      if (const auto* error = std::get_if<StreamError>(&message)) return error->exit_code;
      if (std::holds_alternative<StreamEnd>(message)) return 0;
    }
  } catch (const Error& error) {
    return exitCodeOf(error);
  }
}

/// Why this log is a finding; nothing if all is well. Counts how it ended.
std::optional<std::string> tryLog(const std::string& bytes, std::map<int, std::uint64_t>& ends) {
  const UniqueFd log(memfd_create("log", 0));
  if (::write(log.get(), bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
    return "no memory";
  LogReadOptions options;
  options.logs = {"/proc/self/fd/" + std::to_string(log.get())};
  options.poses = "identity";
  int ends_of_pipe[2];
  if (::pipe2(ends_of_pipe, O_CLOEXEC) != 0) return "no pipe";
  const UniqueFd from(ends_of_pipe[0]);
  UniqueFd to(ends_of_pipe[1]);
  const pid_t child = ::fork();
  if (child == 0) beReader(options, to.get());
  to.reset();
  ::alarm(60);  // a hang of either ends this program, which is a finding as well
  const int told = readStream(from.get());
  int status = 0;
  ::waitpid(child, &status, 0);
  ::alarm(0);
  ++ends[told];
  if (WIFSIGNALED(status)) return "the reader was killed by signal " + std::to_string(WTERMSIG(status));
  const int code = WEXITSTATUS(status);
  if (code != told) return "exit code " + std::to_string(code) + ", the stream says " + std::to_string(told);
  if (code != 0 && code != 2 && code != 3 && code != 6) return "exit code " + std::to_string(code);
  return std::nullopt;
}

int run(std::uint64_t rounds, std::uint64_t seed, const std::string& keep) {
  const auto seeds = seedLogs();
  std::map<int, std::uint64_t> ends;
  std::mt19937_64 random(seed);
  for (std::uint64_t i = 0; i < rounds; ++i) {
    const std::string bytes = i < seeds.size() ? seeds[i] : fuzz::mutated(seeds[i % seeds.size()], random);
    const auto finding = tryLog(bytes, ends);
    if (!finding) continue;
    const std::string file = keep + "/finding-" + std::to_string(seed) + "-" + std::to_string(i) + ".rawlog";
    std::ofstream(file, std::ios::binary) << bytes;
    std::fprintf(stderr, "%s: %s\n", file.c_str(), finding->c_str());
    return 1;
  }
  for (const auto& [code, count] : ends)
    std::printf("%llu x exit code %d\n", static_cast<unsigned long long>(count), code);
  return 0;
}

}  // namespace
}  // namespace hoctomap

int main(int argc, char** argv) {
  std::uint64_t rounds = 100;
  std::uint64_t seed = 1;
  std::string keep = ".";
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string word = argv[i];
    if (word == "--rounds") rounds = std::stoull(argv[i + 1]);
    if (word == "--seed") seed = std::stoull(argv[i + 1]);
    if (word == "--keep") keep = argv[i + 1];
  }
  return hoctomap::run(rounds, seed, keep);
}
