// SPDX-License-Identifier: BSD-3-Clause
#include "Bindings.h"

PYBIND11_MODULE(_core, module) {
  using namespace hoctomap::python;
  // Classes say that they are of `hoctomap`, where users find them.
  const pybind11::object name = module.attr("__name__");
  module.attr("__name__") = "hoctomap";
  module.attr("__version__") = HOCTOMAP_VERSION;
  bindErrors(module);
  bindMeasurement(module);
  bindMap(module);
  bindQuery(module);
  bindMapper(module);
  bindDiff(module);
  module.attr("__name__") = name;
}
