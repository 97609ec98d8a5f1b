#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <exception>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"

// What goes in and out: arrays are checked here, so that whatever a caller gives ends in an exception and never in what
// C++ only promises for valid arguments.

namespace docent::python {

namespace py = pybind11;

/// Becomes docent.Error.
class Failed : public std::exception {
 public:
  explicit Failed(std::string message) : message_{std::move(message)} {}
  [[nodiscard]] const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

inline void value_or_raise(Result<void> result) {
  if (!result) throw Failed{result.error().message};
}
template <class T>
[[nodiscard]] T value_or_raise(Result<T>&& result) {
  if (!result) throw Failed{result.error().message};
  return std::move(*result);
}
/// What validate() says of parameters.
template <class P>
void check_params(const P& params) {
  if (auto valid = params.validate(); !valid) throw py::value_error(valid.error().message);
}

/// Of an object, for a person: "float", "ndarray".
std::string type_name(py::handle given);
/// The number that an object is, if it is finite and at most 1e6 from 0; else TypeError or ValueError names it.
double number_of(py::handle given, const char* name);
/// The number, if it is finite and no farther from 0 than `most`; else ValueError names it.
double finite(double value, const char* name, double most = 1e6);
double positive(double value, const char* name, double most = 1e6);

/// A float32 or float64 array of one dimension. NaN and infinity may be in it: ranges have both.
std::vector<float> floats_of(const py::object& given, const char* name);
std::vector<double> doubles_of(const py::object& given, const char* name);
/// A float32 or float64 array [n, columns] of finite numbers, row by row. Lists of lists will do.
std::vector<double> rows_of(const py::object& given, const char* name, py::ssize_t columns);
/// A bool array [rows, columns].
std::vector<bool> bools_of(const py::object& given, const char* name, py::ssize_t rows, py::ssize_t columns);
/// An int8 array of two dimensions.
py::array int8_of(const py::object& given, const char* name);
/// A float32 array [rows, columns].
std::vector<float> float_grid_of(const py::object& given, const char* name, py::ssize_t rows, py::ssize_t columns);

/// [n, 2] points [m]; a polygon has three at least, or none where `may_be_empty`.
std::vector<Point2> points_of(const py::object& given, const char* name);
Polygon polygon_of(const py::object& given, const char* name, bool may_be_empty);
std::vector<Polygon> polygons_of(const py::iterable& given, const char* name);

/// What a file or the system holds as text, which need not be UTF-8: U+FFFD stands for what is not.
py::str text_of(std::string_view raw);
py::list texts_of(const std::vector<std::string>& raw);
std::string path_text(const std::filesystem::path& path);
/// A dictionary; of texts that look alike in the end the first one holds.
template <class T>
[[nodiscard]] py::dict texts_of(const std::map<std::string, T>& raw) {
  py::dict texts;
  for (const auto& [key, value] : raw) {
    if constexpr (std::is_same_v<T, std::string>) {
      texts.attr("setdefault")(text_of(key), text_of(value));
    } else {
      texts.attr("setdefault")(text_of(key), value);
    }
  }
  return texts;
}

/// [n, 2], [n, 3] and [3, 3], new.
py::array_t<double> array_of(std::span<const Point2> points);
py::array_t<double> array_of(std::span<const Pose2> poses);

/// An array over what `base` owns: not a copy, read-only, and `base` lives as long as it does.
template <class T>
[[nodiscard]] py::array view_of(const T* data, std::vector<py::ssize_t> shape, py::handle base) {
  py::array view{py::dtype::of<T>(), std::move(shape), data, base};
  view.attr("flags").attr("writeable") = false;
  return view;
}
/// An array that takes over the values, without a copy.
template <class T>
[[nodiscard]] py::array owned_by_array(std::vector<T>&& values, std::vector<py::ssize_t> shape) {
  auto* const kept = new std::vector<T>{std::move(values)};
  const py::capsule owner{kept, [](void* all) { delete static_cast<std::vector<T>*>(all); }};
  return py::array{py::dtype::of<T>(), std::move(shape), kept->data(), owner};
}
[[nodiscard]] inline py::ssize_t length(std::size_t size) { return static_cast<py::ssize_t>(size); }

}  // namespace docent::python
