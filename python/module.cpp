#include <pybind11/pybind11.h>

#include "arguments.h"
#include "bindings.h"

namespace docent::python {
namespace {

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const Failed& failed) {
    // Paths need not be UTF-8: Error.file is then as Python's own paths are.
    const py::object error = py::module_::import("docent._error").attr("Error");
    const py::bytes message{failed.what()};
    PyErr_SetObject(error.ptr(), error(message.attr("decode")("utf-8", "surrogateescape")).ptr());
  }
}

}  // namespace
}  // namespace docent::python

PYBIND11_MODULE(_docent, module) {
  module.doc() = "The library of Docent. `docent` holds all of it, and what is written in Python.";
  pybind11::register_exception_translator(&docent::python::translate);
  docent::python::bind_geometry(module);
  docent::python::bind_grids(module);
  docent::python::bind_sensor_models(module);
  docent::python::bind_logs(module);
  docent::python::bind_museums(module);
  docent::python::bind_localization(module);
  docent::python::bind_planning(module);
  docent::python::bind_virtual_measurements(module);
  docent::python::bind_mapping(module);
  docent::python::bind_recordings(module);
}
