// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <cctype>
#include <cstdlib>
#include <system_error>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/ChildProcess.h"

namespace hoctomap {

namespace {

/// hoctomap-mrpt -> HOCTOMAP_MRPT
std::string variableOf(std::string name) {
  for (char& c : name) c = c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

bool isProgram(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) && ::access(path.c_str(), X_OK) == 0;
}

}  // namespace

std::filesystem::path findHelper(const std::string& name) {
  const std::string variable = variableOf(name);
  if (const char* set = std::getenv(variable.c_str()); set != nullptr && *set != '\0') {
    if (isProgram(set)) return set;
    throw FileError(variable + "=" + set + " is not a program");
  }
  std::error_code error;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<std::filesystem::path> places{here / name, here.parent_path() / "libexec" / "hoctomap" / name};
  // Build tree: programs lie in apps/NAME/NAME, tests in tests/LIBRARY/.
  for (auto root = here; root.has_relative_path() && places.size() < 6; root = root.parent_path())
    places.push_back(root / "apps" / name / name);
  for (const auto& place : places) {
    if (isProgram(place)) return place;
  }
  throw FileError("cannot find the helper program " + name + " beside the program, in " +
                  places[1].parent_path().lexically_normal().string() + " or in a build tree; set " +
                  variable);
}

int runHelper(const std::vector<std::string>& arguments) {
  ChildProcess child({.program = findHelper(),
                      .arguments = arguments,
                      .input = ChildProcess::Stream::inherit,
                      .output = ChildProcess::Stream::inherit,
                      .own_group = false});
  const ExitStatus status = child.wait();
  return status.signal != 0 ? 128 + status.signal : status.code;
}

}  // namespace hoctomap
