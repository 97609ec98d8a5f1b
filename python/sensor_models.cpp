#include <pybind11/pybind11.h>

#include <cmath>
#include <limits>

#include "arguments.h"
#include "bindings.h"
#include "docent/motion_models/odometry_model.h"
#include "docent/sensor_models/proximity_fit.h"
#include "docent/sensor_models/proximity_model.h"
#include "docent/sensor_models/range_sweep.h"
#include "exclusive.h"
#include "params.h"

namespace docent::python {
namespace {

using namespace sensor_models;

constexpr double kLongest = 1e4;  // [m] that any range finder reaches

/// A LaserReading that owns its ranges.
struct OwnedReading {
  std::vector<float> ranges;
  double first_bearing = 0.0, bearing_step = 0.0, min_range = 0.0, max_range = 0.0;
};

OwnedReading reading_of(const py::object& ranges, double first_bearing, double bearing_step, double min_range,
                        double max_range) {
  if (!(min_range >= 0.0)) throw py::value_error("min_range: a number >= 0 is expected");
  return {floats_of(ranges, "ranges"), finite(first_bearing, "first_bearing"), finite(bearing_step, "bearing_step"),
          finite(min_range, "min_range"), positive(max_range, "max_range", kLongest)};
}

void bind_sweeps(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(SweepBeam, bearing, range, no_return);
  py::class_<OwnedReading>(module, "LaserReading", "What one laser read.")
      .def(py::init(&reading_of), py::arg("ranges"), py::arg("first_bearing"), py::arg("bearing_step"),
           py::arg("min_range") = 0.02, py::arg("max_range") = 10.0,
           "ranges: float [n] [m], sensor frame; max_range or more: no return; NaN or less than min_range: invalid. "
           "first_bearing, bearing_step [rad].")
      .def_property_readonly(
          "ranges",
          [](py::object self) {
            const auto& reading = self.cast<const OwnedReading&>();
            return view_of(reading.ranges.data(), {length(reading.ranges.size())}, self);
          },
          "float32 [n] [m]; read-only, not a copy.")
      .def_readonly("first_bearing", &OwnedReading::first_bearing, "[rad]")
      .def_readonly("bearing_step", &OwnedReading::bearing_step, "[rad]")
      .def_readonly("min_range", &OwnedReading::min_range, "[m]")
      .def_readonly("max_range", &OwnedReading::max_range, "[m]");
  py::class_<RangeSweep>(module, "RangeSweep", "All valid beams of one or more lasers about the robot's centre.")
      .def(py::init<>())
      .def(
          "append",
          [](RangeSweep& sweep, const OwnedReading& reading, const Pose2& base_from_sensor) {
            append(sweep,
                   {reading.ranges, Angle::radians(reading.first_bearing), reading.bearing_step, reading.min_range,
                    reading.max_range},
                   base_from_sensor);
          },
          py::arg("reading"), py::arg("base_from_sensor") = Pose2{},
          "Adds the valid beams of a reading; base_from_sensor: the sensor's place on the robot.")
      .def_property_readonly(
          "beams",
          [](const RangeSweep& sweep) {
            std::vector<SweepBeam> beams = sweep.beams;
            return owned_by_array(std::move(beams), {length(sweep.beams.size())});
          },
          "A copy, [n] with the fields bearing [rad] (base), range [m] from the robot's centre, no_return.")
      .def("__len__", [](const RangeSweep& sweep) { return sweep.beams.size(); });
  module.def("seen_from", &seen_from, py::arg("sweep"), py::arg("there_from_here"),
             "The sweep as if measured from another place nearby.");
}

/// Adds pairs of ranges; whatever cannot be a reading is passed over.
std::size_t add_readings(ReadingCounts& counts, const py::object& measured, const py::object& expected) {
  const std::vector<double> ranges = doubles_of(measured, "measured");
  const std::vector<double> expectations = doubles_of(expected, "expected");
  if (ranges.size() != expectations.size()) throw py::value_error("measured, expected: of one length both");
  const RangeBins& bins = counts.bins();
  std::size_t added = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (!(ranges[i] >= 0.0 && expectations[i] >= 0.0)) continue;
    counts.add(bins.bin(std::min(ranges[i], bins.max_range())), bins.bin(std::min(expectations[i], bins.max_range())));
    ++added;
  }
  return added;
}

/// Of ProximityFitParams those that readings may ask for.
ProximityFit fit(ReadingCounts counts, ProximityModelParams start, double least_readings, int most_rounds) {
  check_params(start);
  if (start.max_range != counts.bins().max_range())
    throw py::value_error("start: its max_range is not that of the counts");
  if (most_rounds < 1) throw py::value_error("most_rounds: must be >= 1");
  ProximityFitParams options;
  options.least_readings = finite(least_readings, "least_readings", 1e12);
  options.most_rounds = most_rounds;
  return value_or_raise(without_interpreter([&] { return fit_proximity_model(counts, start, options); }));
}

void bind_fit(py::module_& module) {
  py::class_<ReadingCounts>(module, "ReadingCounts", "How often each range was measured where each was expected.")
      .def(py::init([](double max_range) { return ReadingCounts{positive(max_range, "max_range", kLongest)}; }),
           py::arg("max_range"), "max_range [m]: from here on nothing came back.")
      .def("add", &add_readings, py::arg("measured"), py::arg("expected"),
           "float [n] [m] both; infinity: no return. Pairs with a NaN, or a range < 0, are passed over. Returns how "
           "many "
           "were added.")
      .def("total", &ReadingCounts::total);
  py::class_<ProximityFit>(module, "ProximityFit", "What readings have taught of a sensor.")
      .def_readonly("params", &ProximityFit::params, "Its weights sum to 1.")
      .def_readonly("readings", &ProximityFit::readings)
      .def_readonly("before", &ProximityFit::before, "[nat] mean ln P of a reading by the start's parameters")
      .def_readonly("after", &ProximityFit::after, "[nat] by the learned ones")
      .def_property_readonly(
          "history",
          [](py::object self) {
            const auto& result = self.cast<const ProximityFit&>();
            return view_of(result.history.data(), {length(result.history.size())}, self);
          },
          "float64 [rounds] [nat]; never falls.");
  module.def("fit_proximity_model", &fit, py::arg("counts"), py::arg("start"), py::kw_only(),
             py::arg("least_readings") = ProximityFitParams{}.least_readings,
             py::arg("most_rounds") = ProximityFitParams{}.most_rounds,
             "Maximum likelihood fit of the mixture. Error: fewer readings than least_readings.");
  module.def(
      "mean_log_likelihood",
      [](const ReadingCounts& counts, const ProximityModelParams& params) {
        check_params(params);
        if (params.max_range != counts.bins().max_range())
          throw py::value_error("params: its max_range is not that of the counts");
        return mean_log_likelihood(counts, params);
      },
      py::arg("counts"), py::arg("params"), "Mean ln P(measured | expected) of a reading [nat].");
}

int checked_bin(int bin, int count, const char* name) {
  if (bin < 0 || bin >= count)
    throw py::index_error(std::string{name} + ": 0.." + std::to_string(count - 1) + " is expected");
  return bin;
}

py::array probabilities(const ProximityModel& model) {
  std::vector<double> table;
  for (int measured = 0; measured < kRangeBins; ++measured)
    for (int expected = 0; expected < kExpectedRanges; ++expected)
      table.push_back(model.probability(measured, expected));
  return owned_by_array(std::move(table), {kRangeBins, kExpectedRanges});
}

void bind_model(py::module_& module) {
  module.attr("kRangeBins") = kRangeBins;
  module.attr("kNoReturn") = kNoReturn;
  module.attr("kUnknownRange") = kUnknownRange;
  module.attr("kExpectedRanges") = kExpectedRanges;
  py::class_<ProximityModel>(module, "ProximityModel", "P(measured | expected) of a range finder, over bins of range.")
      .def(py::init([](const ProximityModelParams& params) {
             check_params(params);
             return ProximityModel{params};
           }),
           py::arg("params") = ProximityModelParams{})
      .def(
          "bin",
          [](const ProximityModel& model, double range) {
            if (!(range >= 0.0)) throw py::value_error("range: a number >= 0 is expected");
            return model.bin(std::min(range, kLongest));
          },
          py::arg("range"), "Of a range [m].")
      .def(
          "lower_edge",
          [](const ProximityModel& model, int bin) {
            return model.lower_edge(checked_bin(bin, kRangeBins + 1, "bin"));
          },
          py::arg("bin"), "[m]")
      .def(
          "centre",
          [](const ProximityModel& model, int bin) { return model.centre(checked_bin(bin, kRangeBins, "bin")); },
          py::arg("bin"), "[m]; of kNoReturn: max_range")
      .def(
          "probability",
          [](const ProximityModel& model, int measured, int expected) {
            return model.probability(checked_bin(measured, kRangeBins, "measured"),
                                     checked_bin(expected, kExpectedRanges, "expected"));
          },
          py::arg("measured"), py::arg("expected"), "Of one bin, where another is expected (or kUnknownRange).")
      .def("probabilities", &probabilities,
           "float64 [kRangeBins, kExpectedRanges], new: of each measured bin (row) for each expected one (column).");
}

}  // namespace

void bind_sensor_models(py::module_& module) {
  bind_params<ProximityModelParams>(module, "ProximityModelParams", "How a range finder errs: see proximity_parts.h.");
  bind_params<motion_models::OdometryModelParams>(module, "OdometryModelParams",
                                                  "How much wheel odometry errs: see odometry_model.h.");
  bind_sweeps(module);
  bind_fit(module);
  bind_model(module);
}

}  // namespace docent::python
