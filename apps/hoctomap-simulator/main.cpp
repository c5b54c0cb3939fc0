// SPDX-License-Identifier: BSD-3-Clause
#include "Program.h"

int main(int argc, char** argv) {
  CLI::App app{"What `hoctomap` becomes for the commands that simulate."};
  app.name("hoctomap");
  hoctomap::Action action;
  hoctomap::addSimulateCommand(app, action);
  hoctomap::addExploreCommand(app, action);
  return hoctomap::runProgram(app, action, argc, argv);
}
