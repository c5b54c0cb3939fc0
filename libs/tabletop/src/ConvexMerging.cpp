// SPDX-License-Identifier: BSD-3-Clause
#include "ConvexMerging.h"

#include <algorithm>
#include <map>
#include <queue>

namespace hoctomap {
namespace {

constexpr double kSplit = 22.0;          // degrees of mean evidence from which two regions stay apart
constexpr double kFragmentSplit = 45.0;  // the same for fragments: nearly a step
constexpr int kFragmentPasses = 3;
constexpr double kDegreesPerPixel = 0.2;  // what a longer border is worth in the choice
constexpr double kLongBorder = 50.0;      // pixels, beyond which it is worth no more

struct Border {
  double evidence = 0.0;  ///< degrees x pixels
  double length = 0.0;    ///< pixels

  void add(const Border& other) {
    evidence += other.evidence;
    length += other.length;
  }
  [[nodiscard]] double mean() const { return evidence / length; }
};

struct Pair {
  double mean;
  std::int32_t a;  ///< a < b
  std::int32_t b;
  bool operator>(const Pair& other) const {
    return mean != other.mean ? mean > other.mean : (a != other.a ? a > other.a : b > other.b);
  }
};

class RegionGraph {
 public:
  explicit RegionGraph(const PatchGraph& graph)
      : area_(graph.area), borders_(graph.area.size()), parent_(graph.area.size()) {
    for (std::size_t k = 0; k < parent_.size(); ++k) parent_[k] = static_cast<std::int32_t>(k);
    for (const auto& e : graph.borders) {
      const Border border{e.evidence * e.length, e.length};
      borders_[at(e.a)][e.b] = borders_[at(e.b)][e.a] = border;
    }
  }

  void mergeBelow(double split) {
    std::priority_queue<Pair, std::vector<Pair>, std::greater<>> queue;
    const auto push = [&](std::int32_t a, std::int32_t b, const Border& border) {
      if (border.mean() < split) queue.push({border.mean(), std::min(a, b), std::max(a, b)});
    };
    for (std::size_t k = 0; k < borders_.size(); ++k) {
      const auto a = static_cast<std::int32_t>(k);
      for (const auto& [b, border] : borders_[k]) {
        if (a < b) push(a, b, border);
      }
    }
    while (!queue.empty()) {
      const Pair top = queue.top();
      queue.pop();
      const auto found = borders_[at(top.a)].find(top.b);
      if (found == borders_[at(top.a)].end() || found->second.mean() != top.mean) continue;  // outdated
      const auto kept = merge(top.a, top.b);
      for (const auto& [other, border] : borders_[at(kept)]) push(kept, other, border);
    }
  }

  void absorbFragments(double fragment) {
    for (int pass = 0; pass < kFragmentPasses; ++pass) {
      for (std::size_t k = 0; k < parent_.size(); ++k) {
        const auto region = static_cast<std::int32_t>(k);
        if (parent_[k] != region || area_[k] >= fragment) continue;
        std::int32_t best = -1;
        double least = 0.0;
        for (const auto& [other, border] : borders_[k]) {
          if (border.mean() >= kFragmentSplit) continue;
          const double cost = border.mean() - kDegreesPerPixel * std::min(kLongBorder, border.length);
          if (best >= 0 && cost >= least) continue;
          best = other;
          least = cost;
        }
        if (best >= 0) merge(region, best);
      }
    }
  }

  [[nodiscard]] PatchRegions regions() {
    PatchRegions result;
    std::vector<std::int32_t> number(parent_.size(), -1);
    for (std::size_t k = 0; k < parent_.size(); ++k) {
      auto& n = number[at(root(static_cast<std::int32_t>(k)))];
      if (n < 0) n = result.count++;
      result.of_patch.push_back(n);
    }
    return result;
  }

 private:
  static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

  std::int32_t root(std::int32_t k) {
    while (parent_[at(k)] != k) k = parent_[at(k)] = parent_[at(parent_[at(k)])];
    return k;
  }

  /// The one with fewer borders goes into the other.
  std::int32_t merge(std::int32_t a, std::int32_t b) {
    if (borders_[at(a)].size() < borders_[at(b)].size()) std::swap(a, b);
    borders_[at(a)].erase(b);
    for (const auto& [other, border] : borders_[at(b)]) {
      if (other == a) continue;
      borders_[at(other)].erase(b);
      borders_[at(a)][other].add(border);
      borders_[at(other)][a] = borders_[at(a)][other];
    }
    borders_[at(b)].clear();
    area_[at(a)] += area_[at(b)];
    parent_[at(b)] = a;
    return a;
  }

  std::vector<double> area_;
  std::vector<std::map<std::int32_t, Border>> borders_;
  std::vector<std::int32_t> parent_;
};

}  // namespace

PatchRegions mergeConvex(const PatchGraph& graph, double fragment) {
  RegionGraph regions(graph);
  regions.mergeBelow(kSplit);
  regions.absorbFragments(fragment);
  return regions.regions();
}

}  // namespace hoctomap
