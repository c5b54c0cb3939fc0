// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "hoctomap/hierarchy/Relation.h"
#include "hoctomap/mapping/LabelingFunction.h"

namespace hoctomap {

/// What segments a rule names: none (it is no rule), objects (clusters), tables (planes).
enum class RuleKind { none, object, table };

/// Proportions of a segment: flat, less than a third as high as it is long; tall, higher than it is long and
/// half; compact, between the two.
enum class RuleShape { any, flat, compact, tall };

/// A rule of the labelling function by size, height and shape: a segment within all its limits gets the
/// label.
struct LabelRule {
  RuleKind kind = RuleKind::none;
  int rank = 100;            ///< rules are asked in this order, those of one rank by label
  double min_length = 0.0;   ///< m, larger side of the upright box around the segment, in the plan
  double max_length = -1.0;  ///< m; negative: no limit, here and below
  double min_width = 0.0;    ///< m, smaller side in the plan
  double max_width = -1.0;
  double min_height = 0.0;  ///< m, from its lowest to its highest point
  double max_height = -1.0;
  double min_elevation = -1000.0;  ///< m, z of its lowest point in the world
  double max_elevation = 1000.0;
  RuleShape shape = RuleShape::any;
};

struct NamedRule {
  Label label;
  LabelRule rule;
};

/// L' of Eq. 10 with rules: the first rule of the segment's kind that fits names it; without one, as in
/// Eq. 10. Rules without a kind are left out.
[[nodiscard]] std::unique_ptr<LabelingFunction> makeTabletopLabeling(std::vector<NamedRule> rules);

/// r' of Eq. 11, for which every label of a rule is an object, or a table if the rule is for tables; with the
/// choice among tables of `makeTabletopRelations()`.
[[nodiscard]] RelationSet makeTabletopRelations(std::vector<NamedRule> rules);

}  // namespace hoctomap
