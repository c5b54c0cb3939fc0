// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vi_b/Sequence.h"

namespace hoctomap {

/// One row a sequence. Fields about the removed object are empty if there is none.
[[nodiscard]] std::string resultsCsv(const std::vector<SequenceResult>& results);

/// One row a sequence and scan: what the hierarchy made of the object that was taken away.
[[nodiscard]] std::string existenceCsv(const std::vector<SequenceResult>& results);

/// What docs/reproduction.md shows: both tables.
[[nodiscard]] std::string resultsMarkdown(const std::vector<SequenceResult>& results);

}  // namespace hoctomap
