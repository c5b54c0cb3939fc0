// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hoctomap/simulation/Simulation.h"

namespace hoctomap {

/// What can happen on a table.
enum class ScriptKind {
  add,            ///< an object comes
  remove,         ///< an object goes
  move,           ///< an object moves to a free place and turns
  nudge,          ///< an object moves within or beside its own footprint
  pair,           ///< two objects move at once
  swap,           ///< two look-alikes exchange their places: nobody can see that
  behind,         ///< an occluder comes, then what it hides in part goes
  away_and_back,  ///< an object is taken out and put back elsewhere later
  table,          ///< the table moves with all its objects
  replace         ///< an object of another shape takes the place of one
};
inline constexpr int kScriptKinds = 10;

[[nodiscard]] std::string toString(ScriptKind kind);

/// What a mapper should report from one state to the next.
struct ExpectedChanges {
  std::vector<std::string> appeared;  ///< solids
  std::vector<std::string> vanished;
  std::vector<std::string> moved;
};

/// A table with objects, states of `scans_per_state` scans, and what changes from state to state.
struct ChangeScript {
  std::string name;
  Simulation simulation;
  std::uint64_t scans_per_state = 3;
  std::vector<ExpectedChanges> states;  ///< [k]: from state k to k + 1
  std::vector<std::string> round;       ///< solids whose turn cannot be seen, or only by a handle
};

/// A random script of a kind. Same kind and seed, same script.
/// @param width  of the camera's images, pixels; the height is 3/4 of it
[[nodiscard]] ChangeScript makeChangeScript(ScriptKind kind, std::uint64_t seed, int width);

}  // namespace hoctomap
