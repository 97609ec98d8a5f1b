#include "arguments.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace docent::python {
namespace {

[[noreturn]] void refuse(const char* name, const std::string& why) {
  throw py::value_error(std::string{name} + ": " + why);
}

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  return text + ")";
}

/// An array in the machine's order of bytes, without gaps, of the kind and with so many dimensions.
py::array checked(const py::object& given, const char* name, char kind, py::ssize_t dimensions, bool lists_too) {
  if (!py::isinstance<py::array>(given) && !lists_too) {
    throw py::type_error(std::string{name} + ": a numpy array is expected, not " + type_name(given));
  }
  const py::array array = py::isinstance<py::array>(given)
                              ? py::reinterpret_borrow<py::array>(given)
                              : py::array{py::module_::import("numpy").attr("asarray")(given, "float64")};
  const py::dtype type = array.dtype();
  const bool is_known = kind != 'f' || type.itemsize() == 4 || type.itemsize() == 8;
  if (type.kind() != kind || !is_known || (kind == 'i' && type.itemsize() != 1) ||
      !type.attr("isnative").cast<bool>()) {
    const char* const wanted = kind == 'f' ? "float32 or float64" : kind == 'b' ? "bool" : "int8";
    throw py::type_error(std::string{name} + ": dtype " + wanted + " is expected, not " +
                         py::str(py::handle{type}).cast<std::string>());
  }
  if (array.ndim() != dimensions)
    refuse(name, std::to_string(dimensions) + " dimensions are expected, not the shape " + shape_text(array));
  if ((array.flags() & py::array::c_style) == 0)
    refuse(name, "the array is not contiguous; numpy.ascontiguousarray makes one that is");
  return array;
}

/// Numbers may lie anywhere: numpy.frombuffer makes arrays that are not aligned.
template <class From, class To>
std::vector<To> copied(const py::array& array) {
  std::vector<To> numbers(static_cast<std::size_t>(array.size()));
  const auto* const from = static_cast<const std::byte*>(array.data());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    From number{};
    std::memcpy(&number, from + i * sizeof number, sizeof number);
    numbers[i] = static_cast<To>(number);
  }
  return numbers;
}

template <class To>
std::vector<To> numbers_of(const py::array& array) {
  return array.itemsize() == 4 ? copied<float, To>(array) : copied<double, To>(array);
}

void check_shape(const py::array& array, const char* name, py::ssize_t rows, py::ssize_t columns) {
  if (array.shape(0) != rows || array.shape(1) != columns) {
    refuse(name, "the shape (" + std::to_string(rows) + ", " + std::to_string(columns) + ") is expected, not " +
                     shape_text(array));
  }
}

}  // namespace

std::string type_name(py::handle given) { return py::type::of(given).attr("__name__").cast<std::string>(); }

double number_of(py::handle given, const char* name) {
  py::detail::make_caster<double> number;
  if (!number.load(given, true))
    throw py::type_error(std::string{name} + ": a number is expected, not " + type_name(given));
  return finite(py::detail::cast_op<double>(number), name);
}

double finite(double value, const char* name, double most) {
  const auto text = [](double number) { return py::repr(py::float_{number}).cast<std::string>(); };
  if (!std::isfinite(value)) refuse(name, "a finite number is expected, not " + text(value));
  if (std::abs(value) > most)
    refuse(name, "a number from " + text(-most) + " to " + text(most) + " is expected, not " + text(value));
  return value;
}

double positive(double value, const char* name, double most) {
  if (!(value > 0.0)) refuse(name, "a number > 0 is expected");
  return finite(value, name, most);
}

std::vector<float> floats_of(const py::object& given, const char* name) {
  return numbers_of<float>(checked(given, name, 'f', 1, false));
}

std::vector<double> doubles_of(const py::object& given, const char* name) {
  return numbers_of<double>(checked(given, name, 'f', 1, false));
}

std::vector<double> rows_of(const py::object& given, const char* name, py::ssize_t columns) {
  const py::array array = checked(given, name, 'f', 2, true);
  if (array.shape(1) != columns)
    refuse(name, "the shape (n, " + std::to_string(columns) + ") is expected, not " + shape_text(array));
  std::vector<double> numbers = numbers_of<double>(array);
  for (const double number : numbers) finite(number, name);
  return numbers;
}

std::vector<bool> bools_of(const py::object& given, const char* name, py::ssize_t rows, py::ssize_t columns) {
  const py::array array = checked(given, name, 'b', 2, false);
  check_shape(array, name, rows, columns);
  const auto* const from = static_cast<const std::uint8_t*>(array.data());
  return std::vector<bool>(from, from + array.size());
}

py::array int8_of(const py::object& given, const char* name) { return checked(given, name, 'i', 2, false); }

std::vector<float> float_grid_of(const py::object& given, const char* name, py::ssize_t rows, py::ssize_t columns) {
  const py::array array = checked(given, name, 'f', 2, false);
  check_shape(array, name, rows, columns);
  return numbers_of<float>(array);
}

std::vector<Point2> points_of(const py::object& given, const char* name) {
  const std::vector<double> numbers = rows_of(given, name, 2);
  std::vector<Point2> points;
  for (std::size_t i = 0; i < numbers.size(); i += 2) points.push_back({numbers[i], numbers[i + 1]});
  return points;
}

Polygon polygon_of(const py::object& given, const char* name, bool may_be_empty) {
  if (may_be_empty && py::len(given) == 0) return {};
  Polygon polygon = points_of(given, name);
  if (polygon.size() < 3) refuse(name, "a polygon has three corners at least");
  return polygon;
}

std::vector<Polygon> polygons_of(const py::iterable& given, const char* name) {
  std::vector<Polygon> polygons;
  for (const py::handle polygon : given)
    polygons.push_back(polygon_of(py::reinterpret_borrow<py::object>(polygon), name, false));
  return polygons;
}

py::str text_of(std::string_view raw) {
  PyObject* const text = PyUnicode_DecodeUTF8(raw.data(), length(raw.size()), "replace");
  if (text == nullptr) throw py::error_already_set{};
  return py::reinterpret_steal<py::str>(text);
}

py::list texts_of(const std::vector<std::string>& raw) {
  py::list texts;
  for (const std::string& one : raw) texts.append(text_of(one));
  return texts;
}

std::string path_text(const std::filesystem::path& path) {
  return text_of(std::string_view{path.native()}).cast<std::string>();
}

py::array_t<double> array_of(std::span<const Point2> points) {
  py::array_t<double> array{{length(points.size()), py::ssize_t{2}}};
  double* to = array.mutable_data();
  for (const Point2& point : points) {
    *to++ = point.x;
    *to++ = point.y;
  }
  return array;
}

py::array_t<double> array_of(std::span<const Pose2> poses) {
  py::array_t<double> array{{length(poses.size()), py::ssize_t{3}}};
  double* to = array.mutable_data();
  for (const Pose2& pose : poses) {
    *to++ = pose.x;
    *to++ = pose.y;
    *to++ = pose.theta.radians();
  }
  return array;
}

}  // namespace docent::python
