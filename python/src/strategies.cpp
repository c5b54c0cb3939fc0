// SPDX-License-Identifier: BSD-3-Clause
#include "Strategies.h"

#include <pybind11/stl.h>

#include <algorithm>

#include "Arrays.h"

namespace hoctomap::python {

std::shared_ptr<NumberedMeasurement> ShownScan::of(const Measurement& z) {
  if (copy_ == nullptr || shown_points_ != z.world_points.data() || copy_->z.scan != z.scan) {
    copy_ = std::make_shared<NumberedMeasurement>(NumberedMeasurement{z, true});
    shown_points_ = z.world_points.data();
  }
  return copy_;
}

namespace {

/// A callable that is let go with the interpreter's lock, wherever its strategy is destroyed.
class Callable {
 public:
  explicit Callable(const py::object& function)
      : function_(new py::object(function), [](const py::object* held) {
          const py::gil_scoped_acquire gil;
          delete held;
        }) {}
  template <typename Result, typename... Arguments>
  [[nodiscard]] Result call(Arguments&&... arguments) const {  // with the lock held
    return (*function_)(std::forward<Arguments>(arguments)...).template cast<Result>();
  }

 private:
  std::shared_ptr<const py::object> function_;
};

/// Eq. 5: segments are disjoint and their union is z.
void requirePartition(const std::vector<Segment>& segments, std::size_t points) {
  std::vector<bool> taken(points, false);
  std::size_t count = 0;
  for (const Segment& segment : segments) {
    for (const std::uint32_t i : segment.points) {
      if (i >= points) throw std::invalid_argument("a segment has a point that the measurement has not");
      if (taken[i]) throw std::invalid_argument("segments share point " + std::to_string(i));
      taken[i] = true;
      ++count;
    }
  }
  if (count != points)
    throw std::invalid_argument("segments leave out " + std::to_string(points - count) + " points");
}

Structure structureOf(const std::string& name) {
  if (name == "remainder") return Structure::remainder;
  if (name == "plane") return Structure::plane;
  if (name == "cluster") return Structure::cluster;
  throw py::value_error("structure must be 'remainder', 'plane' or 'cluster'");
}

const char* nameOf(Structure structure) {
  switch (structure) {
    case Structure::plane:
      return "plane";
    case Structure::cluster:
      return "cluster";
    case Structure::remainder:
      break;
  }
  return "remainder";
}

Segment makeSegment(const std::string& structure, const Array<std::uint32_t>& points,
                    const std::optional<Array<double>>& plane) {
  Segment segment;
  segment.structure = structureOf(structure);
  if (points.ndim() != 1) throw py::value_error("points must be an array of indices, (N,)");
  segment.points.assign(points.data(), points.data() + points.size());
  std::sort(segment.points.begin(), segment.points.end());
  if (plane) {
    if (plane->ndim() != 1 || plane->shape(0) != 4)
      throw py::value_error("plane must be 4 numbers: normal and offset");
    const Eigen::Vector3d normal(plane->at(0), plane->at(1), plane->at(2));
    if (!(normal.norm() > 0.0)) throw py::value_error("the normal of a plane must not be zero");
    segment.plane = Eigen::Hyperplane<double, 3>(normal / normal.norm(), plane->at(3) / normal.norm());
  }
  return segment;
}

std::unique_ptr<Segmentation> segmentationOf(const py::object& function, std::shared_ptr<ShownScan> shown) {
  return makeSegmentation([segment = Callable(function), shown = std::move(shown)](const Measurement& z) {
    std::vector<Segment> segments;
    {
      const py::gil_scoped_acquire gil;
      for (const py::handle made : segment.call<py::iterable>(shown->of(z)))
        segments.push_back(made.cast<Segment>());
    }
    requirePartition(segments, z.world_points.size());
    return segments;
  });
}

std::unique_ptr<LabelingFunction> labelingOf(const py::object& function, std::shared_ptr<ShownScan> shown) {
  return makeLabeling(
      [label = Callable(function), shown = std::move(shown)](const Measurement& z, const Segment& segment) {
        const py::gil_scoped_acquire gil;
        return Label{label.call<std::string>(shown->of(z), segment)};
      });
}

std::unique_ptr<Relation> relationOf(std::string name, const py::object& function) {
  return makeRelation(std::move(name),
                      [holds = Callable(function)](const NodeView& above, const NodeView& below) {
                        const py::gil_scoped_acquire gil;
                        return holds.call<bool>(above, below);
                      });
}

}  // namespace

void useCallables(MappingStrategies& strategies, const py::object& segmentation, const py::object& labeling,
                  const py::object& relations) {
  const auto shown = std::make_shared<ShownScan>();
  if (!segmentation.is_none()) strategies.segmentation = segmentationOf(segmentation, shown);
  if (!labeling.is_none()) strategies.labeling = labelingOf(labeling, shown);
  if (!relations.is_none()) {
    strategies.relations = RelationSet();
    for (const auto& [name, holds] : relations.cast<py::dict>())
      strategies.relations.add(
          relationOf(name.cast<std::string>(), py::reinterpret_borrow<py::object>(holds)));
  }
}

void bindStrategyTypes(py::module_& module) {
  py::class_<Segment>(module, "Segment", "A part of a measurement that a segmentation has found.")
      .def(py::init(&makeSegment), py::arg("structure"), py::arg("points"), py::arg("plane") = py::none(),
           "structure: 'remainder', 'plane' or 'cluster'. points: indices into the measurement's points. "
           "plane: of a\n"
           "plane, its normal towards the sensor's side and offset (a, b, c, d), a x + b y + c z + d = 0.")
      .def_property_readonly("structure", [](const Segment& s) { return nameOf(s.structure); })
      .def_property_readonly("points",
                             [](const Segment& s) {
                               return py::array_t<std::uint32_t>(static_cast<py::ssize_t>(s.points.size()),
                                                                 s.points.data());
                             })
      .def_property_readonly("plane",
                             [](const Segment& s) -> py::object {
                               if (!s.plane) return py::none();
                               const Eigen::Vector4d& c = s.plane->coeffs();
                               return py::make_tuple(c[0], c[1], c[2], c[3]);
                             })
      .def("__len__", [](const Segment& s) { return s.points.size(); });
  py::class_<NodeView>(module, "NodeView",
                       "What a relation is asked about: a node, or one that is about to be one.")
      .def_property_readonly("label", [](const NodeView& v) { return v.label.name; })
      .def_property_readonly(
          "box", [](const NodeView& v) { return v.box; }, "In the world.");
}

}  // namespace hoctomap::python
