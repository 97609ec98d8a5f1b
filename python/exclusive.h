#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <utility>

namespace docent::python {

/// A C++ object that one thread at a time may use. Calls of Python's threads end here at once, as the interpreter's
/// lock is released while C++ works.
template <class T>
class Exclusive {
 public:
  explicit Exclusive(std::unique_ptr<T> value) : value_{std::move(value)} {}

  /// What `work` makes of the object, which it may not touch Python for. The interpreter's lock goes first: whoever
  /// waits for the object must not hold up others.
  template <class Work>
  auto use(const Work& work) {
    const pybind11::gil_scoped_release others_run;
    const std::scoped_lock lock{mutex_};
    return work(*value_);
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<T> value_;
};

/// Long work beside Python's other threads.
template <class Work>
auto without_interpreter(const Work& work) {
  const pybind11::gil_scoped_release others_run;
  return work();
}

}  // namespace docent::python
