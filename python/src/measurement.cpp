// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include "Arrays.h"
#include "Bindings.h"
#include "Measurements.h"

namespace hoctomap::python {

namespace {

std::shared_ptr<NumberedMeasurement> finished(Measurement z, std::optional<std::uint64_t> scan, double stamp,
                                              std::string sensor) {
  z.scan = scan.value_or(0);
  z.stamp = stamp;
  z.sensor = std::move(sensor);
  return std::make_shared<NumberedMeasurement>(NumberedMeasurement{std::move(z), scan.has_value()});
}

std::shared_ptr<NumberedMeasurement> fromPoints(const Array<float>& points,
                                                const Array<double>& world_T_sensor,
                                                std::optional<std::uint64_t> scan, double stamp,
                                                std::string sensor, double min_range) {
  if (points.ndim() != 2 || points.shape(1) != 3)
    throw py::value_error("points must be an array of shape (N, 3)");
  const Pose pose = poseOf(world_T_sensor);
  const auto* first = reinterpret_cast<const Eigen::Vector3f*>(points.data());
  const py::gil_scoped_release released;
  return finished(fromSensorPoints(PointCloud(first, first + points.shape(0)), pose, {min_range}), scan,
                  stamp, std::move(sensor));
}

std::shared_ptr<NumberedMeasurement> fromDepth(const Array<float>& depth, const PinholeCamera& intrinsics,
                                               const Array<double>& world_T_sensor,
                                               std::optional<std::uint64_t> scan, double stamp,
                                               std::string sensor, double min_range) {
  if (depth.ndim() != 2) throw py::value_error("depth must be an array of shape (height, width)");
  const Pose pose = poseOf(world_T_sensor);
  PinholeCamera camera = intrinsics;
  camera.height = static_cast<int>(depth.shape(0));
  camera.width = static_cast<int>(depth.shape(1));
  const float* first = depth.data();
  const py::gil_scoped_release released;
  DepthImage image{camera, {first, first + depth.size()}};
  return finished(unproject(std::move(image), pose, {min_range}), scan, stamp, std::move(sensor));
}

}  // namespace

void bindMeasurement(py::module_& module) {
  py::class_<PinholeCamera>(
      module, "Camera",
      "A pinhole camera. Its frame is x forward, y left, z up; pixel (u, v) of a point is\n"
      "u = cx - fx y / x, v = cy - fy z / x.")
      .def(py::init([](double fx, double fy, double cx, double cy) {
             if (!(fx > 0.0) || !(fy > 0.0)) throw py::value_error("focal lengths must be positive");
             return PinholeCamera{0, 0, fx, fy, cx, cy};
           }),
           py::arg("fx"), py::arg("fy"), py::arg("cx"), py::arg("cy"), "Focal lengths and centre, pixels.")
      .def_readonly("fx", &PinholeCamera::fx)
      .def_readonly("fy", &PinholeCamera::fy)
      .def_readonly("cx", &PinholeCamera::cx)
      .def_readonly("cy", &PinholeCamera::cy);

  using Held = NumberedMeasurement;
  py::class_<Held, std::shared_ptr<Held>>(
      module, "Measurement",
      "One scan: points, and where the sensor was. Poses are (4, 4) matrices that\n"
      "take the sensor's frame (x forward, y left, z up) to the world's.")
      .def_static(
          "from_points", &fromPoints, py::arg("points"), py::arg("world_T_sensor"), py::kw_only(),
          py::arg("scan") = py::none(), py::arg("stamp") = 0.0, py::arg("sensor") = "",
          py::arg("min_range") = 0.0,
          "Of a cloud in the sensor's frame, (N, 3), m. Points that are not finite, at the origin, nearer\n"
          "than min_range or beyond 1e6 m are dropped. scan: its number, from 0; without one the mapper\n"
          "numbers it. stamp: seconds.")
      .def_static(
          "from_depth", &fromDepth, py::arg("depth"), py::arg("camera"), py::arg("world_T_sensor"),
          py::kw_only(), py::arg("scan") = py::none(), py::arg("stamp") = 0.0, py::arg("sensor") = "",
          py::arg("min_range") = 0.0,
          "Of a depth image, (height, width), m along the optical axis, 0 for no return. Touching things\n"
          "are told apart better in images than in clouds.")
      .def_property_readonly(
          "scan", [](const Held& h) { return h.z.scan; }, "Number of the scan.")
      .def_property_readonly(
          "stamp", [](const Held& h) { return h.z.stamp; }, "Seconds.")
      .def_property_readonly("sensor", [](const Held& h) { return h.z.sensor; })
      .def_property_readonly("world_T_sensor", [](const Held& h) { return toArray(h.z.world_T_sensor); })
      .def_property_readonly(
          "origin", [](const Held& h) { return toArray(h.z.origin()); },
          "Where the sensor is in the world, (3,).")
      .def_property_readonly(
          "points", [](const std::shared_ptr<Held>& h) { return viewOf(h->z.world_points, py::cast(h)); },
          "The points in the world's frame, (N, 3) float32. Read-only, not copied.")
      .def_property_readonly(
          "pixel_of_point",
          [](const std::shared_ptr<Held>& h) {
            return viewOf(h->z.pixel_of_point, {static_cast<py::ssize_t>(h->z.pixel_of_point.size())},
                          py::cast(h));
          },
          "Of a depth image: the row-major index of each point's pixel. Else empty. Not copied.")
      .def_property_readonly(
          "depth",
          [](const std::shared_ptr<Held>& h) -> py::object {
            if (!h->z.image) return py::none();
            return viewOf(h->z.image->depth, {h->z.image->camera.height, h->z.image->camera.width},
                          py::cast(h));
          },
          "The depth image, (height, width); None of a cloud. Read-only, not copied.")
      .def_property_readonly("dropped_points", [](const Held& h) { return h.z.dropped_points; })
      .def("__len__", [](const Held& h) { return h.z.world_points.size(); })
      .def("__repr__", [](const Held& h) {
        return "<hoctomap.Measurement of " + std::to_string(h.z.world_points.size()) + " points>";
      });
}

}  // namespace hoctomap::python
