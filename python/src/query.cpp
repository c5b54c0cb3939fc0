// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <algorithm>

#include "Arrays.h"
#include "Bindings.h"
#include "Map.h"

namespace hoctomap::python {

namespace {

constexpr std::int64_t kNoNode = -1;

std::int64_t numberOf(const std::optional<NodeId>& node) {
  return node ? static_cast<std::int64_t>(node->value) : kNoNode;
}

/// Questions to a map, which it keeps alive.
class Query {
 public:
  Query(std::shared_ptr<Map> map, double min_existence)
      : map_(std::move(map)), query_(map_->hierarchy(), {min_existence}) {}

  [[nodiscard]] py::tuple points(const Array<double>& points) const {
    const auto rows = rowsOf(points, "points");
    const auto count = static_cast<py::ssize_t>(rows.size());
    py::array_t<std::uint8_t> states(count);
    py::array_t<double> probabilities(count);
    py::array_t<std::int64_t> nodes(count);
    std::uint8_t* state = states.mutable_data();
    double* probability = probabilities.mutable_data();
    std::int64_t* node = nodes.mutable_data();
    {
      const py::gil_scoped_release released;
      requireFinite(rows);
      for (const Eigen::Vector3d& p : rows) {
        const PointAnswer answer = query_.at(p);
        *state++ = static_cast<std::uint8_t>(answer.state);
        *probability++ = answer.probability;
        *node++ = numberOf(answer.node);
      }
    }
    return py::make_tuple(states, probabilities, nodes);
  }

  [[nodiscard]] py::tuple rays(const Array<double>& origins, const Array<double>& directions,
                               double max_range, bool ignore_unknown) const {
    const auto from = rowsOf(origins, "origins");
    const auto along = rowsOf(directions, "directions");
    if (from.size() != along.size()) throw py::value_error("there must be as many directions as origins");
    const auto count = static_cast<py::ssize_t>(from.size());
    py::array_t<std::uint8_t> ends(count);
    py::array_t<double> distances(count);
    py::array_t<std::int64_t> nodes(count);
    std::uint8_t* end = ends.mutable_data();
    double* distance = distances.mutable_data();
    std::int64_t* node = nodes.mutable_data();
    {
      const py::gil_scoped_release released;
      requireFinite(from);
      for (std::size_t i = 0; i < from.size(); ++i) {
        const RayAnswer answer = query_.castRay(from[i], along[i], {max_range, ignore_unknown});
        *end++ = static_cast<std::uint8_t>(answer.end);
        *distance++ = answer.distance;
        *node++ = numberOf(answer.node);
      }
    }
    return py::make_tuple(ends, distances, nodes);
  }

  [[nodiscard]] py::tuple nearest(const Array<double>& points, double max_distance) const {
    const auto rows = rowsOf(points, "points");
    const auto count = static_cast<py::ssize_t>(rows.size());
    py::array_t<double> distances(count);
    py::array_t<double> places({count, py::ssize_t{3}});
    py::array_t<std::int64_t> nodes(count);
    double* distance = distances.mutable_data();
    double* place = places.mutable_data();
    std::int64_t* node = nodes.mutable_data();
    {
      const py::gil_scoped_release released;
      requireFinite(rows);
      constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
      for (const Eigen::Vector3d& p : rows) {
        const auto answer = query_.nearestOccupied(p, max_distance);
        *distance++ = answer ? answer->distance : std::numeric_limits<double>::infinity();
        const Eigen::Vector3d where = answer ? answer->point : Eigen::Vector3d::Constant(kNothing);
        place = std::copy_n(where.data(), 3, place);
        *node++ = answer ? static_cast<std::int64_t>(answer->node.value) : kNoNode;
      }
    }
    return py::make_tuple(distances, places, nodes);
  }

