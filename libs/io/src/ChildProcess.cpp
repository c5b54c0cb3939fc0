// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/ChildProcess.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "PipeWrite.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

[[noreturn]] void fail(const std::string& what, int error) {
  throw FileError(what + ": " + std::strerror(error));
}

std::pair<UniqueFd, UniqueFd> closeOnExecPipe() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail("cannot make a pipe", errno);
  return {UniqueFd(ends[0]), UniqueFd(ends[1])};
}

/// The settings of posix_spawn, freed on every way out.
class SpawnSettings {
 public:
  explicit SpawnSettings(bool own_group) {
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    // Threads of this program may block or ignore signals; the child starts with the usual ones.
    sigset_t none;
    sigset_t all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setpgroup(&attributes, 0);
    const int group = own_group ? POSIX_SPAWN_SETPGROUP : 0;
    posix_spawnattr_setflags(&attributes,
                             static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | group));
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }

  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
};

/// Connects descriptor `target` of the child as asked; with a pipe, returns {this program's end, the
/// child's}.
std::pair<UniqueFd, UniqueFd> connect(posix_spawn_file_actions_t& actions, ChildProcess::Stream stream,
                                      int target) {
  const bool child_reads = target == STDIN_FILENO;
  if (stream == ChildProcess::Stream::inherit) return {};
  if (stream == ChildProcess::Stream::null) {
    posix_spawn_file_actions_addopen(&actions, target, "/dev/null", child_reads ? O_RDONLY : O_WRONLY, 0);
    return {};
  }
  auto [read_end, write_end] = closeOnExecPipe();
  UniqueFd& childs = child_reads ? read_end : write_end;
  UniqueFd& ours = child_reads ? write_end : read_end;
  posix_spawn_file_actions_adddup2(&actions, childs.get(), target);
  return {std::move(ours), std::move(childs)};
}

ExitStatus statusFrom(int status) {
  if (WIFSIGNALED(status)) return {0, WTERMSIG(status)};
  return {WEXITSTATUS(status), 0};
}

}  // namespace

void UniqueFd::reset(int fd) {
  if (fd_ >= 0) ::close(fd_);
  fd_ = fd;
}

ChildProcess::ChildProcess(const Options& options) {
  SpawnSettings settings(options.own_group);
  auto [our_input, childs_input] = connect(settings.actions, options.input, STDIN_FILENO);
  auto [our_output, childs_output] = connect(settings.actions, options.output, STDOUT_FILENO);

  std::vector<std::string> words{options.program.string()};
  words.insert(words.end(), options.arguments.begin(), options.arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const int error =
      ::posix_spawn(&pid_, words[0].c_str(), &settings.actions, &settings.attributes, argv.data(), environ);
  if (error != 0) {
    pid_ = -1;
    fail("cannot start " + words[0], error);
  }
  input_ = std::move(our_input);
  output_ = std::move(our_output);
}

ChildProcess::~ChildProcess() {
  using namespace std::chrono_literals;
  input_.reset();
  output_.reset();
  const auto endsWithin = [&](std::chrono::milliseconds time) {
    for (auto waited = 0ms; waited < time; waited += 5ms) {
      if (poll()) return true;
      std::this_thread::sleep_for(5ms);
    }
    return poll().has_value();
  };
  if (endsWithin(200ms)) return;
  kill(SIGTERM);
  if (endsWithin(1000ms)) return;
  kill(SIGKILL);
  wait();
}

void ChildProcess::send(std::string_view bytes) {
  if (const int error = writeToPipe(input_.get(), bytes.data(), bytes.size()))
    fail("cannot write to a child process", error);
}

ExitStatus ChildProcess::wait() {
  while (!ended_) {
    int status = 0;
    const pid_t got = ::waitpid(pid_, &status, 0);
    if (got == pid_) ended_ = statusFrom(status);
    // Someone else reaped it (SIGCHLD ignored): its status is lost, the child is gone.
    if (got < 0 && errno != EINTR) ended_ = ExitStatus{127, 0};
  }
  return *ended_;
}

std::optional<ExitStatus> ChildProcess::poll() {
  if (ended_) return ended_;
  int status = 0;
  const pid_t got = ::waitpid(pid_, &status, WNOHANG);
  if (got == pid_) ended_ = statusFrom(status);
  if (got < 0 && errno != EINTR) ended_ = ExitStatus{127, 0};
  return ended_;
}

void ChildProcess::kill(int signal) {
  if (!poll()) ::kill(pid_, signal);
}

}  // namespace hoctomap
