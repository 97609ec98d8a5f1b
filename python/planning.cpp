#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>

#include "arguments.h"
#include "bindings.h"
#include "docent/planning/value_iteration/route.h"
#include "docent/planning/value_iteration/value_iteration.h"
#include "exclusive.h"
#include "params.h"

namespace docent::python {
namespace {

using namespace planning;

constexpr int kToTheEnd = std::numeric_limits<int>::max();

/// Both keep their frame for life.
using SharedValues = Exclusive<ValueIteration>;
using SharedPlanner = Exclusive<RoutePlanner>;

std::vector<float> values_of(const ValueIteration& iteration) {
  const GridFrame& frame = iteration.frame();
  std::vector<float> values;
  values.reserve(frame.size());
  for (int row = 0; row < frame.rows; ++row)
    for (int column = 0; column < frame.columns; ++column) values.push_back(iteration.value({column, row}));
  return values;
}

CellIndex cell_in(const GridFrame& frame, std::pair<int, int> cell) {
  if (!frame.holds({cell.first, cell.second})) throw py::index_error("the cell (column, row) lies outside the grid");
  return {cell.first, cell.second};
}

GridFrame frame_of(SharedValues& self) {
  return self.use([](const ValueIteration& v) { return v.frame(); });
}
GridFrame frame_of(SharedPlanner& self) {
  return self.use([](const RoutePlanner& p) { return p.frame(); });
}

void set_costs(SharedValues& self, const py::object& given) {
  const GridFrame frame = frame_of(self);
  const std::vector<float> costs = float_grid_of(given, "costs", frame.rows, frame.columns);
  for (const float cost : costs)
    if (!(cost > 0.0F)) throw py::value_error("costs: each is > 0, infinity where a cell is closed");
  self.use([&](ValueIteration& v) { v.set_costs(costs); });
}

py::array cells_of(const std::vector<CellIndex>& cells) {
  std::vector<int> numbers;
  for (const CellIndex& cell : cells) {
    numbers.push_back(cell.column);
    numbers.push_back(cell.row);
  }
  return owned_by_array(std::move(numbers), {length(cells.size()), 2});
}

int checked_visits(int most_visits) {
  if (most_visits < 0) throw py::value_error("most_visits: a number >= 0 is expected");
  return most_visits;
}

void bind_values(py::module_& module) {
  py::class_<SharedValues>(
      module, "ValueIteration",
      "The value of a cell is the least cost of a way to the nearest goal: entering a cell costs its "
      "cost times the step's length in cells.")
      .def(py::init([](const GridFrame& frame) {
             return std::make_unique<SharedValues>(std::make_unique<ValueIteration>(frame));
           }),
           py::arg("frame"), "All cells are closed until set_costs.")
      .def("set_costs", &set_costs, py::arg("costs"), "float [rows, columns], > 0; infinity: closed.")
      .def(
          "set_goals",
          [](SharedValues& self, const std::vector<std::pair<int, int>>& cells) {
            std::vector<ValueIteration::Goal> goals;
            const GridFrame frame = frame_of(self);
            for (const auto& cell : cells) goals.push_back({cell_in(frame, cell), 0.0F});
            self.use([&](ValueIteration& v) { v.set_goals(goals); });
          },
          py::arg("goals"), "Starts over for these cells, [(column, row)].")
      .def(
          "iterate",
          [](SharedValues& self, int most_visits) {
            checked_visits(most_visits);
            return self.use([&](ValueIteration& v) { return v.iterate(most_visits); });
          },
          py::arg("most_visits") = kToTheEnd, "Works until nothing changes; True when the values have converged.")
      .def("is_settled", [](SharedValues& self) { return self.use([](ValueIteration& v) { return v.is_settled(); }); })
      .def(
          "values",
          [](SharedValues& self) {
            const GridFrame frame = frame_of(self);
            return owned_by_array(self.use([](ValueIteration& v) { return values_of(v); }),
                                  {frame.rows, frame.columns});
          },
          "float32 [rows, columns], new: the value function; infinity where no way is known.")
      .def(
          "descend",
          [](SharedValues& self, std::pair<int, int> start) {
            const CellIndex cell = cell_in(frame_of(self), start);
            return cells_of(self.use([&](ValueIteration& v) { return v.descend(cell); }));
          },
          py::arg("start"), "int32 [n, 2] (column, row): the cells after `start` to a goal; [0, 2] without a way.")
      .def("frame", [](SharedValues& self) { return frame_of(self); });
}

std::unique_ptr<SharedPlanner> planner_of(const OccupancyGrid& map, const py::iterable& hazards, const py::object& area,
                                          RouteParams params) {
  check_params(params);
  finite(params.robot_radius, "params.robot_radius", 1e3);
  finite(params.clearance.hazards, "params.clearance.hazards", 1e3);
  const std::vector<Polygon> closed = polygons_of(hazards, "hazards");
  const Polygon inside = polygon_of(area, "area", true);
  return without_interpreter(
      [&] { return std::make_unique<SharedPlanner>(std::make_unique<RoutePlanner>(map, closed, inside, params)); });
}

void set_obstacles(SharedPlanner& self, const py::object& obstacles, const py::object& settled) {
  const GridFrame frame = frame_of(self);
  const std::vector<bool> blocked = bools_of(obstacles, "obstacles", frame.rows, frame.columns);
  const std::vector<bool> still =
      settled.is_none() ? std::vector<bool>{} : bools_of(settled, "settled", frame.rows, frame.columns);
  self.use([&](RoutePlanner& p) { p.set_obstacles(blocked, still); });
}

void set_goals(SharedPlanner& self, const py::object& goals, double tolerance) {
  const std::vector<Point2> points = points_of(goals, "goals");
  positive(tolerance, "tolerance", 1e3);
  self.use([&](RoutePlanner& p) { p.set_goals(points, tolerance); });
}

void bind_plans(py::class_<SharedPlanner>& planner) {
  planner.def("set_obstacles", &set_obstacles, py::arg("obstacles"), py::arg("settled") = py::none{},
              "bool [rows, columns] of frame(): what stands there now and is not in the map; of that, what has stood "
              "there for long.");
  planner.def("set_goals", &set_goals, py::arg("goals"), py::arg("tolerance") = 0.1,
              "[n, 2] [m], map: ways lead to the nearest by cost. tolerance [m].");
  planner.def(
      "iterate",
      [](SharedPlanner& self, int most_visits) {
        checked_visits(most_visits);
        return self.use([&](RoutePlanner& p) { return p.iterate(most_visits); });
      },
      py::arg("most_visits") = kToTheEnd, "Works until nothing changes; True when the values have converged.");
  planner.def(
      "settle",
      [](SharedPlanner& self, const Point2& start, int most_visits) {
        checked_visits(most_visits);
        return self.use([&](RoutePlanner& p) { return p.settle(start, most_visits); });
      },
      py::arg("start"), py::arg("most_visits") = kToTheEnd,
      "Works until the way from `start` [m], map, is the best one.");
  planner.def(
      "hold_way",
      [](SharedPlanner& self, const Point2& start) { self.use([&](RoutePlanner& p) { p.hold_way(start); }); },
      py::arg("start"), "Decides which way to follow from `start` [m], map, so that equal ones do not take turns.");
}

void bind_ways(py::class_<SharedPlanner>& planner) {
  planner.def(
      "way",
      [](SharedPlanner& self, const Point2& start) {
        return array_of(self.use([&](RoutePlanner& p) { return p.way(start); }));
      },
      py::arg("start"), "float64 [n, 2] [m], map: from `start`, which is left out, to a goal; [0, 2] without a way.");
  planner.def(
      "cost_from",
      [](SharedPlanner& self, const Point2& start) {
        return self.use([&](RoutePlanner& p) { return p.cost_from(start); });
      },
      py::arg("start"), "Of the way, in metres of free floor; infinity where there is none.");
  planner.def(
      "is_closed",
      [](SharedPlanner& self, const Point2& at) { return self.use([&](RoutePlanner& p) { return p.is_closed(at); }); },
      py::arg("in_map"));
  planner.def(
      "values",
      [](SharedPlanner& self) {
        const GridFrame frame = frame_of(self);
        return owned_by_array(self.use([](RoutePlanner& p) { return values_of(p.values()); }),
                              {frame.rows, frame.columns});
      },
      "float32 [rows, columns], new: the value function, in metres of free floor; infinity where no way is known.");
  planner.def(
      "static_costs",
      [](py::object self) {
        auto& own = self.cast<SharedPlanner&>();
        const GridFrame frame = frame_of(own);
        const float* const costs = own.use([](RoutePlanner& p) { return p.static_costs().data(); });
        return view_of(costs, {frame.rows, frame.columns}, self);
      },
      "float32 [rows, columns]: costs of cells in metres of free floor; infinity: closed. Read-only, not a copy.");
  planner.def(
      "frame", [](SharedPlanner& self) { return frame_of(self); }, "Where the planner's cells lie.");
}

}  // namespace

void bind_planning(py::module_& module) {
  bind_params<RouteParams>(module, "RouteParams", "What makes floor dear or closed to a way: see route.h.");
  bind_values(module);
  py::class_<SharedPlanner> planner{module, "RoutePlanner", "Plans for a disc-shaped robot in a museum's map."};
  planner.def(
      py::init(&planner_of), py::arg("map"), py::arg("hazards") = py::tuple{}, py::arg("area") = py::tuple{},
      py::arg("params") = RouteParams{},
      "hazards: polygons [n, 2] [m], map, that must not be touched. area: where the robot's centre stays; empty: "
      "everywhere.");
  bind_plans(planner);
  bind_ways(planner);
}

}  // namespace docent::python
