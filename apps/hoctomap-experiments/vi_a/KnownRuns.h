// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "measuring/Figures.h"

namespace hoctomap {

/// Runs that have been made, by `set,resolution_mm,method,scans,repeat`.
using KnownRuns = std::map<std::string, Figures>;

/// The runs of a CSV that an earlier, perhaps unfinished, experiment has written. A last line that is not
/// whole is left out.
/// @throws InputError if the columns are others than those of `runsCsvHeader()`
[[nodiscard]] KnownRuns parseRuns(const std::string& csv);

/// `set,resolution_mm,method,scans,repeat,points,user_s,cpu_s,wall_s,map_bytes,peak_bytes,nodes,ot_sha256`
[[nodiscard]] std::string runsCsvHeader();

/// The line of one run. @param key as in `KnownRuns`
[[nodiscard]] std::string runsCsvLine(const std::string& key, const Figures& figures);

}  // namespace hoctomap
