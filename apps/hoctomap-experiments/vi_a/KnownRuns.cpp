// SPDX-License-Identifier: BSD-3-Clause
#include "vi_a/KnownRuns.h"

#include <array>
#include <utility>
#include <vector>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

constexpr std::array kRunFigures{"points",    "user_s",     "cpu_s", "wall_s",
                                 "map_bytes", "peak_bytes", "nodes", "ot_sha256"};
constexpr std::size_t kKeyColumns = 5;

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields{""};
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

}  // namespace

std::string runsCsvHeader() {
  std::string header = "set,resolution_mm,method,scans,repeat";
  for (const char* name : kRunFigures) header += std::string(",") + name;
  return header + "\n";
}

KnownRuns parseRuns(const std::string& csv) {
  if (!csv.starts_with(runsCsvHeader())) throw InputError("vi_a_runs.csv has other columns");
  KnownRuns runs;
  std::size_t begin = runsCsvHeader().size();
  for (std::size_t end = 0; (end = csv.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const auto fields = fieldsOf(csv.substr(begin, end - begin));
    if (fields.size() != kKeyColumns + kRunFigures.size()) continue;
    Figures figures;
    for (std::size_t i = 0; i < kRunFigures.size(); ++i) {
      if (!fields[kKeyColumns + i].empty()) figures.add(kRunFigures[i], fields[kKeyColumns + i]);
    }
    std::string key = fields[0];
    for (std::size_t i = 1; i < kKeyColumns; ++i) key += "," + fields[i];
    runs[key] = std::move(figures);
  }
  return runs;
}

std::string runsCsvLine(const std::string& key, const Figures& figures) {
  std::string line = key;
  for (const char* name : kRunFigures) line += "," + (figures.contains(name) ? figures.text(name) : "");
  return line + "\n";
}

}  // namespace hoctomap
