// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/exploration/ExplorationStep.h"

#include <algorithm>

namespace hoctomap {

std::string toString(StepKind kind) {
  switch (kind) {
    case StepKind::look_around:
      return "look_around";
    case StepKind::first_view:
      return "first_view";
    case StepKind::view:
      return "view";
    case StepKind::move_failed:
      return "move_failed";
    case StepKind::explored:
      return "explored";
    case StepKind::unreachable:
      return "unreachable";
    case StepKind::out_of_views:
      break;
  }
  return "out_of_views";
}

double ExplorationStep::mostGain() const {
  double most = 0.0;
  for (const Candidate& c : candidates) most = std::max(most, c.gain);
  return most;
}

void ExplorationStep::choose(double least) {
  chosen.reset();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].gain <= least) continue;
    if (!chosen || candidates[i].utility > candidates[*chosen].utility) chosen = i;
  }
}

}  // namespace hoctomap
