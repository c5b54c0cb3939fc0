// SPDX-License-Identifier: BSD-3-Clause
#include "ExistencePlot.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <sstream>

#include "TextTable.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/AtomicFile.h"
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

fs::path findGnuplot() {
  if (const char* set = std::getenv("HOCTOMAP_GNUPLOT"); set != nullptr && *set != '\0') return set;
  const char* path = std::getenv("PATH");
  std::istringstream places(path == nullptr ? "/usr/bin:/bin" : path);
  for (std::string place; std::getline(places, place, ':');) {
    const fs::path program = fs::path(place) / "gnuplot";
    if (!place.empty() && ::access(program.c_str(), X_OK) == 0) return program;
  }
  throw FileError("--plot needs gnuplot, which is not installed (Debian package gnuplot-nox)");
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

/// `scan existence`, a step each time it changed.
std::string existenceData(const NodeLife& life, std::uint64_t last_scan) {
  std::string text = "$existence << EOD\n";
  text += std::to_string(life.record.first_scan) + " " + fixedText(life.firstExistence(), 9) + "\n";
  double last = life.firstExistence();
  for (const ExistenceRow& row : life.evidence) {
    text += std::to_string(row.scan) + " " + fixedText(row.p_posterior, 9) + "\n";
    last = row.p_posterior;
  }
  if (life.in_map) text += std::to_string(last_scan) + " " + fixedText(last, 9) + "\n";
  return text + "EOD\n";
}

std::string evidenceData(const NodeLife& life) {
  std::string text = "$evidence << EOD\n";
  for (const ExistenceRow& row : life.evidence) {
    text += std::to_string(row.scan) + " " + std::to_string(row.present) + " " + std::to_string(row.absent) +
            " " + std::to_string(row.occluded) + " " + fixedText(row.p_measurement, 9) + "\n";
  }
  return text + "EOD\n";
}

/// Lines at the scans in which something but an update happened.
std::string eventMarks(const NodeLife& life) {
  std::string text;
  int height = 0;
  for (const EventRow& event : life.events) {
    if (event.event == "updated") continue;
    const std::string scan = std::to_string(event.scan);
    const std::string y = fixedText(0.08 + 0.08 * (height++ % 3), 2);
    text += "set arrow from " + scan + ", graph 0 to " + scan + ", graph 1 nohead dt 3 lc rgb '#606060'\n";
    // Events are words of the format; anything else stays out of the script.
    const bool is_word =
        std::all_of(event.event.begin(), event.event.end(), [](char c) { return c >= 'a' && c <= 'z'; });
    if (is_word) text += "set label '" + event.event + "' at " + scan + ", graph " + y + " offset 0.5,0\n";
  }
  return text;
}

std::string panels(const NodeLife& life) {
  const std::string prior = fixedText(life.prior, 9);
  std::string text =
      "set lmargin 11\nset rmargin 3\nset grid ytics lc rgb '#d8d8d8'\nset border 3\nset tics nomirror out\n"
      "set multiplot\n"
      "set origin 0,0.42\nset size 1,0.58\nset bmargin 0.5\nset tmargin 3\nset format x ''\n"
      "set ylabel 'existence' offset -0.5,0\nset yrange [0:1]\nset ytics 0.25\n"
      "set key above right horizontal samplen 2\n" +
      eventMarks(life) +
      "plot 0.5 with lines dt 2 lc rgb '#606060' title 'removed below', \\\n"
      "  $existence using 1:2 with steps lw 2.5 lc rgb '#0072b2' title 'P(n | z_{1:t})'";
  if (!life.evidence.empty()) {
    text += ", \\\n  $evidence using 1:(abs($5 - " + prior +
            ") > 1e-9 ? $5 : NaN) with points pt 7 ps 0.5 lc rgb '#e69f00' title 'P(n | z_t)'";
  }
  text +=
      "\nunset arrow\nunset label\nunset title\n"
      "set origin 0,0\nset size 1,0.42\nset tmargin 2\nset bmargin 3.2\nset format x '%g'\n"
      "set xlabel 'scan'\nset ylabel 'beams' offset -0.5,0\nset yrange [0:*]\nset ytics autofreq\n";
  if (life.evidence.empty()) return text + "unset key\nset yrange [0:1]\nplot -1 notitle\nunset multiplot\n";
  return text +
         "set style fill solid 0.85 noborder\nset boxwidth 0.8\n"
         "plot $evidence using 1:($2 + $3 + $4) with boxes lc rgb '#bbbbbb' title 'occluded', \\\n"
         "  $evidence using 1:($2 + $3) with boxes lc rgb '#d55e00' title 'absent', \\\n"
         "  $evidence using 1:2 with boxes lc rgb '#009e73' title 'present'\n"
         "unset multiplot\n";
}

}  // namespace

std::string existencePlotScript(const NodeLife& life, std::uint64_t last_scan) {
  const double first = static_cast<double>(life.record.first_scan) - 0.8;
  const double last = static_cast<double>(last_scan) + 0.8;
  return "set terminal svg size 760,480 background '#ffffff' font 'sans,12'\nset encoding utf8\n" +
         existenceData(life, last_scan) + evidenceData(life) + "set xrange [" + fixedText(first, 1) + ":" +
         fixedText(last, 1) + "]\n" + panels(life);
}

void drawExistence(const NodeLife& life, std::uint64_t last_scan, const fs::path& file) {
  const ScriptFile script(existencePlotScript(life, last_scan));
  const fs::path gnuplot = findGnuplot();
  ChildProcess child({.program = gnuplot,
                      .arguments = {script.path()},
                      .output = ChildProcess::Stream::pipe,
                      .own_group = false});
  const std::string svg = readAll(child.outputFd());
  const ExitStatus status = child.wait();
  if (status.code != 0 || status.signal != 0 || svg.find("</svg>") == std::string::npos) {
    throw FileError(file.string() + ": " + gnuplot.string() + " could not draw it");
  }
  replaceFile(file, svg);
}

}  // namespace hoctomap
