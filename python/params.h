#pragma once

#include <pybind11/pybind11.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>

namespace docent::python {

/// Makes attributes of all fields that a struct of parameters visits.
template <class P>
struct FieldBinder {
  pybind11::class_<P>& bound;
  const P& sample;

  /// The attribute is called like the field; `pass`, a keyword of Python, is `pass_`.
  template <class F>
  void operator()(const char* field_name, const F& field) {
    std::string name = field_name;
    if (pybind11::module_::import("keyword").attr("iskeyword")(name).cast<bool>()) name += '_';
    const std::ptrdiff_t offset = reinterpret_cast<const char*>(&field) - reinterpret_cast<const char*>(&sample);
    const auto in = [offset](P& params) -> F& {
      return *reinterpret_cast<F*>(reinterpret_cast<char*>(&params) + offset);
    };
    if constexpr (std::is_class_v<F> && !std::is_same_v<F, std::string>) {  // params.states.cell_size = 0.1 works
      bound.def_property(name.c_str(), pybind11::cpp_function(in, pybind11::return_value_policy::reference_internal),
                         pybind11::cpp_function([in](P& params, const F& value) { in(params) = value; }));
    } else {
      bound.def_property(name.c_str(), pybind11::cpp_function([in](P& params) -> F { return in(params); }),
                         pybind11::cpp_function([in, name](P& params, F value) {
                           if constexpr (std::is_floating_point_v<F>)
                             if (std::isnan(value)) throw pybind11::value_error(name + " must not be NaN");
                           in(params) = value;
                         }));
    }
  }
};

/// A class of parameters: all at their defaults, then those that are given by name.
template <class P>
void bind_params(pybind11::module_& module, const char* name, const char* what) {
  pybind11::class_<P> bound{module, name, what};
  P sample;
  FieldBinder<P> binder{bound, sample};
  sample.visit(binder);
  bound.def(pybind11::init([](const pybind11::kwargs& fields) {
    auto params = std::make_unique<P>();
    const pybind11::object self = pybind11::cast(params.get(), pybind11::return_value_policy::reference);
    for (const auto& [field, value] : fields) pybind11::setattr(self, field, value);
    return params;
  }));
}

}  // namespace docent::python
