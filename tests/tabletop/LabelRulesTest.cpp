// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/LabelRules.h"

#include <gtest/gtest.h>

#include <numeric>

#include "hoctomap/tabletop/Tabletop.h"
#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

const Label kCup{"cup"};
const Label kPlate{"plate"};
const Label kDesk{"desk"};

/// A segment that fills a turned box: points on a 5 mm grid.
struct Filled {
  Measurement z;
  Segment segment;

  Filled(Structure structure, const Eigen::Vector3d& size, double bottom, double yaw) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    constexpr double kStep = 0.005;
    for (double x = 0.0; x <= size.x() + 1e-9; x += kStep) {
      for (double y = 0.0; y <= size.y() + 1e-9; y += kStep) {
        for (double h = 0.0; h <= size.z() + 1e-9; h += kStep)
          z.world_points.push_back((turn * Eigen::Vector3d(x, y, h + bottom)).cast<float>());
      }
    }
    segment.structure = structure;
    segment.points.resize(z.world_points.size());
    std::iota(segment.points.begin(), segment.points.end(), 0U);
  }
  [[nodiscard]] Label by(const std::vector<NamedRule>& rules) const {
    return makeTabletopLabeling(rules)->label(z, segment);
  }
};

NamedRule rule(const Label& label, RuleKind kind = RuleKind::object) {
  NamedRule named{label, {}};
  named.rule.kind = kind;
  return named;
}

TEST(LabelRules, WithoutAnyIsEquation10) {
  EXPECT_EQ(Filled(Structure::cluster, {0.1, 0.1, 0.1}, 0.7, 0.0).by({}), labels::object);
  EXPECT_EQ(Filled(Structure::plane, {0.8, 0.5, 0.0}, 0.7, 0.0).by({}), labels::table);
  EXPECT_EQ(Filled(Structure::remainder, {0.1, 0.1, 0.1}, 0.0, 0.0).by({rule(kCup)}), labels::background);
  EXPECT_EQ(Filled(Structure::cluster, {0.1, 0.1, 0.1}, 0.7, 0.0).by({rule(kCup, RuleKind::none)}),
            labels::object);
}

TEST(LabelRules, EveryLimitCountsWhicheverWayTheThingIsTurned) {
  for (const double yaw : {0.0, 0.4, 1.2, 2.9}) {
    const Filled thing(Structure::cluster, {0.12, 0.06, 0.09}, 0.7, yaw);
    for (const double margin : {-0.006, 0.006}) {
      NamedRule longest = rule(kCup);
      longest.rule.max_length = 0.12 + margin;
      NamedRule widest = rule(kCup);
      widest.rule.max_width = 0.06 + margin;
      NamedRule highest = rule(kCup);
      highest.rule.max_height = 0.09 + margin;
      NamedRule lowest = rule(kCup);
      lowest.rule.min_elevation = 0.7 - margin;
      for (const auto& r : {longest, widest, highest, lowest})
        EXPECT_EQ(thing.by({r}), margin > 0.0 ? kCup : labels::object) << yaw;
      NamedRule least = rule(kCup);
      least.rule.min_length = 0.12 - margin;
      least.rule.min_width = 0.06 - margin;
      least.rule.min_height = 0.09 - margin;
      EXPECT_EQ(thing.by({least}), margin > 0.0 ? kCup : labels::object) << yaw;
    }
  }
}

TEST(LabelRules, ShapesAreProportions) {
  const auto named = [](RuleShape shape) {
    NamedRule r = rule(kPlate);
    r.rule.shape = shape;
    return r;
  };
  const Filled flat(Structure::cluster, {0.2, 0.2, 0.02}, 0.7, 0.3);
  const Filled compact(Structure::cluster, {0.08, 0.08, 0.09}, 0.7, 0.3);
  const Filled tall(Structure::cluster, {0.07, 0.07, 0.25}, 0.7, 0.3);
  EXPECT_EQ(flat.by({named(RuleShape::flat)}), kPlate);
  EXPECT_EQ(flat.by({named(RuleShape::tall)}), labels::object);
  EXPECT_EQ(compact.by({named(RuleShape::compact)}), kPlate);
  EXPECT_EQ(compact.by({named(RuleShape::flat)}), labels::object);
  EXPECT_EQ(tall.by({named(RuleShape::tall)}), kPlate);
  EXPECT_EQ(tall.by({named(RuleShape::compact)}), labels::object);
}

TEST(LabelRules, TheLowestRankThatFitsDecides) {
  NamedRule first = rule(kPlate);
  first.rule.rank = 1;
  const Filled thing(Structure::cluster, {0.1, 0.1, 0.1}, 0.7, 0.0);
  EXPECT_EQ(thing.by({rule(kCup), first}), kPlate);
  EXPECT_EQ(thing.by({rule(kPlate), rule(kCup)}), kCup) << "of one rank, by name";
}

TEST(LabelRules, RelationsTakeThemForObjectsOrTables) {
  const RelationSet r = makeTabletopRelations({rule(kCup), rule(kDesk, RuleKind::table)});
  EXPECT_TRUE(r.mayHold(labels::table, kCup));
  EXPECT_TRUE(r.mayHold(labels::background, kCup));
  EXPECT_TRUE(r.mayHold(kDesk, kCup));
  EXPECT_TRUE(r.mayHold(kDesk, labels::object));
  EXPECT_TRUE(r.mayHold(labels::background, kDesk));
  EXPECT_FALSE(r.mayHold(kCup, labels::object));
  EXPECT_FALSE(r.mayHold(labels::object, kCup));
  EXPECT_FALSE(r.mayHold(kCup, kDesk));
}

TEST(LabelRules, LabelsOfOneKindMayBeOneObject) {
  const auto labeling =
      makeTabletopLabeling(std::vector{rule(kCup), rule(kPlate), rule(kDesk, RuleKind::table)});
  EXPECT_TRUE(labeling->areOfOneKind(kCup, labels::object));
  EXPECT_TRUE(labeling->areOfOneKind(kCup, kPlate));
  EXPECT_FALSE(labeling->areOfOneKind(kCup, kDesk));
  EXPECT_TRUE(labeling->areOfOneKind(kDesk, labels::table));
}

}  // namespace
}  // namespace hoctomap
