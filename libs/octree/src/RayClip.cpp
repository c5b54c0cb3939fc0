// SPDX-License-Identifier: BSD-3-Clause
#include "RayClip.h"

#include <bit>
#include <cstdint>

namespace hoctomap::engine {

namespace {

/// The power of two at or below a positive number.
double binade(double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & 0x7FF0'0000'0000'0000ULL);
}

/// Takes the crossings of `axis` that come before the crossing (t, other_axis).
void advanceTo(Position& position, const Ray& ray, std::size_t axis, double t, std::size_t other_axis) {
  double& next = position.next[axis];
  if (!crossesBefore(next, axis, t, other_axis)) return;
  // The quotient is right to a tiny fraction of one step: two fewer are certainly not too many.
  const double delta = ray.delta[axis];
  const int sure = static_cast<int>((t - next) / delta) - 2;
  if (sure > 0) {
    next = addRepeatedly(next, delta, sure);
    position.taken[axis] += sure;
  }
  while (crossesBefore(next, axis, t, other_axis)) {
    next += delta;
    ++position.taken[axis];
  }
}

/// Steps that the ray must take along an axis to come into the box; -1 if it never does.
int stepsToEnter(const Ray& ray, const KeyBox& box, std::size_t axis) {
  const int before = ray.step[axis] > 0 ? box.min[axis] - ray.origin[axis] : ray.origin[axis] - box.max[axis];
  if (ray.origin[axis] >= box.min[axis] && ray.origin[axis] <= box.max[axis]) return 0;
  return before > 0 && before <= ray.steps[axis] ? before : -1;
}

/// Steps after which the ray leaves the box along an axis; more than `ray.steps` if it never does.
int stepsToLeave(const Ray& ray, const KeyBox& box, std::size_t axis) {
  return 1 + (ray.step[axis] > 0 ? box.max[axis] - ray.origin[axis] : ray.origin[axis] - box.min[axis]);
}

/// The ray's position on entering the slabs of all three axes. It may already have left one of them.
std::optional<Position> enter(const Ray& ray, const KeyBox& box) {
  Position position{{0, 0, 0}, ray.next};
  bool inside = true;
  std::size_t last_axis = 0;
  double last_crossing = 0.0;
  std::array<int, 3> needed{};
  for (std::size_t i = 0; i < 3; ++i) {
    needed[i] = stepsToEnter(ray, box, i);
    if (needed[i] < 0) return std::nullopt;
    if (needed[i] == 0) continue;
    const double crossing = addRepeatedly(ray.next[i], ray.delta[i], needed[i] - 1);
    if (inside || crossesBefore(last_crossing, last_axis, crossing, i)) {
      last_axis = i;
      last_crossing = crossing;
    }
    inside = false;
  }
  if (inside) return position;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i != last_axis) advanceTo(position, ray, i, last_crossing, last_axis);
  }
  position.taken[last_axis] = needed[last_axis];
  position.next[last_axis] = last_crossing + ray.delta[last_axis];
  return position;
}

int sum(const std::array<int, 3>& taken) {
  return taken[0] + taken[1] + taken[2];
}

/// Steps of the whole ray before the one that leaves the box, for a position inside it.
int lastStepInside(const Ray& ray, const KeyBox& box, const Position& inside) {
  bool leaves = false;
  std::size_t first_axis = 0;
  double first_crossing = 0.0;
  std::array<int, 3> needed{};
  for (std::size_t i = 0; i < 3; ++i) {
    needed[i] = stepsToLeave(ray, box, i);
    if (needed[i] > ray.steps[i]) continue;
    const double crossing = addRepeatedly(inside.next[i], ray.delta[i], needed[i] - 1 - inside.taken[i]);
    if (!leaves || crossesBefore(crossing, i, first_crossing, first_axis)) {
      first_axis = i;
      first_crossing = crossing;
    }
    leaves = true;
  }
  if (!leaves) return ray.cells() - 1;
  Position leaving = inside;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i != first_axis) advanceTo(leaving, ray, i, first_crossing, first_axis);
  }
  leaving.taken[first_axis] = needed[first_axis] - 1;
  return sum(leaving.taken);
}

}  // namespace

double addRepeatedly(double t, double delta, int count) {
  // While t stays within one binade (between two powers of two), its last place is worth the same, and each
  // addition rounds alike: the sum grows by a constant. Only ties depend on the bit before, and settle after
  // one addition.
  while (count > 8) {
    const double a = t + delta;
    const double b = a + delta;
    const double c = b + delta;
    const double limit = 2.0 * binade(b);
    if (a > 0.0 && binade(a) == binade(b) && c < limit) {
      const double increment = c - b;
      const int more = static_cast<int>(std::min(count - 2.0, (limit - b) / increment - 1.0));
      if (more >= 1) {
        t = b +
            more * increment;  // exact: both are multiples of the last place, the sum stays below the limit
        count -= 2 + more;
        continue;
      }
    }
    t = a;
    --count;
  }
  for (; count > 0; --count) t += delta;
  return t;
}

std::optional<Stretch> clipRegularRay(const Ray& ray, const KeyBox& box) {
  const std::optional<Position> entry = enter(ray, box);
  if (!entry) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) {
    if (ray.steps[i] > 0 && entry->taken[i] >= stepsToLeave(ray, box, i)) return std::nullopt;
  }
  const int first = sum(entry->taken);
  const int last = box.contains(ray.end) ? ray.cells() - 1 : lastStepInside(ray, box, *entry);
  if (last < first) return std::nullopt;  // enters with the end key, which is not free
  return Stretch{*entry, last - first + 1};
}

BoxFilter::BoxFilter(const VoxelGrid& grid, const Eigen::Vector3f& origin, const KeyBox& box) {
  // A cell that octomap visits lies within one voxel of the beam: its rounding is a hundredth of a voxel.
  constexpr int kPadding = 2;
  for (std::size_t i = 0; i < 3; ++i) {
    origin_[i] = origin[static_cast<Eigen::Index>(i)];
    to_min_[i] = grid.center(box.min[i] - kPadding) - origin_[i];
    to_max_[i] = grid.center(box.max[i] + kPadding) - origin_[i];
  }
}

bool BoxFilter::mayMeet(const Eigen::Vector3f& end) const {
  double enters = 0.0;
  double leaves = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double direction = static_cast<double>(end[static_cast<Eigen::Index>(i)]) - origin_[i];
    // Divided by zero: minus to plus infinity for an origin between the planes (the padding keeps it off
    // them).
    const double inverse = 1.0 / direction;
    const double near = to_min_[i] * inverse;
    const double far = to_max_[i] * inverse;
    enters = std::max(enters, std::min(near, far));
    leaves = std::min(leaves, std::max(near, far));
  }
  return enters <= leaves;
}

}  // namespace hoctomap::engine
