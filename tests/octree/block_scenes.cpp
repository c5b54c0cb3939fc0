// SPDX-License-Identifier: BSD-3-Clause
#include "block_scenes.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace hoctomap::test {

namespace {

constexpr std::array kResolutions{0.0005, 0.001, 0.002, 0.004, 0.0073, 0.01, 0.05, 0.0625, 0.1, 0.2};

float asFloat(double x) {
  return static_cast<float>(x);
}

}  // namespace

SceneMaker::SceneMaker(std::uint64_t seed) : rng_(seed) {
  resolution_ = kResolutions[static_cast<std::size_t>(pick(kResolutions.size()))];
  extent_ = std::exp(uniform(std::log(3.0), std::log(90.0)));
  switch (pick(5)) {
    case 0:  // at the end of the key range: parts of the scene beyond it
      center_ =
          Eigen::Vector3d(pick(2) ? 32768.0 : -32768.0, uniform(-30000, 30000), pick(2) ? 32768.0 : 0.0);
      break;
    case 1:  // far from the tree's centre, where single precision is coarse
      center_ = Eigen::Vector3d(uniform(-30000, 30000), uniform(-30000, 30000), uniform(-30000, 30000));
      break;
    default:
      center_ = Eigen::Vector3d(uniform(-200, 200), uniform(-200, 200), uniform(-200, 200));
  }
}

double SceneMaker::coordinate() {
  const double x = uniform(-extent_, extent_);
  switch (pick(6)) {
    case 0:
      return std::round(x);  // on a voxel border
    case 1:
      return std::floor(x) + 0.5;  // in the middle
    case 2:
      return std::round(x) + uniform(-1e-4, 1e-4);
    default:
      return x;
  }
}

Eigen::Vector3f SceneMaker::point() {
  Eigen::Vector3f p;
  const Eigen::Vector3d base = pick(2) == 0 ? center_ : Eigen::Vector3d(center_.array().round());
  for (Eigen::Index i = 0; i < 3; ++i) p[i] = asFloat((base[i] + coordinate()) * resolution_);
  return p;
}

Eigen::Vector3f SceneMaker::endpoint(const Eigen::Vector3f& origin) {
  Eigen::Vector3f p = point();
  switch (pick(12)) {
    case 0:  // parallel to an axis
      for (const int i : {pick(3), pick(3)}) p[i] = origin[i];
      break;
    case 1:  // an exact diagonal
      p = origin +
          Eigen::Vector3f(pick(2) ? 1.0F : -1.0F, pick(2) ? 1.0F : -1.0F, static_cast<float>(pick(2))) *
              asFloat(std::floor(uniform(0, extent_)) * resolution_);
      break;
    case 2:  // no length, or next to none
      p = origin;
      if (pick(2) == 0) p[pick(3)] = std::nextafter(origin[0], 1e9F);
      break;
    case 3:  // a duplicate
      if (!hits_.empty()) p = hits_.back();
      break;
    case 4:  // next to the origin
      for (Eigen::Index i = 0; i < 3; ++i) p[i] = origin[i] + asFloat(uniform(-2, 2) * resolution_);
      break;
    default:
      break;
  }
  if (pick(400) == 0) p[pick(3)] = asFloat(uniform(-1, 1) * 1e12);  // beyond any key
  return p;
}

Beams SceneMaker::scan(std::size_t hits, std::size_t passing, std::size_t endpoints) {
  hits_.clear();
  passing_.clear();
  endpoints_.clear();
  Beams beams;
  beams.origin = point();
  if (pick(20) == 0) beams.origin[pick(3)] = asFloat(40000.0 * resolution_);  // beyond the key range
  for (std::size_t i = 0; i < hits; ++i) hits_.push_back(endpoint(beams.origin));
  for (std::size_t i = 0; i < passing; ++i) passing_.push_back(endpoint(beams.origin));
  for (std::size_t i = 0; i < endpoints; ++i) endpoints_.push_back(endpoint(beams.origin));
  beams.hits = hits_;
  beams.passing = passing_;
  beams.endpoints = endpoints_;
  beams.max_range = maxRange();
  return beams;
}

double SceneMaker::maxRange() {
  if (pick(3) != 0) return -1.0;
  return (pick(2) == 0 ? uniform(0, 2.0 * extent_) : std::floor(uniform(0, 2.0 * extent_))) * resolution_;
}

Eigen::AlignedBox3d SceneMaker::box() {
  Eigen::Vector3d a;
  Eigen::Vector3d b;
  for (Eigen::Index i = 0; i < 3; ++i) {
    a[i] = (center_[i] + coordinate()) * resolution_;
    b[i] = (center_[i] + coordinate()) * resolution_;
  }
  switch (pick(10)) {
    case 0:  // one voxel thin
      b[pick(3)] = a[pick(3)];
      break;
    case 1:  // reaching beyond the key range
      b[pick(3)] = (pick(2) ? 1.0 : -1.0) * 1e6;
      break;
    case 2:  // small
      b = a + (b - a) * 0.1;
      break;
    default:
      break;
  }
  if (pick(20) == 0) return {a, b};  // as it comes, mostly inverted: nothing lies in it
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

std::string otBytes(const octomap::OcTree& tree) {
  std::ostringstream stream;
  tree.write(stream);
  return stream.str();
}

std::string difference(const octomap::OcTree& a, const octomap::OcTree& b) {
  if (a.size() != b.size()) return "sizes " + std::to_string(a.size()) + " and " + std::to_string(b.size());
  if (a.size() != a.calcNumNodes()) return "size is not the number of nodes";
  if (otBytes(a) != otBytes(b)) return "the bytes differ";
  constexpr std::size_t kManyNodes =
      20000;  // octomap's iterators are slow, and the bytes hold every node anyway
  if (a.size() < kManyNodes && !(a == b)) return "a node differs";
  return {};
}

int sweepFactor() {
  const char* set = std::getenv("HOCTOMAP_SWEEP");
  return set == nullptr ? 1 : std::max(1, std::atoi(set));
}

Instructions instructionsFor(std::uint64_t seed) {
  return seed % 4 == 0 ? Instructions::baseline : seed % 4 == 1 ? Instructions::avx2 : Instructions::best;
}

}  // namespace hoctomap::test
