// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "hoctomap/io/Manifest.h"
#include "hoctomap/query/HierarchyDiff.h"

namespace hoctomap {

/// One of the two maps of a comparison, as it is named in the output.
struct ComparedMap {
  std::string path;
  const Manifest& manifest;
};

/// For people: a table, and a last line that counts.
[[nodiscard]] std::string diffText(const ComparedMap& a, const ComparedMap& b,
                                   std::span<const Change> changes);

/// For programs: one object. @param a_T_b as 16 numbers in it
[[nodiscard]] std::string diffJson(const ComparedMap& a, const ComparedMap& b, const Pose& a_T_b,
                                   std::span<const Change> changes);

/// `diff.csv` (docs/map-format.md).
[[nodiscard]] std::string diffCsv(std::span<const Change> changes);

}  // namespace hoctomap
