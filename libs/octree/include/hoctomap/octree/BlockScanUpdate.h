// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "hoctomap/octree/ScanUpdate.h"

namespace hoctomap {

/// Which machine code the ray traversal uses. The result is the same to the last bit.
enum class Instructions {
  best,      ///< what this processor offers, found at run time
  avx2,      ///< at most AVX2, if it is there
  baseline,  ///< what every processor of the architecture has
};

/// The fast update: the same tree as `makeReferenceScanUpdate`, to the last byte of its `.ot` file, many
/// times faster (ENGINE.md says how many).
///
/// The voxels of a scan are collected as bits (two bitmaps, free and occupied), then the tree is updated in
/// one pass. Memory beyond the tree: 4 KB for each 32^3 voxels that a beam meets, at most about 8 MB at a
/// time and thread. Uses the threads of the calling oneTBB arena; the
/// tree is the same for any number of them. The memory is kept for the next update: use one engine for all of
/// them.
///
/// A tree with change detection enabled is updated by the reference, which keeps the record of changed keys.
/// One engine may serve several threads at once, each with its own tree.
[[nodiscard]] std::unique_ptr<ScanUpdate> makeBlockScanUpdate(Instructions instructions = Instructions::best);

}  // namespace hoctomap
