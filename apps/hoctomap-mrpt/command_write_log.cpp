// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <memory>

#include "ProcessGuards.h"
#include "Verb.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/mrpt_io/LogWriter.h"

namespace hoctomap {

namespace {

struct WriteOptions {
  std::string log;
  double depth_unit = 0.001;
  bool external_images = false;
  bool report = false;
};

/// Takes messages from stdin up to the end message and completes the log; without one (the sender died)
/// nothing stays behind.
StreamEnd writeLog(const WriteOptions& options) {
  LogWriter writer(options.log, options.depth_unit, options.external_images);
  ScanStreamReader reader(STDIN_FILENO);
  for (;;) {
    const StreamMessage message = reader.read();
    if (const auto* end = std::get_if<StreamEnd>(&message)) {
      writer.finish();
      return *end;
    }
    if (const auto* error = std::get_if<StreamError>(&message)) throwStreamError(*error);
    writer.write(message);
  }
}

StreamMessage resultOf(const WriteOptions& options) {
  try {
    return writeLog(options);
  } catch (const std::exception& error) {
    return StreamError{exitCodeOf(error), error.what()};
  }
}

int writeLogReporting(const WriteOptions& options) {
  const int stream = takeOverOutput();
  const StreamMessage result = resultOf(options);
  try {
    ScanStreamWriter(stream).write(result);
  } catch (const FileError&) {
    // The sender is gone: nobody to tell.
  }
  const auto* error = std::get_if<StreamError>(&result);
  return error == nullptr ? 0 : error->exit_code;
}

}  // namespace

void addWriteLogCommand(CLI::App& app, VerbRun& run) {
  auto* verb = app.add_subcommand("write-log", "write a rawlog from binary messages on stdin");
  const auto options = std::make_shared<WriteOptions>();
  verb->add_option("log", options->log, "rawlog to write")->required();
  verb->add_option("--depth-unit", options->depth_unit, "metres a step of the 16-bit range images")
      ->check(CLI::PositiveNumber);
  verb->add_flag("--external-images", options->external_images, "images as files beside the log");
  verb->add_flag("--report-on-stdout", options->report, "answer with a binary message");
  verb->callback([=, &run] {
    run = [=] {
      if (options->report) return writeLogReporting(*options);
      writeLog(*options);
      return 0;
    };
  });
}

}  // namespace hoctomap
