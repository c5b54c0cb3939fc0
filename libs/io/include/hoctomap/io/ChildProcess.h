// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hoctomap {

/// A file descriptor with one owner.
class UniqueFd {
 public:
  UniqueFd() = default;
  explicit UniqueFd(int fd) : fd_(fd) {}
  UniqueFd(UniqueFd&& other) noexcept : fd_(other.release()) {}
  UniqueFd& operator=(UniqueFd&& other) noexcept {
    if (this != &other) reset(other.release());
    return *this;
  }
  ~UniqueFd() { reset(); }

  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] int release() {
    const int fd = fd_;
    fd_ = -1;
    return fd;
  }
  void reset(int fd = -1);

 private:
  int fd_ = -1;
};

/// How a process ended.
struct ExitStatus {
  int code = 0;    ///< if `signal` is 0
  int signal = 0;  ///< that killed it
};

/// A child process that is always reaped. Descriptors of this program are not inherited (all are
/// close-on-exec) save the standard ones.
///
/// Start it from a thread that lives as long as the child is wanted: a child that asked to die with its
/// parent (PR_SET_PDEATHSIG) dies with the *thread* that started it.
class ChildProcess {
 public:
  enum class Stream {
    inherit,  ///< the one of this program
    null,     ///< /dev/null
    pipe      ///< a pipe to this program
  };
  struct Options {
    std::filesystem::path program;
    std::vector<std::string> arguments;  ///< without the program's name
    Stream input = Stream::null;
    Stream output = Stream::inherit;
    /// In a process group of its own: Ctrl-C on the terminal reaches this program only, which then decides.
    bool own_group = true;
  };

  /// @throws FileError if it cannot be started.
  explicit ChildProcess(const Options& options);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Closes the pipes, gives the child a moment to end by itself, then kills and reaps it.
  ~ChildProcess();

  [[nodiscard]] pid_t pid() const { return pid_; }
  [[nodiscard]] int inputFd() const { return input_.get(); }    ///< write here; -1 without a pipe
  [[nodiscard]] int outputFd() const { return output_.get(); }  ///< read here; -1 without a pipe
  void closeInput() { input_.reset(); }
  /// Writes all of it to the child's standard input, a pipe. @throws FileError if the child has ended
  void send(std::string_view bytes);

  /// Waits for its end.
  ExitStatus wait();
  /// Its end if it has ended.
  std::optional<ExitStatus> poll();
  /// Sends a signal if it has not ended.
  void kill(int signal);

 private:
  pid_t pid_ = -1;
  std::optional<ExitStatus> ended_;
  UniqueFd input_;
  UniqueFd output_;
};

/// A helper program, `hoctomap-mrpt` or `hoctomap-cloud`: $HOCTOMAP_MRPT or $HOCTOMAP_CLOUD if set; else
/// beside this program, in `../libexec/hoctomap/`, or in the build tree that this program lies in.
/// @throws FileError naming the places looked at.
[[nodiscard]] std::filesystem::path findHelper(const std::string& name = "hoctomap-mrpt");

/// Runs a verb of the helper with this program's own stdin, stdout and stderr.
/// @return its exit code, 128 + n if signal n killed it
int runHelper(const std::vector<std::string>& arguments);

}  // namespace hoctomap
