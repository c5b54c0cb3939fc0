// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/hierarchy/LogOdds.h"

namespace hoctomap {

/// Parameters of the existence filter for one label.
struct ExistenceParameters {
  double prior = 0.5;       ///< P(n)
  double p_present = 0.9;   ///< P(n | z_t) of a scan that clearly shows the node; also that of a new node
  double p_absent = 0.1;    ///< P(n | z_t) of a scan that clearly shows that it is gone
  double clamp_max = 0.97;  ///< upper bound of P(n | z_1:t), so that a node can die after few contradictions
  double clamp_min = 0.03;  ///< lower bound
};

/// The binary Bayes filter of Eq. 8, which is a sum in log-odds:
///   l(n | z_1:t) = l(n | z_t) + l(n | z_1:t-1) - l(n).
class ExistenceFilter {
 public:
  /// @throws std::invalid_argument if a parameter is no probability in (0, 1) or they are out of order.
  explicit ExistenceFilter(const ExistenceParameters& parameters);

  /// State of a node that has just been created.
  [[nodiscard]] double initialLogOdds() const;
  /// State after a measurement with P(n | z_t) = `p_measurement`.
  [[nodiscard]] double update(double log_odds, double p_measurement) const;
  /// Whether P(n | z_1:t) is below 0.5 (beyond rounding): the node is to be removed.
  [[nodiscard]] static bool isGone(double log_odds);

 private:
  ExistenceParameters parameters_;
};

}  // namespace hoctomap
