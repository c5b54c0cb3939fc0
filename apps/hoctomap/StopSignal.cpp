// SPDX-License-Identifier: BSD-3-Clause
#include "StopSignal.h"

#include <csignal>

namespace hoctomap {

namespace {

// A signal handler can reach nothing but this.
volatile std::sig_atomic_t g_signal = 0;

/// The first signal asks to stop; the second, whichever of them it is, ends the program where it stands.
void remember(int signal) {
  if (g_signal != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  g_signal = signal;
}

}  // namespace

StopSignal::StopSignal() {
  struct sigaction action = {};
  action.sa_handler = remember;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A file-size limit is then an error of the write, with a message and an exit code of its own.
  std::signal(SIGXFSZ, SIG_IGN);
}

int StopSignal::requested() {
  return g_signal;
}

}  // namespace hoctomap
