// SPDX-License-Identifier: BSD-3-Clause
#include "StopSignal.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace hoctomap {

namespace {

/// What an orderly stop may take. Users wait two seconds at most; to end a large process takes its part of
/// them.
constexpr unsigned kPatience = 1;  // s

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
  ::alarm(kPatience);
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
