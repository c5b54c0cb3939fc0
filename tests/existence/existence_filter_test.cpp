// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/existence/ExistenceFilter.h"

#include <gtest/gtest.h>

#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

/// Eq. (8) as the paper prints it.
double equation8(double p_measurement, double p_before, double prior) {
  return 1.0 /
         (1.0 + (1.0 - p_measurement) / p_measurement * (1.0 - p_before) / p_before * prior / (1.0 - prior));
}

TEST(ExistenceFilter, IsEquation8) {
  test::Rng rng(1);
  for (int i = 0; i < 500; ++i) {
    ExistenceParameters p;
    p.prior = test::uniform(rng, 0.2, 0.8);
    p.p_absent = 0.1;
    p.p_present = 0.9;
    p.clamp_max = 0.999999;
    p.clamp_min = 0.000001;
    const double before = test::uniform(rng, 0.05, 0.95);
    const double measurement = test::uniform(rng, 0.1, 0.9);
    const double after = probability(ExistenceFilter(p).update(logOdds(before), measurement));
    EXPECT_NEAR(after, equation8(measurement, before, p.prior), 1e-12);
  }
}

TEST(ExistenceFilter, AMeasurementThatSaysNothingChangesNothing) {
  ExistenceParameters p;
  p.prior = 0.4;
  const ExistenceFilter filter(p);
  EXPECT_NEAR(filter.update(1.25, p.prior), 1.25, 1e-15);
}

TEST(ExistenceFilter, TwoClearContradictionsRemoveAnyNode) {
  const ExistenceParameters p;
  const ExistenceFilter filter(p);
  double l = filter.initialLogOdds();
  for (int i = 0; i < 1000; ++i) l = filter.update(l, p.p_present);
  EXPECT_NEAR(probability(l), p.clamp_max, 1e-12);
  l = filter.update(l, p.p_absent);
  EXPECT_FALSE(ExistenceFilter::isGone(l));
  l = filter.update(l, p.p_absent);
  EXPECT_TRUE(ExistenceFilter::isGone(l));
}

TEST(ExistenceFilter, EvenOddsAreNotGone) {
  EXPECT_FALSE(ExistenceFilter::isGone(-1e-15));
}

TEST(ExistenceFilter, RefusesParametersThatAreNoProbabilitiesOrOutOfOrder) {
  const auto with = [](auto set) {
    ExistenceParameters p;
    set(p);
    return p;
  };
  EXPECT_THROW(ExistenceFilter(with([](auto& p) { p.prior = 0.0; })), std::invalid_argument);
  EXPECT_THROW(ExistenceFilter(with([](auto& p) { p.p_present = 1.0; })), std::invalid_argument);
  EXPECT_THROW(ExistenceFilter(with([](auto& p) { p.p_absent = 0.6; })), std::invalid_argument);
  EXPECT_THROW(ExistenceFilter(with([](auto& p) { p.clamp_max = 0.4; })), std::invalid_argument);
}

}  // namespace
}  // namespace hoctomap
