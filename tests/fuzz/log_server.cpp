// SPDX-License-Identifier: BSD-3-Clause
// The log reader on mutated logs, in processes forked from one that has everything loaded: a thousand
// times faster than starting `hoctomap-mrpt`, with the same guards. The parent reads what comes as `hoctomap`
// does.
//   fuzz_logs [--rounds N] [--seed S] [--batch LOGS] [--keep DIR]
// A process reads one log, or --batch of them, which is ten times faster; where one ends in the middle of a
// log the next goes on behind it. Dies if a reader ends by a signal, hangs, or with another exit code than 0,
// 3 and 6 (2: a map of poses of its own cannot be read with --poses), or if what it sends is neither whole
// nor an error. --keep: where the log that did it is left.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

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

/// A log to be read: its bytes as a file, and the pipe its stream comes by.
struct Task {
  UniqueFd log;
  UniqueFd from;
  UniqueFd to;
};

Task taskOf(const std::string& bytes) {
  Task task{UniqueFd(memfd_create("log", 0)), {}, {}};
  int pipe[2];
  if (::write(task.log.get(), bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()) ||
      ::pipe2(pipe, O_CLOEXEC) != 0)
    throw FileError("no memory or no pipe");
  task.from = UniqueFd(pipe[0]);
  task.to = UniqueFd(pipe[1]);
  return task;
}

LogReadOptions optionsFor(const Task& task) {
  LogReadOptions options;
  options.logs = {"/proc/self/fd/" + std::to_string(task.log.get())};
  options.poses = "identity";
  return options;
}

/// The reader's life: as `hoctomap-mrpt read` (command_read.cpp), without starting it, for one log after the
/// other. Every exit code goes to `codes` as a byte.
[[noreturn]] void beReader(std::vector<Task>& tasks, int codes) {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDERR_FILENO);
  limitProcess(optionsFor(tasks.front()));
  const rlimit seconds{10, 10};
  ::setrlimit(RLIMIT_CPU, &seconds);
  setAllocationCeiling(kLargestArray);
  confine();
  for (Task& task : tasks) {
    const auto code = static_cast<char>(streamLog(optionsFor(task), task.to.get()));
    task.to.reset();
    if (::write(codes, &code, 1) != 1) ::_exit(1);
  }
  ::_exit(0);
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

/// How it ended: the exit code for a log, or why it is a finding.
struct Outcome {
  int code = 0;
  std::string finding;
};

/// The outcome of the log that the reader has just sent. @param codes where its exit code comes, or nothing
/// if it has ended in the middle of the log; then `child` is taken leave of and set to 0
Outcome outcomeOf(int told, int codes, pid_t& child) {
  char byte = 0;
  int code = 0;
  if (::read(codes, &byte, 1) == 1) {
    code = byte;
  } else {
    int status = 0;
    ::waitpid(std::exchange(child, 0), &status, 0);
    if (WIFSIGNALED(status))
      return {0, "the reader was killed by signal " + std::to_string(WTERMSIG(status))};
    code = WEXITSTATUS(status);
  }
  if (code != told)
    return {code, "exit code " + std::to_string(code) + ", the stream says " + std::to_string(told)};
  if (code != 0 && code != 2 && code != 3 && code != 6) return {code, "exit code " + std::to_string(code)};
  return {code, ""};
}

/// One reader for these logs. @return the outcomes of those it came to: all, unless it ended in one of them
std::vector<Outcome> readLogs(std::span<const std::string> logs) {
  std::vector<Task> tasks;
  for (const std::string& bytes : logs) tasks.push_back(taskOf(bytes));
  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC) != 0) throw FileError("no pipe");
  const UniqueFd codes(pipe[0]);
  UniqueFd codes_to(pipe[1]);
  pid_t child = ::fork();
  if (child == 0) beReader(tasks, codes_to.get());
  codes_to.reset();
  for (Task& task : tasks) task.to.reset();
  std::vector<Outcome> outcomes;
  for (Task& task : tasks) {
    ::alarm(600);  // a hang of either ends this program, which is a finding as well; a busy machine is none
    const int told = readStream(task.from.get());
    task.from.reset();
    outcomes.push_back(outcomeOf(told, codes.get(), child));
    if (child == 0) break;
  }
  if (child != 0) ::waitpid(child, nullptr, 0);
  ::alarm(0);
  return outcomes;
}

/// @return whether there is a finding among them; it is left in `keep` with what the same reader read before
/// it
bool tryLogs(std::span<const std::string> logs, const std::string& keep, std::map<int, std::uint64_t>& ends) {
  while (!logs.empty()) {
    const std::vector<Outcome> outcomes = readLogs(logs);
    for (const Outcome& outcome : outcomes) {
      ++ends[outcome.code];
      if (outcome.finding.empty()) continue;
      for (std::size_t i = 0; i < outcomes.size(); ++i)
        std::ofstream(keep + "-" + std::to_string(i) + ".rawlog", std::ios::binary) << logs[i];
      std::fprintf(stderr, "%s-*.rawlog: the last one: %s\n", keep.c_str(), outcome.finding.c_str());
      return true;
    }
    logs = logs.subspan(outcomes.size());
  }
  return false;
}

int run(std::uint64_t rounds, std::uint64_t seed, std::uint64_t batch, const std::string& keep) {
  const auto seeds = seedLogs();
  std::map<int, std::uint64_t> ends;
  std::mt19937_64 random(seed);
  std::vector<std::string> logs;
  for (std::uint64_t i = 0; i < rounds; ++i) {
    logs.push_back(i < seeds.size() ? seeds[i] : fuzz::mutated(seeds[i % seeds.size()], random));
    if (logs.size() < batch && i + 1 < rounds) continue;
    if (tryLogs(logs, keep + "/finding-" + std::to_string(seed) + "-" + std::to_string(i), ends)) return 1;
    logs.clear();
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
  std::uint64_t batch = 1;
  std::string keep = ".";
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string word = argv[i];
    if (word == "--rounds") rounds = std::stoull(argv[i + 1]);
    if (word == "--seed") seed = std::stoull(argv[i + 1]);
    if (word == "--batch") batch = std::stoull(argv[i + 1]);
    if (word == "--keep") keep = argv[i + 1];
  }
  return hoctomap::run(rounds, seed, batch, keep);
}
