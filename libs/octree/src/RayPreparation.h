// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "LaneMath.h"
#include "RayBatch.h"

// Compiled by RayBatch.cpp with the compiler's vector types and by WideRayBatch.cpp with those of AVX-512:
// `L` names the types of a set of lanes.
namespace hoctomap::engine {

/// Several rays, axis by axis: see `Ray`, whose arithmetic this repeats to the last bit.
template <class L>
struct Rays {
  using Doubles = typename L::Doubles;
  using Mask = typename L::Mask;
  Doubles next[3];
  Doubles delta[3];
  Doubles steps[3];
  Mask forward[3];  ///< where the step's sign is that
  Mask backward[3];
};

/// Crossings of an axis before the time t. `doubt` is set where that is too close to call without the exact
/// times: they differ from these by less than 1e-6 of a step.
template <class V, class M>
HOCTOMAP_INLINE V crossingsBefore(const V& t, const V& next, const V& delta, M& doubt) {
  constexpr double kClose = 1e-5;
  V q = (t - next) / delta;
  q = either(q > -0.5, q, V{} - 0.5);
  q = either(q < 1e6, q, V{} + 1e6);
  const V down = floorOf(q);
  const V fraction = q - down;
  doubt |= (fraction < kClose) | (fraction > 1.0 - kClose);
  return down + 1.0;
}

/// Cuts the rays to the box. @param taken out: steps taken on entering, by axis.
template <class L, class V = typename L::Doubles, class M = typename L::Mask>
HOCTOMAP_INLINE void cut(const RayFan& fan, const Rays<L>& rays, M& live, M& doubt, V taken[3], V& cells) {
  constexpr double kNever = 1e300;
  V enter = V{} - kNever;
  V leave = V{} + kNever;
  V total = rays.steps[0] + rays.steps[1] + rays.steps[2];
  V needed_in[3] = {};
  V time_in[3];
  V needed_out[3];
  V time_out[3];
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const RayFan::Axis& axis = fan.axes[i];
    time_in[i] = V{} - kNever;
    if (!axis.inside) {
      inside = false;
      needed_in[i] = either(rays.forward[i], V{} + axis.before[1], V{} + axis.before[0]);
      live &= (needed_in[i] > 0.0) & (needed_in[i] <= rays.steps[i]);
      time_in[i] = rays.next[i] + (needed_in[i] - 1.0) * rays.delta[i];
      enter = greater(enter, time_in[i]);
    }
    needed_out[i] = either(rays.forward[i], V{} + axis.leave[1], V{} + axis.leave[0]);
    const M leaves = needed_out[i] <= rays.steps[i];
    time_out[i] = either(leaves, rays.next[i] + (needed_out[i] - 1.0) * rays.delta[i], V{} + kNever);
    leave = lesser(leave, time_out[i]);
  }
  // What is close is in doubt below, where the crossings are counted.
  live &= enter < leave * (1.0 + 1e-9) + 1e-9;
  if (!anyOf(live)) return;

  V first = V{};
  for (std::size_t i = 0; i < 3; ++i) taken[i] = V{};
  if (!inside) {
    M found{};
    for (std::size_t i = 0; i < 3; ++i) {
      const M here = time_in[i] == enter;
      M close{};
      const V others = crossingsBefore(enter, rays.next[i], rays.delta[i], close);
      doubt |= (close & ~here) | (here & found);
      found |= here;
      taken[i] = either(here, needed_in[i], others);
      first += taken[i];
    }
  }
  const M ends_inside = leave >= kNever;
  V last = V{};
  if (anyOf(~ends_inside)) {
    M found{};
    for (std::size_t i = 0; i < 3; ++i) {
      const M here = time_out[i] == leave;
      M close{};
      const V t = either(ends_inside, V{}, leave);
      const V others = crossingsBefore(t, rays.next[i], rays.delta[i], close);
      doubt |= ~ends_inside & ((close & ~here) | (here & found));
      found |= here;
      last += either(here, needed_out[i] - 1.0, others);
    }
  }
  last = either(ends_inside, total - 1.0, last);
  cells = last - first + 1.0;
}

/// False if no cell of a ray can come near the box.
template <class L>
HOCTOMAP_INLINE typename L::Mask nearBox(const RayFan& fan, const typename L::Floats end[3]) {
  using V = typename L::Doubles;
  V enters{};
  V leaves = V{} + 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const RayFan::Axis& axis = fan.axes[i];
    // Divided by zero: minus to plus infinity for an origin between the planes (the padding keeps it off
    // them).
    const V inverse = 1.0 / (toDoubles<V>(end[i]) - static_cast<double>(axis.origin));
    const V a = axis.to_pad[0] * inverse;
    const V b = axis.to_pad[1] * inverse;
    enters = greater(enters, lesser(a, b));
    leaves = lesser(leaves, greater(a, b));
  }
  return enters <= leaves;
}

/// Leaves out the first part of rays from inside the box. A ray for which it is not certain where that ends
/// stays whole.
template <class L, class V = typename L::Doubles, class M = typename L::Mask>
HOCTOMAP_INLINE void leaveOut(const RayEnds& ends, std::size_t at, const Rays<L>& rays, V taken[3],
                              V& cells) {
  V steps;
  typename L::Codes axis;
  load(steps, ends.skip_steps + at);
  load(axis, ends.skip_axis + at);
  M skips = steps > 0.0;
  V time{};
  for (Code i = 0; i < 3; ++i) {
    time = either(skips & (axis == i), rays.next[i] + (steps - 1.0) * rays.delta[i], time);
    cells = either(skips & (axis == i) & (steps > rays.steps[i]), V{}, cells);
  }
  V first{};
  M doubt{};
  for (Code i = 0; i < 3; ++i) {
    M close{};
    const V others = crossingsBefore(time, rays.next[i], rays.delta[i], close);
    doubt |= close & (axis != i);
    taken[i] = either(axis == i, steps, others);
    first += taken[i];
  }
  skips &= ~doubt;
  for (std::size_t i = 0; i < 3; ++i) taken[i] = either(skips, taken[i], V{});
  cells -= either(skips, first, V{});
}

