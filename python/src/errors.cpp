// SPDX-License-Identifier: BSD-3-Clause
#include <mutex>

#include "Bindings.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap::python {

namespace py = pybind11;

namespace {

/// The classes live as long as the interpreter.
struct Classes {
  PyObject* error = nullptr;
  PyObject* config = nullptr;
  PyObject* input = nullptr;
  PyObject* map = nullptr;
  PyObject* file = nullptr;
  PyObject* limit = nullptr;
};

PyObject* makeClass(py::module_& module, const char* name, const char* doc, const py::object& bases) {
  const std::string full = std::string("hoctomap.") + name;
  PyObject* made = PyErr_NewExceptionWithDoc(full.c_str(), doc, bases.ptr(), nullptr);
  if (made == nullptr) throw py::error_already_set();
  module.attr(name) = py::handle(made);
  return made;
}

const Classes& classes(py::module_* module = nullptr) {
  static const Classes made = [module] {
    py::module_& m = *module;
    Classes c;
    const py::handle value(PyExc_ValueError);
    c.error = makeClass(m, "Error", "What went wrong in hoctomap, in one line.",
                        py::reinterpret_borrow<py::object>(PyExc_Exception));
    const py::handle error(c.error);
    c.config = makeClass(m, "ConfigError", "Settings that cannot be used.", py::make_tuple(error, value));
    c.input = makeClass(m, "InputError", "Measurements or poses that cannot be used.",
                        py::make_tuple(error, value));
    c.map = makeClass(m, "MapError", "A damaged map on disk.", py::make_tuple(error, value));
    c.file = makeClass(m, "FileError", "A file that cannot be read or written.",
                       py::make_tuple(error, py::handle(PyExc_OSError)));
    c.limit = makeClass(m, "LimitError", "A limit of the settings or the machine.",
                        py::make_tuple(error, py::handle(PyExc_RuntimeError)));
    return c;
  }();
  return made;
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const ConfigError& e) {
    PyErr_SetString(classes().config, e.what());
  } catch (const InputError& e) {
    PyErr_SetString(classes().input, e.what());
  } catch (const MapError& e) {
    PyErr_SetString(classes().map, e.what());
  } catch (const FileError& e) {
    PyErr_SetString(classes().file, e.what());
  } catch (const LimitError& e) {
    PyErr_SetString(classes().limit, e.what());
  } catch (const Error& e) {
    PyErr_SetString(classes().error, e.what());
  }
}

}  // namespace

void bindErrors(py::module_& module) {
  (void)classes(&module);
  py::register_local_exception_translator(&translate);
}

}  // namespace hoctomap::python
