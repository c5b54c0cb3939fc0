// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include "Arrays.h"
#include "Bindings.h"
#include "Map.h"
#include "hoctomap/query/HierarchyDiff.h"

namespace hoctomap::python {

namespace {

std::optional<std::uint32_t> valueOf(const std::optional<NodeId>& node) {
  return node ? std::optional(node->value) : std::nullopt;
}

std::vector<Change> changes(const Map& a, const Map& b, const std::optional<Array<double>>& a_T_b,
                            double min_motion) {
  const Eigen::Isometry3d transform = a_T_b ? toIsometry(poseOf(*a_T_b)) : Eigen::Isometry3d::Identity();
  DiffConfig config;
  if (!(min_motion >= 0.0)) throw py::value_error("min_motion must not be negative");
  config.min_motion = min_motion;
  const py::gil_scoped_release released;
  return diff(a.hierarchy(), b.hierarchy(), config, transform);
}

}  // namespace

void bindDiff(py::module_& module) {
  py::class_<Change>(module, "Change", "One difference between two maps of a place.")
      .def_property_readonly(
          "kind", [](const Change& c) { return toString(c.kind); },
          "'added', 'removed', 'moved', 'changed' or 'unobservable'.")
      .def_property_readonly(
          "node_a", [](const Change& c) { return valueOf(c.node_a); },
          "Number of the node in a; None if a has it not.")
      .def_property_readonly(
          "node_b", [](const Change& c) { return valueOf(c.node_b); },
          "Number of the node in b; None if b has it not.")
      .def_property_readonly("label", [](const Change& c) { return c.label.name; })
      .def_property_readonly(
          "position", [](const Change& c) { return toArray(c.position); },
          "Mean of its occupied voxels in a's world, (3,), m.")
      .def_property_readonly(
          "motion", [](const Change& c) { return toArray(c.motion.matrix()); },
          "Of what moved, in a's world: p_in_b = motion p_in_a, (4, 4).")
      .def_readonly(
          "score", &Change::score,
          "In [0, 1]: overlap of what moved or changed; of others the share of the place that was seen.")
      .def_property_readonly(
          "carried",
          [](const Change& c) {
            std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
            for (const auto& [a, b] : c.carried) pairs.emplace_back(a.value, b.value);
            return pairs;
          },
          "Nodes of a and b that came along with what moved.")
      .def_readonly("detail", &Change::detail, "What was not decided, and why.")
      .def("__repr__",
           [](const Change& c) { return "<hoctomap.Change " + toString(c.kind) + " " + c.label.name + ">"; });
  module.def("diff", &changes, py::arg("a"), py::arg("b"), py::kw_only(), py::arg("a_T_b") = py::none(),
             py::arg("min_motion") = DiffConfig{}.min_motion,
             "What changed from map a to map b. a_T_b: takes b's world to a's, (4, 4). min_motion: m; "
             "smaller shifts\n"
             "are errors of the poses. What the other map did not see is 'unobservable'.");
}

}  // namespace hoctomap::python
