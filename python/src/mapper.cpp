// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "Arrays.h"
#include "Bindings.h"
#include "MappingSetup.h"
#include "PyMapper.h"
#include "Strategies.h"

namespace hoctomap::python {

namespace {

/// The measurements of a Python iterable.
class IterableSource final : public MeasurementSource {
 public:
  IterableSource(py::iterator iterator, PyMapper& mapper) : iterator_(std::move(iterator)), mapper_(mapper) {}

  [[nodiscard]] std::optional<SourceItem> next() override {
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();  // Ctrl-C
    PyObject* item = PyIter_Next(iterator_.ptr());
    if (item == nullptr) {
      if (PyErr_Occurred() != nullptr) throw py::error_already_set();
      return std::nullopt;
    }
    const auto held = py::reinterpret_steal<py::object>(item).cast<std::shared_ptr<NumberedMeasurement>>();
    mapper_.number(*held);
    return held->z;
  }

 private:
  py::iterator iterator_;
  PyMapper& mapper_;
};

std::vector<std::string> assignmentsOf(const py::dict& overrides) {
  std::vector<std::string> assignments;
  for (const auto& [key, value] : overrides) {
    std::string text = py::str(value);
    if (py::isinstance<py::bool_>(value)) text = value.cast<bool>() ? "true" : "false";
    assignments.push_back(std::string(py::str(key)) + "=" + text);
  }
  return assignments;
}

void bindReports(py::module_& module) {
  py::class_<NodeEvent>(module, "Event", "One change of one node.")
      .def_property_readonly(
          "kind", [](const NodeEvent& e) { return toString(e.kind); },
          "'created', 'updated', 'removed', 'moved', 'merged', 'split' or 'reidentified'.")
      .def_property_readonly("node", [](const NodeEvent& e) { return e.node.value; })
      .def_property_readonly("label", [](const NodeEvent& e) { return e.label.name; })
      .def_readonly("existence", &NodeEvent::existence, "Probability of existence after the event.")
      .def_readonly("detail", &NodeEvent::detail)
      .def("__repr__", [](const NodeEvent& e) {
        return "<hoctomap.Event " + toString(e.kind) + " " + e.label.name + " " +
               std::to_string(e.node.value) + ">";
      });
  py::class_<UpdateReport>(module, "Report", "What the integration of one scan did.")
      .def_readonly("scan", &UpdateReport::scan)
      .def_readonly("stamp", &UpdateReport::stamp)
      .def_readonly("points", &UpdateReport::points)
      .def_readonly("events", &UpdateReport::events)
      .def_readonly("warnings", &UpdateReport::warnings)
      .def_property_readonly(
          "seconds",
          [](const UpdateReport& r) {
            return std::map<std::string, double>{{"segment", r.seconds.segment},
                                                 {"associate", r.seconds.associate},
                                                 {"update", r.seconds.update},
                                                 {"existence", r.seconds.existence}};
          },
          "Wall seconds of the stages.");
}

void bindSettings(py::module_& module) {
  py::class_<Settings>(module, "Settings", "Every setting of the mapper; docs/configuration.md lists them.")
      .def(py::init([](const std::optional<std::filesystem::path>& file, const py::dict& overrides) {
             return loadSettings(file, assignmentsOf(overrides));
           }),
           py::arg("file") = py::none(), py::arg("overrides") = py::dict(),
           "From an INI file, or the built-in tabletop.ini. overrides: {'label.object.resolution': 0.004, "
           "...}.\n"
           "Raises ConfigError naming everything that is wrong.")
      .def_property_readonly(
          "ini", [](const Settings& s) { return toIni(s); }, "Every setting in force, as INI text.");
}

}  // namespace

void bindMapper(py::module_& module) {
  bindSettings(module);
  bindReports(module);
  bindStrategyTypes(module);
  using Release = py::call_guard<py::gil_scoped_release>;
  py::class_<PyMapper>(
      module, "Mapper",
      "Builds a map from measurements. Serves one call at a time; other threads of Python go on\n"
      "meanwhile.")
      .def(py::init([](const std::optional<Settings>& settings, const py::object& segmentation,
                       const py::object& labeling, const py::object& relations) {
             const Settings used = settings ? *settings : loadSettings(std::nullopt);
             MappingStrategies strategies = makeStrategies(used);
             useCallables(strategies, segmentation, labeling, relations);
             return std::make_unique<PyMapper>(used, std::move(strategies));
           }),
           py::arg("settings") = py::none(), py::kw_only(), py::arg("segmentation") = py::none(),
           py::arg("labeling") = py::none(), py::arg("relations") = py::none(),
           "settings: a Settings; None for the built-in ones. In the place of what they ask for:\n"
           "segmentation(measurement) -> Segments, disjoint and together all points;\n"
           "labeling(measurement, segment) -> label, one of the settings' labels;\n"
           "relations: {name: holds(above, below) -> bool}, of which at most one holds for a pair of nodes.\n"
           "They may be called from other threads. What they raise comes out of the call that integrates.")
      .def(
          "integrate",
          [](PyMapper& mapper, const std::shared_ptr<NumberedMeasurement>& measurement) {
            return mapper.integrate(*measurement);
          },
          py::arg("measurement"), Release(), "Takes in one measurement.")
      .def(
          "run",
          [](PyMapper& mapper, const py::iterable& measurements) {
            IterableSource source(py::iter(measurements), mapper);
            const py::gil_scoped_release released;
            return mapper.run(source);
          },
          py::arg("measurements"),
          "Takes in all measurements of an iterable. The next one is segmented while its predecessor is "
          "integrated:\n"
          "faster than integrate() for each, with the same map.")
      .def(
          "move",
          [](PyMapper& mapper, std::uint32_t node, const Array<double>& motion) {
            const Pose pose = poseOf(motion);
            const py::gil_scoped_release released;
            return mapper.move(NodeId{node}, pose);
          },
          py::arg("node"), py::arg("motion"), "A node has been moved by a (4, 4) transform in its own frame.")
      .def("finish", &PyMapper::finish, Release(),
           "The measurements have ended: nodes that wait for another view enter the map if enough speaks for "
           "them.")
      .def_property_readonly("map", py::cpp_function(&PyMapper::map, Release()),
                             "The map as it is now: a copy, which does not change when the mapper goes on.")
      .def("save", &PyMapper::save, py::arg("directory"), py::kw_only(), py::arg("overwrite") = false,
           Release(),
           "Writes a map directory, as `hoctomap build` does. The directory must be missing or empty unless\n"
           "overwrite. Raises FileError, ConfigError.")
      .def_property_readonly("settings", &PyMapper::settings);
}

}  // namespace hoctomap::python
