// SPDX-License-Identifier: BSD-3-Clause
#include "PlaceEvidence.h"

#include <algorithm>

namespace hoctomap {

namespace {

constexpr double kSupportMargin = 0.02;  // m about the mean height of a table: tilt, noise, voxels
constexpr double kBesideSupport = 0.05;  // m; so far beside a table's box things still stand on it
constexpr double kSinking = 0.012;       // m below the table's height next to the thing
constexpr double kMostSunk = 0.05;       // share of a thing that may come to lie below its table
constexpr double kShadowLength = 2.0;  // times the height of what throws it: cameras look down by 27 degrees

}  // namespace

double PlaceEvidence::reach(const Thing& thing, const Thing& on) const {
  return config_.near + 0.5 * (thing.resolution + on.resolution);
}

/// What a thing stands on: its parent, if that is no thing of its own kind.
const Thing* PlaceEvidence::supportOf(const MapSide& side, const Thing& thing) const {
  if (!thing.parent) return nullptr;
  const auto parent = side.find(*thing.parent);
  if (!parent || side.things()[*parent].label == thing.label) return nullptr;
  return &side.things()[*parent];
}

/// The other map's table below a place.
const Thing* PlaceEvidence::supportAt(const Thing& thing, const Eigen::Vector3d& p) const {
  const Thing* own = supportOf(own_, thing);
  if (own == nullptr) return nullptr;
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kBesideSupport);
  for (const Thing& table : other_.things()) {
    if (table.label != own->label || table.height > p.z() + kBesideSupport) continue;
    const Eigen::Vector3d at(p.x(), p.y(), table.height);
    if (Eigen::AlignedBox3d(table.bounds.min() - margin, table.bounds.max() + margin).contains(at)) {
      return &table;
    }
  }
  return nullptr;
}

/// Who sees the top of a table can see that nothing stands on it: to a table's voxel, which is much more
/// exact than the free space of the background. It says nothing where the thing does not hide the table from
/// its own map: below a handle, or at its foot.
PlaceEvidence::Support PlaceEvidence::support(const Thing& thing, const Eigen::Vector3d& from,
                                              const Eigen::Vector3d& to) const {
  const auto isSeen = [](const MapSide& side, const Thing& table, const Eigen::Vector2d& xy, double z) {
    return side.surfaceIn(table.label, xy, z + kSupportMargin, z - kSupportMargin);
  };
  const Thing* there = supportAt(thing, to);
  if (there == nullptr) return Support::unknown;
  const double height = there->heightNear(to.head<2>());
  if (!isSeen(other_, *there, to.head<2>(), height)) return Support::unknown;
  // At a thing's foot there are voxels of the table that it stands on in part.
  for (const double step : {-there->resolution, there->resolution}) {
    if (!isSeen(other_, *there, to.head<2>() + Eigen::Vector2d(step, 0.0), height) ||
        !isSeen(other_, *there, to.head<2>() + Eigen::Vector2d(0.0, step), height)) {
      return Support::unknown;
    }
  }
  const Thing* here = supportOf(own_, thing);
  if (here == nullptr) return Support::seen;
  const bool by_both = isSeen(own_, *here, from.head<2>(), here->heightNear(from.head<2>()));
  return by_both ? Support::seen_by_both : Support::seen;
}

/// Whether some thing of the other map may hide a place from its cameras, which look down. There a coarse
/// voxel that is free says little: the shadow of a small thing is narrower than it.
bool PlaceEvidence::mayLieInShadow(const Eigen::Vector3d& p) const {
  return std::any_of(other_.things().begin(), other_.things().end(), [&p](const Thing& thing) {
    const double above = thing.bounds.max().z() - p.z();
    if (above <= 0.0) return false;
    const Eigen::Vector3d level(p.x(), p.y(), thing.bounds.max().z());
    return thing.bounds.exteriorDistance(level) <= kShadowLength * above;
  });
}

Place PlaceEvidence::placeAt(const Eigen::Vector3d& p, Trust trust) const {
  const Place fine = other_.at(p, Trust::fine);
  if (fine != Place::unknown || trust == Trust::fine) return fine;
  if (trust == Trust::sure && mayLieInShadow(p)) return Place::unknown;
  return other_.at(p, trust);
}

