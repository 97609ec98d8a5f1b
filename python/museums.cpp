#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arguments.h"
#include "bindings.h"
#include "docent/museum/museum.h"
#include "exclusive.h"

namespace docent::python {
namespace {

using namespace museum;

void bind_things(py::module_& module) {
  py::class_<Hazard>(module, "Hazard", "What sensors cannot see, as surveyed.")
      .def_readonly("id", &Hazard::id)
      .def_property_readonly(
          "kind", [](const Hazard& hazard) { return words_of(HazardKind{})[static_cast<std::size_t>(hazard.kind)]; })
      .def_property_readonly(
          "polygon", [](const Hazard& hazard) { return array_of(hazard.polygon); }, "float64 [n, 2] [m], map.");
  py::class_<Exhibit>(module, "Exhibit", "What the robot shows.")
      .def_readonly("id", &Exhibit::id)
      .def_readonly("title", &Exhibit::title, "By language.")
      .def_readonly("pose", &Exhibit::pose, "map_from_base where the robot stands to show it.")
      .def_readonly("look_at", &Exhibit::look_at, "[m], map: what it points at.")
      .def_readonly("topics", &Exhibit::topics)
      .def_readonly("web_only", &Exhibit::web_only);
}

}  // namespace

void bind_museums(py::module_& module) {
  bind_things(module);
  py::class_<Museum>(module, "Museum", "A museum's folder, read and checked: what the robot knows of the building.")
      .def_readonly("folder", &Museum::folder)
      .def_readonly("name", &Museum::name, "By language.")
      .def_readonly("languages", &Museum::languages)
      .def_readonly("map", &Museum::map)
      .def_property_readonly(
          "area", [](const Museum& museum) { return array_of(museum.area); },
          "float64 [n, 2] [m], map: where the robot's centre stays.")
      .def_readonly("hazards", &Museum::hazards)
      .def(
          "hazard_polygons",
          [](const Museum& museum) {
            py::list polygons;
            for (const Hazard& hazard : museum.hazards) polygons.append(array_of(hazard.polygon));
            return polygons;
          },
          "float64 [n, 2] [m], map, of each hazard.")
      .def_readonly("home", &Museum::home, "map_from_base")
      .def_readonly("charger", &Museum::charger, "map_from_base, or None")
      .def_readonly("exhibits", &Museum::exhibits);
  module.def(
      "load_museum",
      [](const std::filesystem::path& folder) {
        return value_or_raise(without_interpreter([&] { return load_museum(folder); }));
      },
      py::arg("folder"),
      "Reads FOLDER/museum.yaml with its map and texts. Error: the first fault, with file and line.");
}

}  // namespace docent::python
