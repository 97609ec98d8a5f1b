#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace docent::task_control {

// Lists of exhibits and stops, for the sources of this folder.

template <class T>
[[nodiscard]] bool holds(const std::vector<T>& list, const T& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// Their names with spaces between them. @param name_of  a member of a stop, or a function of it
template <class Stop, class NameOf>
[[nodiscard]] std::string joined(const std::vector<Stop>& stops, NameOf name_of) {
  std::string text;
  for (const Stop& stop : stops) text += (text.empty() ? "" : " ") + std::invoke(name_of, stop);
  return text;
}

}  // namespace docent::task_control
