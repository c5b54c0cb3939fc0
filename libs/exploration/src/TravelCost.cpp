// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/exploration/TravelCost.h"

#include <algorithm>
#include <boost/graph/astar_search.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths_no_color_map.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property,
                                                 boost::property<boost::edge_weight_t, double>, std::uint32_t,
                                                 std::uint32_t>;
using Vertex = boost::graph_traits<Graph>::vertex_descriptor;
constexpr double kNoWay = std::numeric_limits<double>::infinity();

/// Steps to the eight neighbours; to those across a corner only where both cells beside it are free.
Graph neighbours(const TraversabilityMap& map) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<double> lengths;
  const auto stands = [&map](int x, int y) {
    return x >= 0 && y >= 0 && x < map.width() && y < map.height() && map.traversable({x, y});
  };
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (!stands(x, y)) continue;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if ((dx == 0 && dy == 0) || !stands(x + dx, y + dy) || !stands(x + dx, y) || !stands(x, y + dy))
            continue;
          edges.emplace_back(map.index({x, y}), map.index({x + dx, y + dy}));
          lengths.push_back(map.cellSize() * (dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0));
        }
      }
    }
  }
  return {boost::edges_are_sorted, edges.begin(), edges.end(), lengths.begin(),
          static_cast<std::uint32_t>(map.cells())};
}

/// The cell of a place, or the traversable one next to it.
std::optional<std::size_t> nearestTraversable(const TraversabilityMap& map, const Eigen::Vector2d& place) {
  const auto here = map.cellOf(place);
  if (here && map.traversable(*here)) return map.index(*here);
  std::optional<std::size_t> nearest;
  double best = kNoWay;
  for (std::size_t i = 0; i < map.cells(); ++i) {
    const GridCell cell = map.cell(i);
    const double distance = (map.center(cell) - place).norm();
    if (map.traversable(cell) && distance < best) {
      best = distance;
      nearest = i;
    }
  }
  return nearest;
}

/// The straight line: never longer than the way.
class StraightLine : public boost::astar_heuristic<Graph, double> {
 public:
  StraightLine(const TraversabilityMap& map, std::size_t goal)
      : map_(map), goal_(map.center(map.cell(goal))) {}
  double operator()(Vertex v) const { return (map_.center(map_.cell(v)) - goal_).norm(); }

 private:
  const TraversabilityMap& map_;
  Eigen::Vector2d goal_;
};

struct GoalReached {};

class StopAtGoal : public boost::default_astar_visitor {
 public:
  explicit StopAtGoal(Vertex goal) : goal_(goal) {}
  void examine_vertex(Vertex v, const Graph&) const {
    if (v == goal_) throw GoalReached{};  // Boost's documented way to end a search
  }

 private:
  Vertex goal_;
};

}  // namespace

struct TravelCost::Ways {
  Graph graph;
};

TravelCost::TravelCost(const TraversabilityMap& map, const Eigen::Vector2d& from, double speed,
                       double measuring_time)
    : map_(map),
      ways_(std::make_unique<Ways>(Ways{neighbours(map)})),
      from_(from),
      speed_(speed),
      measuring_time_(measuring_time),
      start_(nearestTraversable(map, from)),
      lengths_(map.cells(), kNoWay) {
  if (!(speed > 0.0)) throw ConfigError("the robot's speed must be positive");
  if (!start_) return;
  boost::dijkstra_shortest_paths_no_color_map(
      ways_->graph, static_cast<Vertex>(*start_),
      boost::distance_map(
          boost::make_iterator_property_map(lengths_.begin(), get(boost::vertex_index, ways_->graph)))
          .distance_inf(kNoWay));
}

TravelCost::~TravelCost() = default;

std::optional<std::size_t> TravelCost::reached(const Eigen::Vector2d& to) const {
  const auto cell = map_.cellOf(to);
  if (!cell || lengths_[map_.index(*cell)] == kNoWay) return std::nullopt;
  return map_.index(*cell);
}

std::optional<double> TravelCost::length(const Eigen::Vector2d& to) const {
  const auto cell = reached(to);
  if (!cell) return std::nullopt;
  return lengths_[*cell];
}

std::optional<double> TravelCost::seconds(const Eigen::Vector2d& to) const {
  const auto metres = length(to);
  if (!metres) return std::nullopt;
  return measuring_time_ + *metres / speed_;
}

std::vector<Eigen::Vector2d> TravelCost::path(const Eigen::Vector2d& to) const {
  const auto goal = reached(to);
  if (!goal) return {};
  std::vector<Vertex> before(map_.cells());
  const auto index = get(boost::vertex_index, ways_->graph);
  try {
    boost::astar_search(ways_->graph, static_cast<Vertex>(*start_), StraightLine(map_, *goal),
                        boost::predecessor_map(boost::make_iterator_property_map(before.begin(), index))
                            .visitor(StopAtGoal(static_cast<Vertex>(*goal))));
  } catch (const GoalReached&) {
  }
  std::vector<Eigen::Vector2d> path{to};
  for (Vertex at = before[*goal]; at != *start_ && *goal != *start_; at = before[at]) {
    path.push_back(map_.center(map_.cell(at)));
  }
  path.push_back(from_);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace hoctomap
