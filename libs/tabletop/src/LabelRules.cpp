// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/LabelRules.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>

#include "TableChoice.h"
#include "hoctomap/tabletop/Tabletop.h"

namespace hoctomap {
namespace {

struct Extents {
  double length = 0.0;
  double width = 0.0;
  double height = 0.0;
  double elevation = 0.0;
};

/// Of the upright box along the principal axes of the segment in the plan, metres.
Extents extentsOf(const Measurement& z, const Segment& segment) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto i : segment.points) mean += z.world_points[i].head<2>().cast<double>();
  mean /= static_cast<double>(segment.points.size());
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (const auto i : segment.points) {
    const Eigen::Vector2d d = z.world_points[i].head<2>().cast<double>() - mean;
    covariance += d * d.transpose();
  }
  const Eigen::Matrix2d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance).eigenvectors();
  Eigen::AlignedBox3d box;
  for (const auto i : segment.points) {
    const Eigen::Vector3d p = z.world_points[i].cast<double>();
    const Eigen::Vector2d plan = axes.transpose() * p.head<2>();
    box.extend(Eigen::Vector3d(plan.x(), plan.y(), p.z()));
  }
  const Eigen::Vector3d sizes = box.sizes();
  return {std::max(sizes.x(), sizes.y()), std::min(sizes.x(), sizes.y()), sizes.z(), box.min().z()};
}

bool isWithin(double value, double low, double high) {
  return value >= low && (high < 0.0 || value <= high);
}

RuleShape shapeOf(const Extents& e) {
  if (e.height < e.length / 3.0) return RuleShape::flat;
  return e.height > 1.5 * e.length ? RuleShape::tall : RuleShape::compact;
}

bool fits(const LabelRule& rule, const Extents& e) {
  return isWithin(e.length, rule.min_length, rule.max_length) &&
         isWithin(e.width, rule.min_width, rule.max_width) &&
         isWithin(e.height, rule.min_height, rule.max_height) && e.elevation >= rule.min_elevation &&
         e.elevation <= rule.max_elevation && (rule.shape == RuleShape::any || rule.shape == shapeOf(e));
}

/// The rules in the order in which they are asked.
std::vector<NamedRule> inOrder(std::vector<NamedRule> rules) {
  std::erase_if(rules, [](const NamedRule& r) { return r.rule.kind == RuleKind::none; });
  std::sort(rules.begin(), rules.end(), [](const NamedRule& a, const NamedRule& b) {
    return std::pair(a.rule.rank, a.label) < std::pair(b.rule.rank, b.label);
  });
  return rules;
}

class RuleLabeling : public LabelingFunction {
 public:
  explicit RuleLabeling(std::vector<NamedRule> rules) : rules_(inOrder(std::move(rules))) {}

  [[nodiscard]] Label label(const Measurement& z, const Segment& segment) const override {
    const RuleKind kind = segment.structure == Structure::cluster ? RuleKind::object
                          : segment.structure == Structure::plane ? RuleKind::table
                                                                  : RuleKind::none;
    if (kind != RuleKind::none && !rules_.empty() && !segment.points.empty()) {
      const Extents extents = extentsOf(z, segment);
      for (const NamedRule& r : rules_) {
        if (r.rule.kind == kind && fits(r.rule, extents)) return r.label;
      }
    }
    return plain_->label(z, segment);
  }

  [[nodiscard]] bool areOfOneKind(const Label& a, const Label& b) const override {
    return kindOf(a) == kindOf(b) && (a == b || kindOf(a) != labels::background);
  }

  /// The label of Eq. 10 and 11 that a label stands for.
  [[nodiscard]] Label kindOf(const Label& label) const {
    const auto found =
        std::find_if(rules_.begin(), rules_.end(), [&](const NamedRule& r) { return r.label == label; });
    if (found == rules_.end()) return label;
    return found->rule.kind == RuleKind::table ? labels::table : labels::object;
  }

 private:
  std::vector<NamedRule> rules_;
  std::unique_ptr<LabelingFunction> plain_ = makeTabletopLabeling();
};

}  // namespace

std::unique_ptr<LabelingFunction> makeTabletopLabeling(std::vector<NamedRule> rules) {
  return std::make_unique<RuleLabeling>(std::move(rules));
}

RelationSet makeTabletopRelations(std::vector<NamedRule> rules) {
  const auto named = std::make_shared<const RuleLabeling>(std::move(rules));
  const std::shared_ptr<const Relation> plain = makeTabletopRelation();
  RelationSet relations;
  relations.add(
      makeLabelRelation("supports", [named, plain](const Label& above, const Label& below) {  // Eq. (11)
        return plain->mayHold(named->kindOf(above), named->kindOf(below));
      }));
  relations.setTieBreak(preferredTable, reachOfChoice);
  return relations;
}

}  // namespace hoctomap
