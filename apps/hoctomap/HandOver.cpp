// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "SimulatorCommands.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/ChildProcess.h"

namespace hoctomap {

namespace {

/// This process becomes the simulator, with the arguments it was started with.
[[noreturn]] void becomeSimulator() {
  const std::string program = findHelper("hoctomap-simulator").string();
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
  throw FileError(program + ": cannot be started: " + std::strerror(errno));
}

}  // namespace

int simulate(const SimulateOptions&) {
  becomeSimulator();
}

int explore(const ExploreOptions&) {
  becomeSimulator();
}

}  // namespace hoctomap
