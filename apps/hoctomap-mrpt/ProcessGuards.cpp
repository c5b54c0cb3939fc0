// SPDX-License-Identifier: BSD-3-Clause
#include "ProcessGuards.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/ScanStream.h"

namespace hoctomap {

namespace {

void setLimit(__rlimit_resource resource, std::uint64_t value) {
  rlimit limit{};
  getrlimit(resource, &limit);
  limit.rlim_cur = std::min<rlim_t>(value, limit.rlim_max);
  limit.rlim_max = limit.rlim_cur;
  setrlimit(resource, &limit);
}

/// A text put together in a signal handler: no memory is taken.
class SafeText {
 public:
  void add(const char* text) {
    for (; *text != '\0' && at_ + 1 < sizeof text_; ++text) text_[at_++] = *text;
  }
  void add(std::uint64_t number) {
    char digits[21] = {};
    std::size_t first = sizeof digits - 1;
    do {
      digits[--first] = static_cast<char>('0' + number % 10);
      number /= 10;
    } while (number != 0);
    add(digits + first);
  }
  [[nodiscard]] const char* get() const { return text_; }

 private:
  char text_[1000] = {};
  std::size_t at_ = 0;
};

/// What the handler needs. A signal handler takes no context, so this is one of the few things of which a
/// process has one.
struct CrashReport {
  LastWord kind = LastWord::stream_message;
  int fd = -1;
  const ReadProgress* progress = nullptr;
  std::vector<std::string> names;
  std::vector<unsigned char> stack;  // for stack overflows
  StreamPosition watched;            // the object whose time is taken
  std::uint64_t seconds = 0;
};

CrashReport& crashReport() {
  static CrashReport report;
  return report;
}

void sayLine(int fd, const char* text) {
  for (const char* piece : {"hoctomap-mrpt: ", text, "\n"}) {
    if (write(fd, piece, std::strlen(piece)) < 0) return;
  }
}

void onCrash(int signal) {
  const CrashReport& report = crashReport();
  const StreamPosition at = report.progress->get();
  const bool too_long = signal == SIGXCPU || signal == SIGPROF;
  SafeText text;
  text.add(at.log < report.names.size() ? report.names[at.log].c_str() : "the log");
  text.add(": object ");
  text.add(at.object);
  text.add(" at byte ");
  text.add(at.offset);
  text.add(too_long ? ": takes too long to read" : ": crashes the log reader (signal ");
  if (!too_long) {
    text.add(static_cast<std::uint64_t>(signal));
    text.add("): it is damaged");
  }
  const int code = too_long ? 6 : 3;
  if (report.kind == LastWord::stream_message)
    sendErrorFromSignalHandler(report.fd, code, text.get(), at);
  else
    sayLine(report.fd, text.get());
  _exit(code);
}

/// Once a second of CPU time.
void onTick(int signal) {
  constexpr std::uint64_t kSecondsOfAnObject = 5;
  constexpr std::uint64_t kBytesOfASecond = std::uint64_t{4} << 20;
  CrashReport& report = crashReport();
  const StreamPosition at = report.progress->get();
  const bool same = at.log == report.watched.log && at.object == report.watched.object;
  report.watched = at;
  report.seconds = report.progress->in_object && same ? report.seconds + 1 : 0;
  const std::uint64_t read = report.progress->read;
  const std::uint64_t given = read > at.offset ? read - at.offset : 0;
  if (report.seconds > kSecondsOfAnObject + given / kBytesOfASecond) onCrash(signal);
}

}  // namespace

void dieWithParent() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
}

void limitProcess(const LogReadOptions& options) {
  constexpr std::uint64_t kBaseSeconds = 300;
  constexpr std::uint64_t kSecondsPerMegabyte = 10;
  std::uint64_t bytes = 0;
  for (const auto& log : options.logs) {
    std::error_code error;
    const auto size = std::filesystem::file_size(log, error);
    if (!error) bytes += size;
  }
  setLimit(RLIMIT_CPU, kBaseSeconds + kSecondsPerMegabyte * (bytes >> 20));
  setLimit(RLIMIT_CORE, 0);
#ifndef HOCTOMAP_SANITIZED  // which maps terabytes
  setLimit(RLIMIT_AS, options.address_space_bytes);
#endif
  struct stat out {};
  if (fstat(STDOUT_FILENO, &out) == 0 && !S_ISREG(out.st_mode)) setLimit(RLIMIT_FSIZE, 0);
}

void reportCrashes(LastWord kind, int fd, const std::vector<std::filesystem::path>& logs,
                   const ReadProgress& progress) {
  CrashReport& report = crashReport();
  report.kind = kind;
  report.fd = fd;
  report.progress = &progress;
  report.names.clear();
  for (const auto& log : logs) report.names.push_back(escapedText(log.string(), 500));
  report.stack.resize(std::size_t{1} << 16);
  const stack_t stack{.ss_sp = report.stack.data(), .ss_flags = 0, .ss_size = report.stack.size()};
  sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_handler = onCrash;
  action.sa_flags = SA_ONSTACK | static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU})
    sigaction(signal, &action, nullptr);
  action.sa_handler = onTick;
  action.sa_flags = SA_RESTART;
  sigaction(SIGPROF, &action, nullptr);
  const itimerval every_second{{1, 0}, {1, 0}};
  setitimer(ITIMER_PROF, &every_second, nullptr);
}

int takeOverOutput() {
  const int stream = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  if (stream < 0) throw FileError(std::string("cannot use stdout: ") + std::strerror(errno));
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }
  return stream;
}

}  // namespace hoctomap
