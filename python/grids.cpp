#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "arguments.h"
#include "bindings.h"
#include "docent/grid/clearance.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/sensor_models/ray_caster.h"
#include "exclusive.h"
#include "params.h"

namespace docent::python {
namespace {

constexpr double kMostCells = 4e8;

GridFrame frame_of(int columns, int rows, double resolution, const Point2& origin) {
  if (columns < 1 || rows < 1 || static_cast<double>(columns) * rows > kMostCells)
    throw py::value_error("columns, rows: both must be >= 1, and no more than 400 million cells in all");
  if (resolution < 1e-3) throw py::value_error("resolution: must be >= 0.001");
  return {columns, rows, finite(resolution, "resolution", 1e3), origin};
}

OccupancyGrid grid_of_cells(double resolution, const Point2& origin, const py::object& given) {
  const py::array cells = int8_of(given, "cells");
  const auto most = static_cast<py::ssize_t>(std::numeric_limits<int>::max());
  OccupancyGrid grid;
  grid.frame = frame_of(static_cast<int>(std::min(cells.shape(1), most)),
                        static_cast<int>(std::min(cells.shape(0), most)), resolution, origin);
  const auto* const from = static_cast<const std::int8_t*>(cells.data());
  grid.cells.assign(from, from + cells.size());
  if (std::any_of(grid.cells.begin(), grid.cells.end(), [](std::int8_t cell) { return cell < -1 || cell > 100; }))
    throw py::value_error("cells: each is 0..100, or -1 where nothing is known");
  return grid;
}

void bind_frame(py::module_& module) {
  py::class_<GridFrame>(module, "GridFrame",
                        "Where cells lie: arrays are [rows, columns], cell (0, 0) has its lower left corner at the "
                        "origin; no rotation.")
      .def(py::init(&frame_of), py::arg("columns"), py::arg("rows"), py::arg("resolution") = 0.05,
           py::arg("origin") = Point2{})
      .def_readonly("columns", &GridFrame::columns)
      .def_readonly("rows", &GridFrame::rows)
      .def_readonly("resolution", &GridFrame::resolution, "[m/cell]")
      .def_readonly("origin", &GridFrame::origin, "[m], map: lower left corner of cell (0, 0)")
      .def(
          "cell_at",
          [](const GridFrame& frame, const Point2& in_map) {
            const CellIndex cell = frame.cell_at(in_map);
            return std::pair{cell.column, cell.row};
          },
          py::arg("in_map"), "(column, row) of the cell that holds the point [m], also outside the grid.")
      .def(
          "centre",
          [](const GridFrame& frame, std::pair<int, int> cell) {
            return frame.centre({cell.first, cell.second});
          },
          py::arg("cell"), "The middle [m], map, of the cell (column, row).")
      .def(
          "extent",
          [](const GridFrame& frame) {
            return py::make_tuple(frame.origin.x, frame.origin.x + frame.columns * frame.resolution, frame.origin.y,
                                  frame.origin.y + frame.rows * frame.resolution);
          },
          "(left, right, bottom, top) [m], map: what matplotlib's imshow(origin='lower') takes.")
      .def("__repr__", [](const GridFrame& frame) {
        return py::str("GridFrame(columns={}, rows={}, resolution={:.3f})")
            .format(frame.columns, frame.rows, frame.resolution);
      });
}

void bind_grid(py::module_& module) {
  py::class_<OccupancyGrid> grid{module, "OccupancyGrid",
                                 "An occupancy map: cells of 0..100 percent occupied, or -1 where nothing is known."};
  grid.attr("kUnknown") = OccupancyGrid::kUnknown;
  grid.attr("kFree") = OccupancyGrid::kFree;
  grid.attr("kOccupied") = OccupancyGrid::kOccupied;
  grid.def(py::init([](const py::object& cells, double resolution, const Point2& origin) {
             return grid_of_cells(resolution, origin, cells);
           }),
           py::arg("cells"), py::arg("resolution") = 0.05, py::arg("origin") = Point2{},
           "cells: int8 [rows, columns], copied; row 0 is the lowest. resolution [m/cell].")
      .def_readonly("frame", &OccupancyGrid::frame)
      .def_property_readonly(
          "cells",
          [](py::object self) {
            const auto& map = self.cast<const OccupancyGrid&>();
            return view_of(map.cells.data(), {map.frame.rows, map.frame.columns}, self);
          },
          "int8 [rows, columns], row 0 the lowest; read-only, not a copy.")
      .def("__repr__", [](py::object self) { return py::str("OccupancyGrid({!r})").format(self.attr("frame")); });
  module.def(
      "load_map",
      [](const std::filesystem::path& yaml) {
        return value_or_raise(without_interpreter([&] { return load_map(yaml); }));
      },
      py::arg("yaml"), "Reads a map_server YAML and its PGM or PNG image. Error: names file and line.");
  module.def(
      "save_map",
      [](const OccupancyGrid& map, const std::filesystem::path& path) {
        value_or_raise(without_interpreter([&] { return save_map(map, path); }));
      },
      py::arg("map"), py::arg("path_without_extension"), "Writes PATH.yaml and PATH.pgm.");
  module.def("map_hash", &map_hash, py::arg("map"), "Of frame and cells, 16 hexadecimal digits.");
  module.def(
      "coarsened",
      [](const OccupancyGrid& map, int factor) {
        if (factor < 1 || factor > 1000) throw py::value_error("factor: 1..1000 is expected");
        return coarsened(map, factor);
      },
      py::arg("map"), py::arg("factor"), "A cell is occupied if any cell under it is, unknown if all are.");
  module.def(
      "distance_transform",
      [](const GridFrame& frame, const py::object& occupied) {
        const std::vector<bool> cells = bools_of(occupied, "occupied", frame.rows, frame.columns);
        return owned_by_array(without_interpreter([&] { return distance_transform(frame, cells); }),
                              {frame.rows, frame.columns});
      },
      py::arg("frame"), py::arg("occupied"),
      "float32 [rows, columns] [m] from each cell's middle to that of the nearest cell that is true in `occupied`, "
      "bool [rows, columns]; infinity where there is none.");
}

/// [n] of the headings; NaN where the map does not say.
py::array cast_rays(const sensor_models::RayCaster& caster, const Point2& origin, const py::object& headings,
                    double max_range, double unknown_allowance) {
  std::vector<double> ranges = doubles_of(headings, "headings");
  for (const double heading : ranges) finite(heading, "headings");
  positive(max_range, "max_range", 1e4);
  finite(unknown_allowance, "unknown_allowance", 1e4);
  without_interpreter([&] {
    for (double& range : ranges) {
      const auto met = caster.cast(origin, unit(Angle::radians(range)), max_range, unknown_allowance);
      range = met.value_or(std::numeric_limits<double>::quiet_NaN());
    }
  });
  const py::ssize_t count = length(ranges.size());
  return owned_by_array(std::move(ranges), {count});
}

void bind_rays(py::module_& module) {
  using sensor_models::RayCaster;
  py::class_<RayCaster>(module, "RayCaster", "Ranges that a perfect sensor would measure in a map.")
      .def(py::init([](const OccupancyGrid& map) {
             return without_interpreter([&] { return std::make_unique<RayCaster>(map); });
           }),
           py::arg("map"))
      .def("cast", &cast_rays, py::arg("origin"), py::arg("headings"), py::arg("max_range"),
           py::arg("unknown_allowance") = 0.3,
           "float64 [n] [m] from `origin` (map) along each of `headings`, float [n] [rad] (map), to the first occupied "
           "cell; max_range where none is nearer; NaN where more than `unknown_allowance` [m] of the way is unknown.")
      .def("clearance", &RayCaster::clearance, py::arg("in_map"),
           "[m] to the nearest occupied cell's middle; infinity outside the map.")
      .def("frame", &RayCaster::frame);
}

}  // namespace

void bind_grids(py::module_& module) {
  bind_frame(module);
  bind_grid(module);
  bind_rays(module);
  bind_params<Clearance>(module, "Clearance", "How much room [m] a place must leave: walls, hazards, border.");
}

}  // namespace docent::python
