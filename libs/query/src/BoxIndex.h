// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace hoctomap {

/// Which of many boxes are at a place: an R-tree. Boxes are known by their number; empty ones are nowhere.
class BoxIndex {
 public:
  explicit BoxIndex(const std::vector<Eigen::AlignedBox3d>& boxes) : tree_(entriesOf(boxes)) {}

  /// Calls `visit(number)` for the boxes that contain a point, in no particular order.
  template <class Visit>
  void at(const Eigen::Vector3d& p, const Visit& visit) const {
    query(boost::geometry::index::intersects(toPoint(p)), visit);
  }
  /// The same for those that meet a box.
  template <class Visit>
  void meeting(const Eigen::AlignedBox3d& box, const Visit& visit) const {
    if (!box.isEmpty()) query(boost::geometry::index::intersects(toBox(box)), visit);
  }
  /// The same for those that meet a segment.
  template <class Visit>
  void along(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Visit& visit) const {
    query(boost::geometry::index::intersects(
              boost::geometry::model::segment<Point>(toPoint(from), toPoint(to))),
          visit);
  }
  /// The box nearest to a point; nothing if there is none.
  [[nodiscard]] std::optional<std::uint32_t> nearest(const Eigen::Vector3d& p) const {
    std::optional<std::uint32_t> found;
    query(boost::geometry::index::nearest(toPoint(p), 1), [&found](std::uint32_t i) { found = i; });
    return found;
  }

 private:
  using Number = std::uint32_t;
  using Point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Point>;
  using Entry = std::pair<Box, Number>;
  using Tree = boost::geometry::index::rtree<Entry, boost::geometry::index::rstar<16>>;

  static Point toPoint(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }
  static Box toBox(const Eigen::AlignedBox3d& box) { return {toPoint(box.min()), toPoint(box.max())}; }
  static std::vector<Entry> entriesOf(const std::vector<Eigen::AlignedBox3d>& boxes) {
    constexpr double kHair = 1e-6;  // m: more than rounding makes of the corners of an oriented box
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (boxes[i].isEmpty()) continue;
      const Eigen::Vector3d hair = Eigen::Vector3d::Constant(kHair);
      entries.emplace_back(toBox({boxes[i].min() - hair, boxes[i].max() + hair}), static_cast<Number>(i));
    }
    return entries;
  }
  template <class Predicate, class Visit>
  void query(const Predicate& predicate, const Visit& visit) const {
    tree_.query(predicate,
                boost::make_function_output_iterator([&visit](const Entry& entry) { visit(entry.second); }));
  }

  Tree tree_;
};

}  // namespace hoctomap
