#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <system_error>

#include "arguments.h"
#include "bindings.h"
#include "docent/localization/markov/markov_localizer.h"
#include "docent/localization/monte_carlo/monte_carlo_localizer.h"
#include "exclusive.h"
#include "params.h"

namespace docent::python {
namespace {

using namespace localization;

using AnyLocalizer = Exclusive<Localizer>;
struct GridLocalizer : AnyLocalizer {
  using AnyLocalizer::AnyLocalizer;
};
struct ParticleLocalizer : AnyLocalizer {
  using AnyLocalizer::AnyLocalizer;
};

/// What the constructors promise each other. A belief needs a place to stand.
FloorMap checked_floor(const OccupancyGrid& map, const LocalizerParams& params, const py::iterable& closed,
                       const std::filesystem::path& cache) {
  check_params(params);
  constexpr double kMostStates = 1e9;  // 4 GB
  const double cells =
      std::pow(map.frame.resolution / params.states.cell_size, 2) * static_cast<double>(map.cells.size());
  if (cells * 360.0 / params.states.heading_step > kMostStates)
    throw py::value_error("params.states: more than 1e9 states; coarser cells are needed");
  if (std::error_code unknown; !cache.empty() && !std::filesystem::is_directory(cache, unknown))
    throw py::value_error("cache: '" + path_text(cache) + "' is no folder");
  const std::vector<Polygon> polygons = polygons_of(closed, "closed");
  return without_interpreter([&] {
    FloorMap floor{map, polygons};
    const StateSpace space{floor.standing, sensor_models::RayCaster{floor.standing}, params.states};
    if (space.places() == 0) throw Failed{"the map has no free place where the robot could be"};
    return floor;
  });
}

// Parameters and sweeps come as copies: other threads of Python may change theirs while C++ works.
std::unique_ptr<GridLocalizer> grid_localizer(const OccupancyGrid& map, LocalizerParams params,
                                              const py::iterable& closed, const std::filesystem::path& cache,
                                              std::uint64_t seed) {
  const FloorMap floor = checked_floor(map, params, closed, cache);
  return without_interpreter([&] {
    return std::make_unique<GridLocalizer>(
        std::make_unique<MarkovLocalizer>(floor, params, RangeTableCache{cache}, seed));
  });
}

std::unique_ptr<ParticleLocalizer> particle_localizer(const OccupancyGrid& map, LocalizerParams shared,
                                                      MonteCarloParams params, const py::iterable& closed,
                                                      const std::filesystem::path& cache, std::uint64_t seed) {
  const FloorMap floor = checked_floor(map, shared, closed, cache);
  check_params(params);
  return without_interpreter([&] {
    return std::make_unique<ParticleLocalizer>(
        std::make_unique<MonteCarloLocalizer>(floor, shared, params, RangeTableCache{cache}, seed));
  });
}

BeliefMode mode_of(const Pose2& map_from_robot, const py::object& covariance, double mass) {
  BeliefMode mode{map_from_robot, {}, mass};
  if (!(mass > 0.0 && mass <= 1.0)) throw py::value_error("mass: a number in (0, 1] is expected");
  const std::vector<double> rows = rows_of(covariance, "covariance", 3);
  if (rows.size() != 9) throw py::value_error("covariance: the shape (3, 3) is expected");
  std::copy(rows.begin(), rows.end(), mode.covariance.begin());
  const auto& c = mode.covariance;
  const double minor = c[0] * c[4] - c[1] * c[3];
  const double all =
      c[0] * (c[4] * c[8] - c[5] * c[7]) - c[1] * (c[3] * c[8] - c[5] * c[6]) + c[2] * (c[3] * c[7] - c[4] * c[6]);
  const double skew = std::abs(c[1] - c[3]) + std::abs(c[2] - c[6]) + std::abs(c[5] - c[7]);
  if (!(skew < 1e-9 && c[0] > 0.0 && minor > 0.0 && all > 0.0))
    throw py::value_error("covariance: it must be symmetric and positive definite");
  return mode;
}

void bind_modes(py::module_& module) {
  py::class_<BeliefMode>(module, "BeliefMode", "A Gaussian part of a belief.")
      .def(py::init(&mode_of), py::arg("map_from_robot"), py::arg("covariance"), py::arg("mass") = 1.0)
      .def_readonly("map_from_robot", &BeliefMode::map_from_robot)
      .def_property_readonly(
          "covariance",
          [](py::object self) {
            return view_of(self.cast<const BeliefMode&>().covariance.data(), {3, 3}, self);
          },
          "float64 [3, 3] of x, y [m], theta [rad]; read-only, not a copy.")
      .def_readonly("mass", &BeliefMode::mass)
      .def("__repr__", [](const BeliefMode& mode) {
        return py::str("BeliefMode({!r}, mass={:.3f})").format(mode.map_from_robot, mode.mass);
      });
}

void bind_summary(py::module_& module) {
  using Cell = BeliefSummary::Cell;
  PYBIND11_NUMPY_DTYPE(Cell, x, y, theta, mass);
  py::class_<BeliefSummary>(module, "BeliefSummary", "The belief in few numbers, as of the last update.")
      .def_property_readonly(
          "cells",
          [](py::object self) {
            const auto& cells = self.cast<const BeliefSummary&>().cells;
            return view_of(cells.data(), {length(cells.size())}, self);
          },
          "[n] with the fields x, y [m], theta [rad] (map), mass: the likeliest states, by falling mass. Read-only.")
      .def_readonly("rest_origin", &BeliefSummary::rest_origin, "[m], map: lower left corner of `rest`")
      .def_readonly("rest_cell_size", &BeliefSummary::rest_cell_size, "[m]")
      .def_property_readonly(
          "rest",
          [](py::object self) {
            const auto& summary = self.cast<const BeliefSummary&>();
            return view_of(summary.rest.data(), {summary.rest_rows, summary.rest_columns}, self);
          },
          "float32 [rows, columns]: the other mass, all headings together. Read-only.")
      .def_readonly("modes", &BeliefSummary::modes, "By falling mass, at most eight.")
      .def_readonly("entropy", &BeliefSummary::entropy, "[nat]")
      .def_readonly("active_mass", &BeliefSummary::active_mass)
      .def_readonly("active_states", &BeliefSummary::active_states);
  py::class_<PositionDensity>(module, "PositionDensity", "The belief over positions, all headings together.")
      .def_readonly("frame", &PositionDensity::frame)
      .def_property_readonly(
          "mass",
          [](py::object self) {
            const auto& density = self.cast<const PositionDensity&>();
            return view_of(density.mass.data(), {density.frame.rows, density.frame.columns}, self);
          },
          "float32 [rows, columns], sum 1; read-only, not a copy.");
}

void bind_verdict(py::module_& module) {
  py::class_<Doubt>(module, "Doubt", "What P(lost) is made of: see verdict.h.")
      .def_readonly("mass", &Doubt::mass)
      .def_readonly("share", &Doubt::share)
      .def_readonly("confirmation", &Doubt::confirmation)
      .def_readonly("agreement", &Doubt::agreement)
      .def_readonly("contradiction", &Doubt::contradiction)
      .def_readonly("surprise", &Doubt::surprise)
      .def_readonly("hidden", &Doubt::hidden)
      .def_readonly("unmapped", &Doubt::unmapped)
      .def_readonly("spread", &Doubt::spread, "[m]");
  py::class_<Verdict>(module, "Verdict", "Whether the robot may say where it is, as of the last scan.")
      .def("localized", &Verdict::localized, "The robot says: here.")
      .def("keeps_its_place", &Verdict::keeps_its_place)
      .def("p_lost", py::overload_cast<>(&Verdict::p_lost, py::const_), "P(the best hypothesis is wrong), 0..1.")
      .def("contradicted", &Verdict::contradicted)
      .def("startled", &Verdict::startled)
      .def("doubt", &Verdict::doubt);
}

void bind_localizer(py::module_& module) {
  py::class_<Localizer::Step>(module, "Step", "What a sweep did to the belief.")
      .def_readonly("updated", &Localizer::Step::updated)
      .def_readonly("beams_used", &Localizer::Step::beams_used)
      .def_readonly("beams_filtered", &Localizer::Step::beams_filtered)
      .def_readonly("weight", &Localizer::Step::weight, "0..1 of a full update")
      .def_readonly("fit", &Localizer::Step::fit, "[nat] mean ln P of the beams used at the best mode, or None.");
  py::class_<AnyLocalizer>(module, "Localizer",
                           "A belief over the robot's pose in a map, kept up by sweeps and odometry.")
      .def("start_unknown", [](AnyLocalizer& self) { self.use([](Localizer& l) { l.start_unknown(); }); })
      .def(
          "start_at",
          [](AnyLocalizer& self, const std::vector<BeliefMode>& modes, const Pose2& odom, const Time& time) {
            if (modes.empty()) throw py::value_error("modes: one at least is expected");
            self.use([&](Localizer& l) { l.start_at(modes, odom, time); });
          },
          py::arg("modes"), py::arg("odom_from_robot"), py::arg("time"),
          "odom_from_robot: where odometry saw the robot when it was as `modes` say.")
      .def(
          "observe",
          [](AnyLocalizer& self, sensor_models::RangeSweep sweep, const Pose2& odom, const Time& time) {
            return self.use([&](Localizer& l) { return l.observe(sweep, odom, time); });
          },
          py::arg("sweep"), py::arg("odom_from_robot"), py::arg("time"),
          "Offers a sweep about the robot's centre; an update comes after some motion or time.")
      .def("summary", [](AnyLocalizer& self) { return self.use([](Localizer& l) { return l.summary(); }); })
      .def("verdict", [](AnyLocalizer& self) { return self.use([](Localizer& l) { return l.verdict(); }); })
      .def("density", [](AnyLocalizer& self) { return self.use([](Localizer& l) { return l.density(); }); })
      .def(
          "map_from_robot",
          [](AnyLocalizer& self, const Pose2& odom) {
            return self.use([&](Localizer& l) { return l.map_from_robot(odom); });
          },
          py::arg("odom_now"), "The best mode's mean, carried on by odometry; None without a mode.")
      .def(
          "entropy_gains",
          [](AnyLocalizer& self, sensor_models::RangeSweep sweep, const Pose2& odom) {
            std::vector<float> gains = self.use([&](Localizer& l) { return l.entropy_gains(sweep, odom); });
            const py::ssize_t count = length(gains.size());
            return owned_by_array(std::move(gains), {count});
          },
          py::arg("sweep"), py::arg("odom_now"),
          "float32 [beams] [nat]: above 0 a beam would make the robot less sure; [0] while the belief is too wide.");
}

py::array of_particles(py::object self, std::vector<float> ParticleSet::*member) {
  const auto& set = self.cast<const ParticleSet&>();
  return view_of((set.*member).data(), {length(set.size())}, self);
}

void bind_particles(py::module_& module) {
  py::class_<ParticleSet> set{module, "ParticleSet", "Weighted samples of the pose; arrays float32 [n], read-only."};
  const auto add = [&](const char* name, std::vector<float> ParticleSet::*member, const char* what) {
    set.def_property_readonly(
        name, [member](py::object self) { return of_particles(std::move(self), member); }, what);
  };
  add("x", &ParticleSet::x, "[m], map");
  add("y", &ParticleSet::y, "[m], map");
  add("heading_x", &ParticleSet::heading_x, "cosine of the heading");
  add("heading_y", &ParticleSet::heading_y, "sine of the heading");
  add("weight", &ParticleSet::weight, ">= 0");
  set.def("size", &ParticleSet::size);
  set.def("__len__", &ParticleSet::size);
}

void bind_both(py::module_& module) {
  py::class_<GridLocalizer, AnyLocalizer>(module, "MarkovLocalizer", "Grid-based Markov localization.")
      .def(py::init(&grid_localizer), py::arg("map"), py::arg("params") = LocalizerParams{}, py::kw_only(),
           py::arg("closed") = py::tuple{}, py::arg("cache") = "", py::arg("seed") = 1,
           "closed: polygons [n, 2] [m], map, where no robot can stand. cache: a folder for tables of expected ranges; "
           "empty: none.");
  bind_particles(module);
  py::class_<ParticleLocalizer, AnyLocalizer>(module, "MonteCarloLocalizer", "Monte Carlo localization.")
      .def(py::init(&particle_localizer), py::arg("map"), py::arg("shared") = LocalizerParams{},
           py::arg("params") = MonteCarloParams{}, py::kw_only(), py::arg("closed") = py::tuple{},
           py::arg("cache") = "", py::arg("seed") = 1, "shared: as for the grid; closed, cache: likewise.")
      .def(
          "particles",
          [](ParticleLocalizer& self) {
            return self.use([](Localizer& l) { return static_cast<const MonteCarloLocalizer&>(l).particles(); });
          },
          "A copy of all particles as of now.");
}

}  // namespace

void bind_localization(py::module_& module) {
  bind_params<StateSpaceParams>(module, "StateSpaceParams", "The cells of the belief: see state_space.h.");
  bind_params<VerdictParams>(module, "VerdictParams", "When the robot says here: see verdict.h.");
  bind_params<PoseRefinerParams>(module, "PoseRefinerParams", "Finer than cells: see pose_refiner.h.");
  bind_params<TracksParams>(module, "TracksParams", "How places are told apart by the way: see tracks.h.");
  bind_params<LocalizerParams>(module, "LocalizerParams", "What grid and particles share: see localizer_params.h.");
  bind_params<KldParams>(module, "KldParams", "How many particles: see resampling.h.");
  bind_params<LikelihoodFieldParams>(module, "LikelihoodFieldParams", "See likelihood_field.h.");
  bind_params<MonteCarloParams>(module, "MonteCarloParams", "Of particles alone: see particle_belief.h.");
  bind_modes(module);
  bind_summary(module);
  bind_verdict(module);
  bind_localizer(module);
  bind_both(module);
}

}  // namespace docent::python
