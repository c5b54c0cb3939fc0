// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "measuring/Figures.h"

namespace hoctomap {
namespace {

TEST(Figures, LinesAndBack) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-12.0, 12.0);
  Figures figures;
  for (int i = 0; i < 100; ++i) figures.add("f" + std::to_string(i), std::pow(10.0, exponent(random)));
  figures.add("bytes", std::uint64_t{18'446'744'073'709'551'615U});
  figures.add("text", std::string("with two spaces"));
  const Figures back = Figures::parse(figures.lines());
  EXPECT_EQ(back.all(), figures.all());
  EXPECT_EQ(back.text("bytes"), "18446744073709551615");
  EXPECT_EQ(back.text("text"), "with two spaces");
}

TEST(Figures, WhatIsMissingOrNoNumberIsAnError) {
  const Figures figures = Figures::parse("a 1.5\nb yes\n");
  EXPECT_EQ(figures.number("a"), 1.5);
  EXPECT_THROW(static_cast<void>(figures.number("b")), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(figures.number("c")), std::out_of_range);
  EXPECT_FALSE(figures.contains("c"));
}

TEST(Figures, HalfOfTheValuesLieOnEitherSideOfTheMedian) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> value;
  for (std::size_t n = 1; n < 30; ++n) {
    std::vector<double> values(n);
    for (double& v : values) v = value(random);
    const double middle = median(values);
    const auto below = std::count_if(values.begin(), values.end(), [&](double v) { return v < middle; });
    const auto above = std::count_if(values.begin(), values.end(), [&](double v) { return v > middle; });
    EXPECT_EQ(below, above) << n;
  }
  EXPECT_THROW(static_cast<void>(median({})), std::invalid_argument);
}

}  // namespace
}  // namespace hoctomap
