#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arguments.h"
#include "bindings.h"
#include "docent/mapping/graph_mapping/graph_mapper.h"
#include "docent/mapping/occupancy/scan_mapper.h"
#include "docent/recording/laser_log.h"
#include "exclusive.h"
#include "params.h"

namespace docent::python {
namespace {

using namespace mapping;
using recording::LaserLog;
using recording::LoggedScan;

/// A map of a log and how it came about.
struct LogMap {
  OccupancyGrid map;
  std::vector<std::size_t> scans;  ///< indices in the log
  GraphMap graph;                  ///< of these scans
};

sensor_models::RangeSweep sweep_of(const LoggedScan& scan, double max_range) {
  sensor_models::RangeSweep sweep;
  sensor_models::append(sweep, {scan.ranges, scan.first_bearing, scan.bearing_step, 0.02, max_range}, {});
  return sweep;
}

/// The front laser's scans, where the robot has moved.
std::vector<std::size_t> choose(const LaserLog& log, const ScanChoiceParams& params) {
  ScanChoice choice{params};
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const LoggedScan& scan = log.scans[i];
    const bool is_second = scan.rear && !log.scans.front().rear;
    if (!is_second && choice.takes(scan.odom_from_base)) chosen.push_back(i);
  }
  return chosen;
}

std::vector<MappingScan> mapping_scans(const LaserLog& log, const std::vector<std::size_t>& chosen,
                                       const PointSweepParams& params) {
  std::vector<MappingScan> scans;
  for (const std::size_t i : chosen) {
    const LoggedScan& scan = log.scans[i];
    MappingScan& taken = scans.emplace_back();
    taken.odom_from_base = scan.odom_from_base;
    for (const SurfacePoint& point : surface_points(sweep_of(scan, log.max_range), params))
      taken.points.push_back(transformed(scan.base_from_laser, point));
    taken.sensors.push_back(scan.base_from_laser.position());
  }
  return scans;
}

OccupancyGrid grid_of(const LaserLog& log, const LogMap& made, const ScanMapperParams& params) {
  std::vector<PlacedSweep> placed;
  for (std::size_t n = 0; n < made.scans.size(); ++n) {
    const LoggedScan& scan = log.scans[made.scans[n]];
    placed.push_back({sweep_of(scan, log.max_range), made.graph.map_from_base[n] * scan.base_from_laser});
  }
  ScanMapper mapper{value_or_raise(ScanMapper::frame_of(placed, params)), params};
  for (const PlacedSweep& sweep : placed) mapper.add(sweep);
  return mapper.map();
}

using Progress = std::function<void(const std::string&, std::size_t, std::size_t)>;

LogMap map_log(const LaserLog& log, std::optional<ScanMapperParams> given, double way, double turn,
               const Progress& progress) {
  if (!(way >= 0.0 && turn >= 0.0)) throw py::value_error("way, turn: numbers >= 0 are expected");
  if (given) check_params(*given);
  if (log.scans.size() < 2) throw py::value_error("log: a map needs two scans at least");
  return without_interpreter([&] {
    const GraphMapperParams params;
    LogMap made;
    made.scans = choose(log, {way, turn});
    const auto tell = [&](const MappingProgress& now) {
      const py::gil_scoped_acquire interpreter;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set{};
      if (progress) progress(now.stage, now.done, now.of);
    };
    made.graph = map_by_graph(mapping_scans(log, made.scans, params.points), params, tell);
    ScanMapperParams mapper = given.value_or(ScanMapperParams{});
    if (!given) mapper.fewest_hits = fewest_hits_of(made.graph.map_from_base);
    made.map = grid_of(log, made, mapper);
    return made;
  });
}

void bind_log_map(py::module_& module) {
  py::class_<MapJudgement>(module, "MapJudgement", "What a map says of itself, without any truth.")
      .def_readonly("pairs", &MapJudgement::pairs)
      .def_readonly("in_conflict", &MapJudgement::in_conflict)
      .def_readonly("mean_conflict", &MapJudgement::mean_conflict)
      .def_readonly("expected_error", &MapJudgement::expected_error, "[m]")
      .def_readonly("odometry_scale", &MapJudgement::odometry_scale)
      .def_readonly("is_trusted", &MapJudgement::is_trusted)
      .def_readonly("reason", &MapJudgement::reason, "Why not, for a person.");
  py::class_<LogMap>(module, "LogMap", "A map of a log and how it came about.")
      .def_readonly("map", &LogMap::map)
      .def_readonly("scans", &LogMap::scans, "Indices in the log of the scans that it is made of.")
      .def_property_readonly(
          "map_from_base", [](const LogMap& made) { return array_of(made.graph.map_from_base); },
          "float64 [scans, 3]: x, y [m], theta [rad] of each of `scans`; the first lies where its odometry says.")
      .def_property_readonly("loops", [](const LogMap& made) { return made.graph.loops; })
      .def_property_readonly("revisits", [](const LogMap& made) { return made.graph.revisits; })
      .def_property_readonly(
          "revisit_error", [](const LogMap& made) { return made.graph.revisit_error; }, "[m]")
      .def_property_readonly("judgement", [](const LogMap& made) { return made.graph.judgement; });
}

}  // namespace

void bind_mapping(py::module_& module) {
  bind_params<ScanMapperParams>(module, "ScanMapperParams", "How scans become cells: see scan_mapper.h.");
  bind_log_map(module);
  module.def(
      "map_log", &map_log, py::arg("log"), py::arg("params") = py::none{}, py::kw_only(), py::arg("way") = 0.15,
      py::arg("turn") = 8.0, py::arg("progress") = py::none{},
      "An occupancy map of a log without any pose, as `docent map` makes it of one laser's scans: poses by a graph "
      "of matched scans, then the map.\n\n"
      "A scan is taken after `way` [m] or `turn` [deg]. Without params all defaults, and as many hits of a wall as "
      "the way between scans bears. progress(stage, done, of) is called now and then.");
}

}  // namespace docent::python
