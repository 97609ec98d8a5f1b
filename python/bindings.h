#pragma once

#include <pybind11/pybind11.h>

namespace docent::python {

// Each gives the module the classes and functions of its subject. Those that others take come first.
void bind_geometry(pybind11::module_& module);
void bind_grids(pybind11::module_& module);
void bind_sensor_models(pybind11::module_& module);
void bind_logs(pybind11::module_& module);
void bind_museums(pybind11::module_& module);
void bind_localization(pybind11::module_& module);
void bind_planning(pybind11::module_& module);
void bind_virtual_measurements(pybind11::module_& module);
void bind_mapping(pybind11::module_& module);
void bind_recordings(pybind11::module_& module);

}  // namespace docent::python
