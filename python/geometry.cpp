#include <pybind11/operators.h>
#include <pybind11/pybind11.h>

#include <typeinfo>

#include "arguments.h"
#include "bindings.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::python {
namespace {

Point2 point_of(const py::tuple& pair) {
  if (pair.size() != 2) throw py::value_error("a point is (x, y)");
  return {number_of(pair[0], "a point's x"), number_of(pair[1], "a point's y")};
}

Pose2 pose_of(const py::tuple& all) {
  if (all.size() != 3) throw py::value_error("a pose is (x, y, theta)");
  return {number_of(all[0], "a pose's x"), number_of(all[1], "a pose's y"),
          Angle::radians(number_of(all[2], "a pose's theta"))};
}

/// A tuple will do for a T. Other than py::implicitly_convertible this lets the reason pass why one will not.
template <class T, T (*make)(const py::tuple&)>
void take_tuples() {
  const auto convert = [](PyObject* given, PyTypeObject* /*type*/) -> PyObject* {
    if (PyTuple_Check(given) == 0) return nullptr;
    return py::cast(make(py::reinterpret_borrow<py::tuple>(given))).release().ptr();
  };
  py::detail::get_type_info(typeid(T))->implicit_conversions.emplace_back(convert);
}

void bind_points(py::module_& module) {
  py::class_<Point2>(module, "Point2", "A point x, y [m]; the variable's name says the frame. (x, y) will do for one.")
      .def(py::init([](double x, double y) {
             return Point2{finite(x, "x"), finite(y, "y")};
           }),
           py::arg("x") = 0.0, py::arg("y") = 0.0)
      .def(py::init(&point_of), py::arg("pair"))
      .def_readonly("x", &Point2::x, "[m]")
      .def_readonly("y", &Point2::y, "[m]")
      .def(py::self == py::self)
      .def("__eq__",
           [](const Point2& point, const py::tuple& other) { return py::make_tuple(point.x, point.y).equal(other); })
      .def("__repr__",
           [](const Point2& point) { return py::str("Point2(x={:.3f}, y={:.3f})").format(point.x, point.y); });
  take_tuples<Point2, &point_of>();
}

void bind_poses(py::module_& module) {
  py::class_<Pose2>(module, "Pose2",
                    "Rigid motion of the plane, x, y [m], theta [rad] counter-clockwise from the x axis.\n\n"
                    "a_from_b * b_from_c is a_from_c: inner names must meet. (x, y, theta) will do for one.")
      .def(py::init([](double x, double y, double theta) {
             return Pose2{finite(x, "x"), finite(y, "y"), Angle::radians(finite(theta, "theta"))};
           }),
           py::arg("x") = 0.0, py::arg("y") = 0.0, py::arg("theta") = 0.0)
      .def(py::init(&pose_of), py::arg("all"))
      .def_readonly("x", &Pose2::x, "[m]")
      .def_readonly("y", &Pose2::y, "[m]")
      .def_property_readonly(
          "theta", [](const Pose2& pose) { return pose.theta.radians(); }, "[rad], -pi to pi")
      .def("position", &Pose2::position, "x, y [m].")
      .def("__mul__", [](const Pose2& a_from_b, const Pose2& b_from_c) { return a_from_b * b_from_c; })
      .def("__mul__", [](const Pose2& a_from_b, const Point2& in_b) { return a_from_b * in_b; })
      .def("__mul__",
           [](const Pose2& a_from_b, const py::tuple& other) {
             return other.size() == 2 ? py::cast(a_from_b * point_of(other)) : py::cast(a_from_b * pose_of(other));
           })
      .def("__repr__", [](const Pose2& pose) {
        return py::str("Pose2(x={:.3f}, y={:.3f}, theta={:.4f})").format(pose.x, pose.y, pose.theta.radians());
      });
  take_tuples<Pose2, &pose_of>();
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
