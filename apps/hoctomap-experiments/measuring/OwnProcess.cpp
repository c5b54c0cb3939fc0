// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/OwnProcess.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/ChildProcess.h"

namespace hoctomap {

namespace {

constexpr int kLimitExit = 6;  // of a LimitError, and of a failed allocation

/// The same program with the allocator of the C library, beside it.
std::filesystem::path withPlainAllocator(std::filesystem::path program) {
  return program.replace_filename("hoctomap-experiments-libc");
}

std::vector<std::string> arguments(const Task& task) {
  std::vector<std::string> result{"measure", task.name, "--log", task.scans.log.string()};
  const auto add = [&result](const std::string& option, const std::string& value) {
    result.insert(result.end(), {option, value});
  };
  if (!task.variant.empty()) add("--variant", task.variant);
  add("--start", std::to_string(task.scans.start));
  add("--every", std::to_string(task.scans.every));
  if (task.scans.max_scans) add("--max-scans", std::to_string(*task.scans.max_scans));
  if (task.config) add("--config", *task.config);
  for (const auto& assignment : task.overrides) add("--set", assignment);
  add("--resolution", numberText(task.resolution));
  add("--threads", std::to_string(task.threads));
  add("--far-nodes", std::to_string(task.far_nodes));
  add("--warm-up", std::to_string(task.warm_up));
  add("--limit-memory", std::to_string(task.limits.memory_bytes));
  add("--limit-cpu", std::to_string(task.limits.cpu_seconds));
  return result;
}

std::string readAll(int fd) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t n = 0; (n = ::read(fd, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return text;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::filesystem::path thisProgram() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

std::optional<Figures> measureApart(const Task& task) {
  const auto program = thisProgram();
  ChildProcess child({.program = task.plain_allocator ? withPlainAllocator(program) : program,
                      .arguments = arguments(task),
                      .output = ChildProcess::Stream::pipe,
                      .own_group = false});
  const std::string text = readAll(child.outputFd());
  const ExitStatus status = child.wait();
  const bool limited = task.limits.memory_bytes != 0 || task.limits.cpu_seconds != 0;
  if (limited && (status.code == kLimitExit || status.signal == SIGXCPU || status.signal == SIGKILL)) {
    return std::nullopt;
  }
  if (status.code != 0 || status.signal != 0) {
    throw InputError("the measurement '" + task.name + "' of " + task.scans.log.string() + " failed");
  }
  return Figures::parse(text);
}

Figures runApart(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
  const Stopwatch watch;
  ChildProcess child(
      {.program = program, .arguments = arguments, .output = ChildProcess::Stream::null, .own_group = false});
  rusage usage{};
  siginfo_t info{};
  // Only the system call itself gives what one child has used and leaves the child to its owner.
  if (::syscall(SYS_waitid, P_PID, child.pid(), &info, WEXITED | WNOWAIT, &usage) != 0) {
    throw FileError("cannot wait for " + program.string());
  }
  Figures figures;
  figures.add("wall_s", watch.elapsed().wall_s);
  figures.add("user_s", seconds(usage.ru_utime));
  figures.add("cpu_s", seconds(usage.ru_utime) + seconds(usage.ru_stime));
  figures.add("max_rss_bytes", static_cast<std::uint64_t>(usage.ru_maxrss) * 1024);
  const ExitStatus ended = child.wait();
  if (ended.code != 0 || ended.signal != 0) throw InputError(program.string() + " failed");
  return figures;
}

std::filesystem::path findHoctomap() {
  const auto here = thisProgram().parent_path();
  for (const auto& place : {here / "hoctomap", here.parent_path() / "hoctomap" / "hoctomap"}) {
    if (std::filesystem::is_regular_file(place) && ::access(place.c_str(), X_OK) == 0) return place;
  }
  throw FileError("cannot find the program hoctomap beside " + here.string());
}

}  // namespace hoctomap
