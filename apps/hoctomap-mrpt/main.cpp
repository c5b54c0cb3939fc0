// SPDX-License-Identifier: BSD-3-Clause
// The helper of hoctomap: the only program that reads and writes MRPT's logs and scenes.
#include <CLI/CLI.hpp>
#include <iostream>

#include "Verb.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/ScanStream.h"

namespace {

int runVerb(const hoctomap::VerbRun& run) {
  try {
    return run();
  } catch (const hoctomap::Error& error) {
    std::cerr << "hoctomap-mrpt: " << hoctomap::escapedText(error.what()) << "\n";
    return hoctomap::exitCodeOf(error);
  } catch (const std::bad_alloc&) {
    std::cerr << "hoctomap-mrpt: not enough memory\n";
    return 6;
  } catch (const std::exception& error) {
    std::cerr << "hoctomap-mrpt: " << hoctomap::escapedText(error.what()) << "\n";
    return hoctomap::exitCodeOf(error);
  }
}

}  // namespace

#ifdef HOCTOMAP_SANITIZED
// The search for leaks takes a process of its own, which confinement forbids.
extern "C" int __lsan_is_turned_off();   // NOLINT: the sanitizer's name
extern "C" int __lsan_is_turned_off() {  // NOLINT
  return 1;
}
#endif

int main(int argc, char** argv) {
  CLI::App app("Helper of hoctomap: logs and scenes of MRPT");
  app.require_subcommand(1);
  hoctomap::VerbRun run;
  hoctomap::addReadCommand(app, run);
  hoctomap::addWriteLogCommand(app, run);
  hoctomap::addInfoCommand(app, run);
#ifdef HOCTOMAP_VERB_SCENE
  hoctomap::addSceneCommand(app, run);
#endif
#ifdef HOCTOMAP_VERB_RENDER
  hoctomap::addRenderCommand(app, run);
#endif
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return runVerb(run);
}
