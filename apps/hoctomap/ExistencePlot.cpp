// SPDX-License-Identifier: BSD-3-Clause
#include "ExistencePlot.h"

#include <algorithm>

#include "TextTable.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/AtomicFile.h"
#include "hoctomap/io/Gnuplot.h"

namespace hoctomap {

namespace {

namespace fs = std::filesystem;

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
  const std::string svg = drawWithGnuplot(existencePlotScript(life, last_scan), "--plot");
  if (svg.find("</svg>") == std::string::npos) throw FileError(file.string() + ": gnuplot could not draw it");
  replaceFile(file, svg);
}

}  // namespace hoctomap
