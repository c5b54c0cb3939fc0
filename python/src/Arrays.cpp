// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays.h"

#include <algorithm>
#include <string>

namespace hoctomap::python {

std::span<const Eigen::Vector3d> rowsOf(const Array<double>& array, const char* name) {
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw py::value_error(std::string(name) + " must be an array of shape (N, 3)");
  }
  // The array holds rows of three doubles; an Eigen::Vector3d is just that (see the assertions).
  return {reinterpret_cast<const Eigen::Vector3d*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

Eigen::Vector3d pointOf(const Array<double>& array, const char* name) {
  if (array.ndim() != 1 || array.shape(0) != 3)
    throw py::value_error(std::string(name) + " must be 3 numbers");
  return {array.at(0), array.at(1), array.at(2)};
}

Pose poseOf(const Array<double>& matrix) {
  if (matrix.ndim() != 2 || matrix.shape(0) != 4 || matrix.shape(1) != 4) {
    throw py::value_error("a pose must be a 4x4 matrix");
  }
  return poseFromMatrix(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(matrix.data()));
}

py::array_t<double> toArray(const Eigen::Matrix4d& matrix) {
  py::array_t<double> array({4, 4});
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(array.mutable_data()) = matrix;
  return array;
}

py::array_t<double> toArray(const Eigen::Vector3d& point) {
  py::array_t<double> array(3);
  std::copy_n(point.data(), 3, array.mutable_data());
  return array;
}

py::array viewOf(const PointCloud& points, py::handle owner) {
  py::array view(py::dtype::of<float>(), {static_cast<py::ssize_t>(points.size()), py::ssize_t{3}},
                 points.empty() ? nullptr : points.data()->data(), owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

}  // namespace hoctomap::python
