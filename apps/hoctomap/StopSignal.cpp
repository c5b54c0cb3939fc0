// SPDX-License-Identifier: BSD-3-Clause
#include "StopSignal.h"

#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <string_view>

namespace hoctomap {

namespace {

/// How long an orderly stop may take, in microseconds, so that it is over within two seconds: what the system
/// then needs to take back the memory is part of them. (8.4 GB took it 0.75 s on an idle machine; here half
/// that speed.)
long patience() {
  constexpr long kMost = 1'500'000;
  constexpr long kLeast = 100'000;
  constexpr long kMegabytesPerSecond = 5'000;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const long megabytes = usage.ru_maxrss / 1024;
  return std::max(kLeast, kMost - megabytes * (1'000'000 / kMegabytesPerSecond));
}

// A signal handler can reach nothing but these.
volatile std::sig_atomic_t g_signal = 0;
volatile std::sig_atomic_t g_gives_up = 0;

/// The first signal asks to stop; the second, whichever of them it is, ends the program where it stands.
void remember(int signal) {
  if (g_signal != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  g_signal = signal;
  if (g_gives_up == 0) return;
  const long us = patience();
  const itimerval once{{0, 0}, {us / 1'000'000, us % 1'000'000}};
  ::setitimer(ITIMER_REAL, &once, nullptr);
}

/// The scan at work, its commit, or the scene takes too long.
void giveUp(int /*signal*/) {
  if (g_signal == 0) return;
  constexpr std::string_view kMessage =
      "\nhoctomap: stopped without waiting for the work at hand; what was committed stands\n";
  static_cast<void>(!::write(STDERR_FILENO, kMessage.data(), kMessage.size()));
  ::_exit(128 + g_signal);
}

}  // namespace

StopSignal::StopSignal(LongWork long_work) {
  g_gives_up = long_work == LongWork::given_up ? 1 : 0;
  struct sigaction action = {};
  sigemptyset(&action.sa_mask);
  action.sa_handler = giveUp;
  action.sa_flags = SA_RESTART;
  sigaction(SIGALRM, &action, nullptr);
  action.sa_handler = remember;
  action.sa_flags = 0;
  sigaddset(&action.sa_mask, SIGALRM);  // never before what it is about
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A file-size limit is then an error of the write, with a message and an exit code of its own.
  std::signal(SIGXFSZ, SIG_IGN);
}

int StopSignal::requested() {
  return g_signal;
}

}  // namespace hoctomap