template <typename IsMatched>
Cover PlaceEvidence::count(const Thing& thing, const Eigen::Isometry3d& motion, Trust trust,
                           const IsMatched& is_matched) const {
  std::size_t matched = 0;
  std::size_t contradicted = 0;
  std::size_t seen = 0;
  for (const auto& voxel : thing.sample) {
    const Eigen::Vector3d from = voxel.cast<double>();
    const Eigen::Vector3d to = motion * from;
    if (is_matched(to.cast<float>())) {
      ++matched;
      ++seen;
      continue;
    }
    const Place place = placeAt(to, trust);
    const Support support = this->support(thing, from, to);
    if (place == Place::free || support == Support::seen) ++contradicted;
    if (place != Place::unknown || support != Support::unknown) ++seen;
  }
  const auto share = [&thing](std::size_t part) {
    return static_cast<double>(part) / static_cast<double>(thing.sample.size());
  };
  return {share(matched), share(contradicted), share(seen)};
}

Sight PlaceEvidence::sight(const Thing& thing, const Eigen::Vector3d& p) const {
  const Place place = placeAt(p, Trust::sure);
  if (place == Place::free) return Sight::seen_through;
  if (place == Place::occupied) return Sight::surface;
  return support(thing, p, p) == Support::unknown ? Sight::hidden : Sight::seen_through;
}

std::optional<double> PlaceEvidence::supportHeight(const Thing& thing) const {
  const Thing* table = supportOf(own_, thing);
  if (table == nullptr) return std::nullopt;
  return table->heightNear(thing.position.head<2>());
}

bool PlaceEvidence::sinks(const Thing& thing, const Eigen::Isometry3d& motion, const Thing& on) const {
  const Thing* table = supportOf(other_, on);
  if (table == nullptr || supportOf(own_, thing) == nullptr) return false;
  const double lowest = table->heightNear(on.position.head<2>()) - kSinking - 0.5 * table->resolution;
  const auto sunk = std::count_if(thing.sample.begin(), thing.sample.end(), [&](const auto& voxel) {
    return (motion * voxel.template cast<double>()).z() < lowest;
  });
  return static_cast<double>(sunk) > kMostSunk * static_cast<double>(thing.sample.size());
}

double PlaceEvidence::seenShare(const Thing& thing, const std::vector<Obb>& filled) const {
  const auto seen = std::count_if(thing.sample.begin(), thing.sample.end(), [&](const auto& voxel) {
    const Eigen::Vector3d p = voxel.template cast<double>();
    if (placeAt(p, Trust::sure) != Place::unknown || support(thing, p, p) != Support::unknown) return true;
    return std::any_of(filled.begin(), filled.end(), [&p](const Obb& box) { return box.contains(p); });
  });
  return static_cast<double>(seen) / static_cast<double>(thing.sample.size());
}

Cover PlaceEvidence::cover(const Thing& thing) const {
  std::vector<const Thing*> near_by;
  for (const Thing& candidate : other_.things()) {
    if (candidate.label != thing.label) continue;
    const double r = reach(thing, candidate);
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(r);
    const Eigen::AlignedBox3d grown(thing.bounds.min() - margin, thing.bounds.max() + margin);
    if (grown.intersects(candidate.bounds)) near_by.push_back(&candidate);
  }
  return count(thing, Eigen::Isometry3d::Identity(), Trust::sure, [&](const Eigen::Vector3f& p) {
    return std::any_of(near_by.begin(), near_by.end(),
                       [&](const Thing* on) { return on->tree.hasNear(p, reach(thing, *on)); });
  });
}

Cover PlaceEvidence::cover(const Thing& thing, const Eigen::Isometry3d& motion, const Thing& on, Trust trust,
                           double reach_factor) const {
  const double r = reach_factor * reach(thing, on);
  return count(thing, motion, trust, [&](const Eigen::Vector3f& p) { return on.tree.hasNear(p, r); });
}

double PlaceEvidence::plainOverlap(const Thing& thing, const Eigen::Isometry3d& motion,
                                   const Thing& on) const {
  const double r = reach(thing, on);
  const auto matched = std::count_if(thing.sample.begin(), thing.sample.end(), [&](const auto& voxel) {
    const Eigen::Vector3d p = motion * voxel.template cast<double>();
    return on.tree.hasNear(p.cast<float>(), r);
  });
  return static_cast<double>(matched) / static_cast<double>(thing.sample.size());
}

}  // namespace hoctomap
