#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arguments.h"
#include "bindings.h"
#include "docent/recording/carmen_log.h"
#include "docent/recording/laser_log.h"
#include "docent/sensor_models/range_sweep.h"
#include "exclusive.h"

namespace docent::python {
namespace {

using namespace recording;

/// The parts of a log as Python holds them: each keeps the whole alive.
template <class T>
py::list parts_of(const std::shared_ptr<LaserLog>& log, std::vector<T> LaserLog::*member) {
  py::list all;
  for (T& part : (*log).*member) all.append(std::shared_ptr<T>{log, &part});
  return all;
}

void bind_scan(py::module_& module) {
  py::class_<LoggedScan, std::shared_ptr<LoggedScan>>(module, "LoggedScan",
                                                      "One sweep of a laser scanner with the odometry of its moment.")
      .def_readonly("time", &LoggedScan::time)
      .def_readonly("rear", &LoggedScan::rear)
      .def_property_readonly(
          "first_bearing", [](const LoggedScan& scan) { return scan.first_bearing.radians(); },
          "[rad] of ranges[0], in the laser's frame")
      .def_readonly("bearing_step", &LoggedScan::bearing_step, "[rad]")
      .def_property_readonly(
          "ranges",
          [](py::object self) {
            const auto& scan = self.cast<const LoggedScan&>();
            return view_of(scan.ranges.data(), {length(scan.ranges.size())}, self);
          },
          "float32 [n] [m]; infinity: no return; NaN: an invalid reading. Read-only, not a copy.")
      .def_readonly("odom_from_base", &LoggedScan::odom_from_base, "Raw odometry at the moment of the scan.")
      .def_readonly("base_from_laser", &LoggedScan::base_from_laser, "The laser's place on the robot.")
      .def_readonly("logged_pose", &LoggedScan::logged_pose, "The other pose that CARMEN writes beside odometry.")
      .def_readonly("line", &LoggedScan::line, "Where in the file; 0 for recordings without lines.");
}

void bind_odometry(py::module_& module) {
  py::class_<LoggedOdometry, std::shared_ptr<LoggedOdometry>>(module, "LoggedOdometry", "One reading of odometry.")
      .def_readonly("time", &LoggedOdometry::time)
      .def_readonly("odom_from_base", &LoggedOdometry::odom_from_base)
      .def_readonly("linear", &LoggedOdometry::linear, "[m/s], as logged")
      .def_readonly("angular", &LoggedOdometry::angular, "[rad/s]");
  py::class_<LoggedPing, std::shared_ptr<LoggedPing>>(module, "LoggedPing", "One reading of one sonar.")
      .def_readonly("time", &LoggedPing::time)
      .def_readonly("sonar", &LoggedPing::sonar, "Index in base_from_sonar.")
      .def_readonly("range", &LoggedPing::range, "[m]; infinity: no return")
      .def_readonly("odom_from_base", &LoggedPing::odom_from_base);
}

void bind_log(py::module_& module) {
  py::class_<LaserLog, std::shared_ptr<LaserLog>>(module, "LaserLog",
                                                  "What localization and mapping need of a recording.")
      .def_property_readonly(
          "scans", [](const std::shared_ptr<LaserLog>& log) { return parts_of(log, &LaserLog::scans); },
          "A new list of LoggedScan, in the order of the recording; times never fall.")
      .def_property_readonly(
          "odometry", [](const std::shared_ptr<LaserLog>& log) { return parts_of(log, &LaserLog::odometry); },
          "A new list of LoggedOdometry: every reading.")
      .def_property_readonly(
          "pings", [](const std::shared_ptr<LaserLog>& log) { return parts_of(log, &LaserLog::pings); },
          "A new list of LoggedPing, where sonars were asked for.")
      .def_property_readonly(
          "base_from_sonar", [](const LaserLog& log) { return array_of(log.base_from_sonar); },
          "float64 [sonars, 3]: x, y [m], theta [rad].")
      .def_readonly("sonar_max_range", &LaserLog::sonar_max_range, "[m]")
      .def_property_readonly("parameters", [](const LaserLog& log) { return texts_of(log.parameters); })
      .def_readonly("max_range", &LaserLog::max_range, "[m]: from here on a reading means no return")
      .def_readonly("times_are_invented", &LaserLog::times_are_invented)
      .def_readonly("sources", &LaserLog::sources, "Which topics of a ROS recording it was made of, in words.")
      .def_property_readonly(
          "notes", [](const LaserLog& log) { return texts_of(log.notes); },
          "What had to be assumed or left out, in words.")
      .def("__len__", [](const LaserLog& log) { return log.scans.size(); });
}

}  // namespace

void bind_logs(py::module_& module) {
  bind_scan(module);
  bind_odometry(module);
  bind_log(module);
  const auto shared = [](Result<LaserLog>&& log) { return std::make_shared<LaserLog>(value_or_raise(std::move(log))); };
  module.def(
      "read_laser_log",
      [shared](const std::filesystem::path& path, bool with_sonars, std::vector<std::string> scans,
               std::string odometry, std::string robot) {
        const LaserLogOptions options{with_sonars, {std::move(scans), std::move(odometry), std::move(robot)}};
        return shared(without_interpreter([&] { return read_laser_log(path, options); }));
      },
      py::arg("path"), py::arg("with_sonars") = false, py::arg("scans") = std::vector<std::string>{},
      py::arg("odometry") = "", py::arg("robot") = "",
      "Reads, by its content, a CARMEN text log (plain or gzip), an MCAP recording, a rosbag2 folder or its "
      "database, or a bag of ROS 1.\n\n"
      "Of a recording of ROS the topics of `scans`, that of `odometry` or the name space of a `robot`; what is not "
      "said is "
      "chosen, see `sources` and `notes`.\n\n"
      "Error: names the file, and the line where there are lines.");
  module.def(
      "read_carmen_log",
      [shared](const std::filesystem::path& path) {
        return shared(without_interpreter([&] { return read_carmen_log(path); }));
      },
      py::arg("path"), "Reads a CARMEN text log, plain or gzip.");
  module.def(
      "sweep_of",
      [](const LoggedScan& scan, double max_range) {
        sensor_models::RangeSweep sweep;
        sensor_models::append(
            sweep, {scan.ranges, scan.first_bearing, scan.bearing_step, 0.02, positive(max_range, "max_range", 1e4)},
            {});
        return sweep;
      },
      py::arg("scan"), py::arg("max_range"),
      "The valid beams of a scan in its laser's frame; seen_from(sweep, scan.base_from_laser) are those of the robot.");
}

}  // namespace docent::python
