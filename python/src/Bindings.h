// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace hoctomap::python {

// One a part of the module, each in its own file.
void bindErrors(pybind11::module_& module);
void bindMap(pybind11::module_& module);
void bindQuery(pybind11::module_& module);
void bindMeasurement(pybind11::module_& module);
void bindMapper(pybind11::module_& module);
void bindDiff(pybind11::module_& module);

}  // namespace hoctomap::python
