// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/Gnuplot.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/CsvText.h"

namespace hoctomap {

namespace {

namespace fs = std::filesystem;

/// A script for gnuplot that is gone at the end.
class ScriptFile {
 public:
  explicit ScriptFile(const std::string& text) {
    std::string name = (fs::temp_directory_path() / "hoctomap-plot-XXXXXX").string();
    const UniqueFd fd(::mkstemp(name.data()));
    if (fd.get() < 0) throw FileError(name + ": cannot make a temporary file");
    path_ = name;
    writeTextFile(path_, text);
  }
  ~ScriptFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

/// @param what needs it, for people
fs::path findGnuplot(const std::string& what) {
  if (const char* set = std::getenv("HOCTOMAP_GNUPLOT"); set != nullptr && *set != '\0') return set;
  const char* path = std::getenv("PATH");
  std::istringstream places(path == nullptr ? "/usr/bin:/bin" : path);
  for (std::string place; std::getline(places, place, ':');) {
    const fs::path program = fs::path(place) / "gnuplot";
    if (!place.empty() && ::access(program.c_str(), X_OK) == 0) return program;
  }
  throw FileError(what + " needs gnuplot, which is not installed (Debian package gnuplot-nox)");
}

std::string readAll(int fd) {
  std::string bytes;
  std::string buffer(std::size_t{1} << 16U, '\0');
  while (true) {
    const auto got = ::read(fd, buffer.data(), buffer.size());
    if (got > 0) bytes.append(buffer, 0, static_cast<std::size_t>(got));
    if (got == 0 || (got < 0 && errno != EINTR)) return bytes;
  }
}

}  // namespace

std::string drawWithGnuplot(const std::string& script, const std::string& what) {
  const ScriptFile file(script);
  const fs::path gnuplot = findGnuplot(what);
  ChildProcess child({.program = gnuplot,
                      .arguments = {file.path()},
                      .output = ChildProcess::Stream::pipe,
                      .own_group = false});
  std::string picture = readAll(child.outputFd());
  const ExitStatus status = child.wait();
  if (status.code != 0 || status.signal != 0 || picture.empty())
    throw FileError(what + ": " + gnuplot.string() + " could not draw it");
  return picture;
}

}  // namespace hoctomap
