// SPDX-License-Identifier: BSD-3-Clause
#include "SceneMaker.h"

#include <string>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

SceneMaker::SceneMaker()
    : helper_({.program = findHelper(),
               .arguments = {"scene", "--told"},
               .input = ChildProcess::Stream::pipe,
               .output = ChildProcess::Stream::null}) {}

void SceneMaker::operator()(const std::filesystem::path& directory, const std::filesystem::path& file) {
  const std::string names = directory.string() + '\0' + file.string() + '\0';
  try {
    helper_.send(names);
    helper_.closeInput();
  } catch (const FileError&) {
    // It has ended: its exit code says so, too.
  }
  const ExitStatus status = helper_.wait();
  if (status.signal != 0 || status.code != 0) {
    throw FileError(file.string() + ": the scene could not be written");
  }
}

void makeScene(const std::filesystem::path& directory, const std::filesystem::path& file) {
  SceneMaker()(directory, file);
}

}  // namespace hoctomap
