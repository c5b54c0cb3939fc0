// SPDX-License-Identifier: BSD-3-Clause
// Between numpy and the libraries' types.
#pragma once

#include <pybind11/numpy.h>

#include <span>

#include "hoctomap/geometry/PointCloud.h"
#include "hoctomap/geometry/Pose.h"

namespace hoctomap::python {

namespace py = pybind11;

// Rows of three numbers without gaps: arrays and vectors have the same bytes.
static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));

template <typename Number>
using Array = py::array_t<Number, py::array::c_style | py::array::forcecast>;

/// The rows of an (N, 3) array, in its memory. @throws ValueError for another shape
[[nodiscard]] std::span<const Eigen::Vector3d> rowsOf(const Array<double>& array, const char* name);
/// One point: 3 numbers. @throws ValueError
[[nodiscard]] Eigen::Vector3d pointOf(const Array<double>& array, const char* name);
/// A rigid transform: 4x4. @throws ValueError if it is none
[[nodiscard]] Pose poseOf(const Array<double>& matrix);
[[nodiscard]] py::array_t<double> toArray(const Eigen::Matrix4d& matrix);
[[nodiscard]] py::array_t<double> toArray(const Eigen::Vector3d& point);
[[nodiscard]] inline py::array_t<double> toArray(const Pose& pose) {
  return toArray(toIsometry(pose).matrix());
}

/// A read-only (N, 3) view of points that `owner` keeps alive and unchanged. No copy.
[[nodiscard]] py::array viewOf(const PointCloud& points, py::handle owner);
/// The same of plain numbers, in a given shape.
template <typename Number>
[[nodiscard]] py::array viewOf(const std::vector<Number>& numbers, std::vector<py::ssize_t> shape,
                               py::handle owner) {
  py::array view(py::dtype::of<Number>(), std::move(shape), numbers.data(), owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

}  // namespace hoctomap::python
