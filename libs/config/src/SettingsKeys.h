// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "hoctomap/config/IniDocument.h"
#include "hoctomap/config/Settings.h"

namespace hoctomap::keys {

/// Where a value lives in its owner (Settings or LabelProfile); the type of the value is the type of the key.
template <class Owner>
using Access =
    std::variant<double& (*)(Owner&), int& (*)(Owner&), std::int64_t& (*)(Owner&), std::uint64_t& (*)(Owner&),
                 bool& (*)(Owner&), SegmentationMethod& (*)(Owner&), FrameChoice& (*)(Owner&),
                 Carve& (*)(Owner&), Grazing& (*)(Owner&), RuleKind& (*)(Owner&), RuleShape& (*)(Owner&),
                 GainMeasure& (*)(Owner&), UnknownSpace& (*)(Owner&), UtilityForm& (*)(Owner&)>;

/// One row of the table of keys, the only place where a key is spelled.
template <class Owner>
struct Key {
  const char* section;  ///< `label.NAME` for keys of LabelProfile
  const char* name;
  const char* unit;
  Range range;  ///< of numbers
  const char* description;
  Access<Owner> access;
  bool may_be_none = false;  ///< the word `none` is allowed: no limit, a negative value in the struct
};

/// Two numbers that must be in order: low < high, or low <= high.
template <class Owner>
struct Order {
  Access<Owner> low;
  Access<Owner> high;
  bool strict;
};

[[nodiscard]] std::span<const Key<Settings>> settingsKeys();
[[nodiscard]] std::span<const Order<Settings>> settingsOrders();
[[nodiscard]] std::span<const Key<LabelProfile>> labelKeys();
[[nodiscard]] std::span<const Order<LabelProfile>> labelOrders();
/// Of labels other than background, table and object.
[[nodiscard]] std::span<const Key<LabelRule>> ruleKeys();
[[nodiscard]] std::span<const Order<LabelRule>> ruleOrders();

/// The profile that a label's section starts from.
[[nodiscard]] LabelProfile defaultProfile(const Label& label);

}  // namespace hoctomap::keys