template <class L>
HOCTOMAP_INLINE void prepare(const RayFan& fan, const RayEnds& ends, std::size_t at, RayBatch& batch) {
  using Doubles = typename L::Doubles;
  using Codes = typename L::Codes;
  using Floats = typename L::Floats;
  using Mask = typename L::Mask;
  Floats end[3];
  for (std::size_t i = 0; i < 3; ++i) load(end[i], ends.end[i] + at);
  Mask live{};
  setFirst(live, ends.count > at ? ends.count - at : 0);
  if (fan.bounded) {
    live &= nearBox<L>(fan, end);
    if (!anyOf(live)) {
      store(Codes{}, batch.cells + at);
      return;
    }
  }

  // Keys, as VoxelGrid::checkedKey.
  Doubles distance[3];
  Mask valid = live;
  for (std::size_t i = 0; i < 3; ++i) {
    const Doubles cell = fan.cells_per_metre * toDoubles<Doubles>(end[i]);
    const Mask in_range = (cell >= -kKeyOffset) & (cell < kKeyOffset);
    valid &= in_range;
    const Doubles key = floorOf(either(in_range, cell, Doubles{})) + kKeyOffset;
    distance[i] = key - fan.axes[i].key;
  }
  live = valid & ((distance[0] != 0.0) | (distance[1] != 0.0) | (distance[2] != 0.0));

  // Times, as RayCaster::prepare.
  const Floats dx = end[0] - fan.axes[0].origin;
  const Floats dy = end[1] - fan.axes[1].origin;
  const Floats dz = end[2] - fan.axes[2].origin;
  const Floats square = dx * dx + dy * dy + dz * dz;
  const Floats length = toFloats<Floats>(rootOf(toDoubles<Doubles>(square)));
  const Floats direction[3] = {dx / length, dy / length, dz / length};
  Rays<L> rays;
  for (std::size_t i = 0; i < 3; ++i) {
    const Doubles d = toDoubles<Doubles>(direction[i]);
    rays.forward[i] = d > 0.0;
    rays.backward[i] = d < 0.0;
    rays.steps[i] = magnitude(distance[i]);
    const Mask moves = rays.forward[i] | rays.backward[i];
    const Doubles to_border =
        either(rays.forward[i], Doubles{} + fan.axes[i].to_border[1], Doubles{} + fan.axes[i].to_border[0]);
    constexpr double kMax = std::numeric_limits<double>::max();
    rays.next[i] = either(moves, to_border / d, Doubles{} + kMax);
    rays.delta[i] = either(moves, fan.resolution / magnitude(d), Doubles{} + kMax);
  }

  // Regular, as isRegular.
  Mask regular = live;
  Doubles last{};
  Doubles beyond = Doubles{} + std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Mask stays = distance[i] == 0.0;
    regular &= stays | ((distance[i] > 0.0) & rays.forward[i]) | ((distance[i] < 0.0) & rays.backward[i]);
    const Doubles crossing = rays.next[i] + (rays.steps[i] - 1.0) * rays.delta[i];
    last = either(stays, last, greater(last, crossing));
    beyond = lesser(beyond, either(stays, rays.next[i], crossing + rays.delta[i]));
  }
  const Doubles margin = 1e-10 * (1.0 + last);
  const Doubles certain = last + margin;
  regular &= (certain < beyond) & (certain < toDoubles<Doubles>(length));

  Mask special = live & ~regular;
  live &= regular;
  Doubles taken[3] = {Doubles{}, Doubles{}, Doubles{}};
  Doubles cells = rays.steps[0] + rays.steps[1] + rays.steps[2];
  if (fan.bounded) {
    Mask doubt{};
    cut<L>(fan, rays, live, doubt, taken, cells);
    special |= live & doubt;
    live &= ~doubt;
  }
  if (ends.skips) leaveOut<L>(ends, at, rays, taken, cells);
  live &= cells > 0.0;

  Codes mirror{};
  Mask exact = live;
  for (std::size_t i = 0; i < 3; ++i) {
    const Doubles done = either(live, taken[i], Doubles{});
    exact &= done == 0.0;
    const Codes steps = toCodes(done);
    const Codes backward = codesOf(rays.backward[i]);  // all bits, or none
    const Codes signed_steps = (steps ^ backward) - backward;
    const Codes local = (signed_steps + fan.axes[i].local) & 0xFFFF;
    const Codes flipped = backward & (fan.mirror_places & kAxisPlaces[i]);
    mirror |= flipped;
    const Codes place = ((dilateLanes(local) << static_cast<Code>(i)) ^ flipped) | ~kAxisPlaces[i];
    // An axis without a crossing has none taken, and an endless `delta`: it stays as it is.
    const Doubles next = either(done == 0.0, rays.next[i], rays.next[i] + done * rays.delta[i]);
    store(place, batch.place[i] + at);
    store(next, batch.next[i] + at);
    store(rays.delta[i], batch.delta[i] + at);
  }
  store(mirror, batch.mirror + at);
  store(either(exact, Doubles{} - 1.0, margin), batch.margin + at);
  const Codes whole = toCodes(either(live, cells, Doubles{}));
  store(codesOf(special) | whole, batch.cells + at);  // all bits: kSpecial
}

}  // namespace hoctomap::engine