  [[nodiscard]] std::optional<std::uint32_t> collision(const Obb& box) const {
    const py::gil_scoped_release released;
    return valueOf(query_.collision(box));
  }
  [[nodiscard]] std::optional<std::uint32_t> collision(const Array<double>& centre, double radius) const {
    const Eigen::Vector3d point = pointOf(centre, "center");
    if (!(radius >= 0.0)) throw py::value_error("radius must not be negative");
    const py::gil_scoped_release released;
    return valueOf(query_.collision(point, radius));
  }
  [[nodiscard]] double unknownShare(const Obb& box, double step) const {
    const py::gil_scoped_release released;
    return query_.unknownShare(box, step);
  }
  [[nodiscard]] std::map<std::uint32_t, double> nodesIn(const Obb& region) const {
    const py::gil_scoped_release released;
    std::map<std::uint32_t, double> shares;
    for (const NodeInRegion& found : query_.nodesIn(region)) shares[found.node.value] = found.share;
    return shares;
  }

 private:
  static std::optional<std::uint32_t> valueOf(const std::optional<NodeId>& node) {
    return node ? std::optional(node->value) : std::nullopt;
  }
  static void requireFinite(std::span<const Eigen::Vector3d> rows) {
    const bool finite = std::all_of(rows.begin(), rows.end(), [](const auto& p) { return p.allFinite(); });
    if (!finite) throw std::invalid_argument("coordinates must be finite");
  }

  std::shared_ptr<Map> map_;
  HierarchyQuery query_;
};

}  // namespace

void bindQuery(py::module_& module) {
  module.attr("UNKNOWN") = static_cast<int>(Occupancy::unknown);
  module.attr("FREE") = static_cast<int>(Occupancy::free);
  module.attr("OCCUPIED") = static_cast<int>(Occupancy::occupied);
  module.attr("RAY_HIT") = static_cast<int>(RayAnswer::End::hit);
  module.attr("RAY_UNKNOWN") = static_cast<int>(RayAnswer::End::unknown);
  module.attr("RAY_NOTHING") = static_cast<int>(RayAnswer::End::nothing);

  constexpr double kEverywhere = std::numeric_limits<double>::infinity();
  py::class_<Query>(
      module, "Query",
      "Questions to a whole map, in the world's frame, m. Made once; any number of threads may ask. Of\n"
      "several nodes that know a place the finer one decides. Where no node has a say its number is -1.")
      .def(py::init<std::shared_ptr<Map>, double>(), py::arg("map"), py::arg("min_existence") = 0.0,
           py::call_guard<py::gil_scoped_release>(),
           "min_existence: nodes that are less probable are left out.")
      .def("points", &Query::points, py::arg("points"),
           "What the map says of each of (N, 3) points: states (UNKNOWN, FREE, OCCUPIED; uint8), "
           "probabilities of\n"
           "being occupied (float64), and which node decides (int64).")
      .def("rays", &Query::rays, py::arg("origins"), py::arg("directions"), py::kw_only(),
           py::arg("max_range") = kEverywhere, py::arg("ignore_unknown") = false,
           "The first occupied or unknown place along each of N rays: ends (RAY_HIT, RAY_UNKNOWN, "
           "RAY_NOTHING;\n"
           "uint8), distances (m), nodes that were hit. ignore_unknown: go on through what is unknown.")
      .def("nearest", &Query::nearest, py::arg("points"), py::kw_only(),
           py::arg("max_distance") = kEverywhere,
           "The occupied voxel nearest to each of (N, 3) points: distances to its surface (0 inside, inf for "
           "none),\n"
           "the points of it that are nearest (N, 3), nodes.")
      .def("collision", py::overload_cast<const Obb&>(&Query::collision, py::const_), py::arg("box"),
           "The finest node with an occupied voxel that shares a point with the box; None for none.")
      .def("collision", py::overload_cast<const Array<double>&, double>(&Query::collision, py::const_),
           py::arg("center"), py::arg("radius"), "The same of a ball.")
      .def("unknown_share", &Query::unknownShare, py::arg("box"), py::kw_only(), py::arg("step") = 0.0,
           "Share of the box that no node knows, in [0, 1]. step: m between samples; 0 for the finest "
           "resolution.")
      .def("nodes_in", &Query::nodesIn, py::arg("box"),
           "The nodes, root excepted, with occupied voxels in the box, each with the share of them that is "
           "inside.");
}

}  // namespace hoctomap::python
