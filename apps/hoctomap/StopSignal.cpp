// SPDX-License-Identifier: BSD-3-Clause
#include "StopSignal.h"

#include <csignal>

namespace hoctomap {

namespace {

// A signal handler can reach nothing but this.
volatile std::sig_atomic_t g_signal = 0;

void remember(int signal) {
  g_signal = signal;
}

}  // namespace

StopSignal::StopSignal() {
  struct sigaction action = {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
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
