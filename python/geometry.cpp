#include <pybind11/operators.h>
#include <pybind11/pybind11.h>

#include "arguments.h"
#include "bindings.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::python {
namespace {

void bind_points(py::module_& module) {
  py::class_<Point2>(module, "Point2", "A point x, y [m]; the variable's name says the frame. (x, y) will do for one.")
      .def(py::init([](double x, double y) {
             return Point2{finite(x, "x"), finite(y, "y")};
           }),
           py::arg("x") = 0.0, py::arg("y") = 0.0)
      .def(py::init([](const py::tuple& pair) {
             if (pair.size() != 2) throw py::value_error("a point is (x, y)");
             return Point2{finite(pair[0].cast<double>(), "x"), finite(pair[1].cast<double>(), "y")};
           }),
           py::arg("pair"))
      .def_readonly("x", &Point2::x, "[m]")
      .def_readonly("y", &Point2::y, "[m]")
      .def(py::self == py::self)
      .def("__repr__",
           [](const Point2& point) { return py::str("Point2(x={:.3f}, y={:.3f})").format(point.x, point.y); });
  py::implicitly_convertible<py::tuple, Point2>();
}

void bind_poses(py::module_& module) {
  py::class_<Pose2>(module, "Pose2",
                    "Rigid motion of the plane, x, y [m], theta [rad] counter-clockwise from the x axis.\n\n"
                    "a_from_b * b_from_c is a_from_c: inner names must meet. (x, y, theta) will do for one.")
      .def(py::init([](double x, double y, double theta) {
             return Pose2{finite(x, "x"), finite(y, "y"), Angle::radians(finite(theta, "theta"))};
           }),
           py::arg("x") = 0.0, py::arg("y") = 0.0, py::arg("theta") = 0.0)
      .def(py::init([](const py::tuple& all) {
             if (all.size() != 3) throw py::value_error("a pose is (x, y, theta)");
             return Pose2{finite(all[0].cast<double>(), "x"), finite(all[1].cast<double>(), "y"),
                          Angle::radians(finite(all[2].cast<double>(), "theta"))};
           }),
           py::arg("all"))
      .def_readonly("x", &Pose2::x, "[m]")
      .def_readonly("y", &Pose2::y, "[m]")
      .def_property_readonly(
          "theta", [](const Pose2& pose) { return pose.theta.radians(); }, "[rad], -pi to pi")
      .def("position", &Pose2::position, "x, y [m].")
      .def("__mul__", [](const Pose2& a_from_b, const Pose2& b_from_c) { return a_from_b * b_from_c; })
      .def("__mul__", [](const Pose2& a_from_b, const Point2& in_b) { return a_from_b * in_b; })
      .def("__repr__", [](const Pose2& pose) {
        return py::str("Pose2(x={:.3f}, y={:.3f}, theta={:.4f})").format(pose.x, pose.y, pose.theta.radians());
      });
  py::implicitly_convertible<py::tuple, Pose2>();
  module.def("inverse", &inverse, py::arg("a_from_b"), "b_from_a of a_from_b.");
}

}  // namespace

void bind_geometry(py::module_& module) {
  bind_points(module);
  bind_poses(module);
  py::class_<Time>(module, "Time", "A point in time, nanoseconds: since 1970, or since the start in virtual time.")
      .def(py::init([](std::int64_t nanoseconds) { return Time{nanoseconds}; }), py::arg("nanoseconds") = 0)
      .def_readonly("nanoseconds", &Time::nanoseconds)
      .def(py::self == py::self)
      .def(py::self < py::self)
      .def(py::self <= py::self)
      .def("__hash__", [](const Time& time) { return time.nanoseconds; })
      .def("__repr__", [](const Time& time) { return py::str("Time({})").format(time.nanoseconds); });
  module.def(
      "to_seconds", [](const Time& time) { return to_seconds(time); }, py::arg("time"), "[s]");
  module.def(
      "time_from_seconds", [](double value) { return time_from_seconds(finite(value, "value", 9e9)); },
      py::arg("value"), "Of a number of seconds [s].");
}

}  // namespace docent::python
