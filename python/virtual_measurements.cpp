#include "docent/collision_avoidance/virtual_measurements/virtual_measurements.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arguments.h"
#include "bindings.h"
#include "docent/localization/belief/belief_summary.h"
#include "exclusive.h"
#include "params.h"

namespace docent::python {
namespace {

using namespace collision_avoidance;
using localization::BeliefSummary;
using SharedMeasurements = Exclusive<VirtualMeasurements>;
using Ends = VirtualMeasurements::Ends;

std::unique_ptr<SharedMeasurements> measurements_of(const py::object& area, const py::iterable& hazards,
                                                    const VirtualMeasurementParams& params, const std::string& ends) {
  check_params(params);
  if (ends != "both" && ends != "hazards" && ends != "border")
    throw py::value_error("ends: 'both', 'hazards' or 'border' is expected");
  return std::make_unique<SharedMeasurements>(
      std::make_unique<VirtualMeasurements>(polygon_of(area, "area", true), polygons_of(hazards, "hazards"), params,
                                            ends == "both"      ? Ends::both
                                            : ends == "hazards" ? Ends::hazards
                                                                : Ends::border));
}

/// As the robot takes them from its belief.
VirtualMeasurements::Scan measure_belief(SharedMeasurements& self, const BeliefSummary& belief) {
  return self.use([&](VirtualMeasurements& own) {
    std::vector<WeightedPose> poses;
    for (const auto& [x, y, theta, mass] : belief.cells)
      poses.push_back(
          {{static_cast<double>(x), static_cast<double>(y)}, static_cast<double>(theta), static_cast<double>(mass)});
    std::vector<WeightedSquare> squares;
    const double side = belief.rest_cell_size;
    for (std::size_t i = 0; i < belief.rest.size(); ++i) {
      const auto columns = static_cast<std::size_t>(belief.rest_columns);
      squares.push_back({{belief.rest_origin.x + (static_cast<double>(i % columns) + 0.5) * side,
                          belief.rest_origin.y + (static_cast<double>(i / columns) + 0.5) * side},
                         side,
                         static_cast<double>(belief.rest[i])});
    }
    return own.measure(poses, squares);
  });
}

VirtualMeasurements::Scan measure_poses(SharedMeasurements& self, const py::object& given) {
  const std::vector<double> rows = rows_of(given, "poses", 4);
  std::vector<WeightedPose> poses;
  for (std::size_t i = 0; i < rows.size(); i += 4) {
    if (!(rows[i + 3] >= 0.0)) throw py::value_error("poses: a mass is < 0");
    poses.push_back({{rows[i], rows[i + 1]}, Angle::radians(rows[i + 2]).radians(), rows[i + 3]});
  }
  return self.use([&](VirtualMeasurements& own) { return own.measure(poses, {}); });
}

void bind_virtual_scan(py::module_& module) {
  using Scan = VirtualMeasurements::Scan;
  py::class_<Scan>(module, "VirtualScan", "VirtualMeasurements::Scan.")
      .def_property_readonly(
          "ranges",
          [](py::object self) {
            return view_of(self.cast<const Scan&>().ranges.data(), {VirtualMeasurements::kDirections}, self);
          },
          "float64 [180] [m]: direction i points 2 i - 180 degrees from the robot's heading. Read-only, not a copy.")
      .def_readonly("possible_mass", &Scan::possible_mass, "Share of the belief that lies where the robot can be.");
}

}  // namespace

void bind_virtual_measurements(py::module_& module) {
  bind_params<VirtualMeasurementParams>(module, "VirtualMeasurementParams", "See virtual_measurements.h.");
  bind_virtual_scan(module);
  py::class_<SharedMeasurements> bound{module, "VirtualMeasurements",
                                       "Ranges to hazards and to the area's border, from the whole belief."};
  bound.attr("kDirections") = VirtualMeasurements::kDirections;
  bound.attr("kMaxRange") = VirtualMeasurements::kMaxRange;
  bound
      .def(py::init(&measurements_of), py::arg("area"), py::arg("hazards"),
           py::arg("params") = VirtualMeasurementParams{}, py::arg("ends") = "both",
           "area: polygon [n, 2] [m], map; empty: everywhere. hazards: polygons. ends: what rays end on, 'both', "
           "'hazards' or 'border'.")
      .def("measure", &measure_belief, py::arg("belief"),
           "The largest distances that, with the wanted confidence, underestimate the true ones.")
      .def("measure", &measure_poses, py::arg("poses"),
           "The same of poses, float [n, 4]: x, y [m], heading [rad], mass.")
      .def(
          "is_possible",
          [](SharedMeasurements& self, const Point2& at) {
            return self.use([&](VirtualMeasurements& own) { return own.is_possible(at); });
          },
          py::arg("position"), "Whether the robot's centre may be there [m], map.")
      .def(
          "nearest",
          [](SharedMeasurements& self, const Point2& at) {
            return self.use([&](VirtualMeasurements& own) { return own.nearest(at); });
          },
          py::arg("position"), "[m] to the nearest hazard or border; 0 where the robot cannot be.");
}

}  // namespace docent::python
