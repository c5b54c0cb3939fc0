// SPDX-License-Identifier: BSD-3-Clause
#include "Program.h"

int main(int argc, char** argv) {
  CLI::App app{
      "hoctomap turns recorded 3D measurements with known sensor poses into a hierarchy of octree maps."};
  app.name("hoctomap");
  app.footer(
      "\nExit codes: 0 done, 2 usage or configuration, 3 input, 4 map, 5 files, 6 limit, 130/143 stopped.\n"
      "Help of a command: hoctomap COMMAND --help\n");
  hoctomap::Action action;
  hoctomap::addBuildCommand(app, action);
  hoctomap::addSegmentCommand(app, action);
  hoctomap::addInfoCommand(app, action);
  hoctomap::addRenderCommand(app, action);
  hoctomap::addReportCommand(app, action);
  hoctomap::addExplainCommand(app, action);
  hoctomap::addDiffCommand(app, action);
  hoctomap::addQueryCommand(app, action);
  hoctomap::addEditCommand(app, action);
  hoctomap::addMergeCommand(app, action);
  hoctomap::addVerifyCommand(app, action);
  hoctomap::addExportCommand(app, action);
  hoctomap::addImportCommand(app, action);
  hoctomap::addSimulateCommand(app, action);
  hoctomap::addExploreCommand(app, action);
  hoctomap::addDocumentationCommand(app, action);
  return hoctomap::runProgram(app, action, argc, argv);
}
