// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/existence/ExistenceFilter.h"

#include <algorithm>
#include <stdexcept>

namespace hoctomap {

ExistenceFilter::ExistenceFilter(const ExistenceParameters& parameters) : parameters_(parameters) {
  const auto& p = parameters_;
  for (const double value : {p.prior, p.p_present, p.p_absent, p.clamp_min, p.clamp_max}) {
    if (!(value > 0.0 && value < 1.0)) throw std::invalid_argument("existence parameters must lie in (0, 1)");
  }
  if (!(p.p_absent < p.prior && p.prior < p.p_present)) {
    throw std::invalid_argument("existence parameters must satisfy p_absent < prior < p_present");
  }
  if (!(p.clamp_min < 0.5 && 0.5 < p.clamp_max)) {
    throw std::invalid_argument("existence clamps must satisfy clamp_min < 0.5 < clamp_max");
  }
}

double ExistenceFilter::initialLogOdds() const {
  return std::min(logOdds(parameters_.p_present), logOdds(parameters_.clamp_max));
}

double ExistenceFilter::update(double log_odds, double p_measurement) const {  // Eq. (8)
  const double sum = log_odds + logOdds(p_measurement) - logOdds(parameters_.prior);
  return std::clamp(sum, logOdds(parameters_.clamp_min), logOdds(parameters_.clamp_max));
}

bool ExistenceFilter::isGone(double log_odds) {
  constexpr double kRounding = 1e-9;
  return log_odds < -kRounding;
}

}  // namespace hoctomap
