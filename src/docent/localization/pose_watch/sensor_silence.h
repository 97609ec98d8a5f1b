#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/time.h"

namespace docent::localization {

/// Which of the sensors that should speak all the time has not been heard for too long.
class SensorSilence {
 public:
  /// @param names  [sensors] in the order in which their silence matters
  /// @param limit  who has not spoken for longer is silent
  SensorSilence(std::vector<std::string> names, Duration limit);

  void hear(std::size_t sensor, Time now) { heard_[sensor] = now; }
  /// The name of the first one that is silent; none: all were heard.
  [[nodiscard]] std::optional<std::string> first_silent(Time now) const;

 private:
  std::vector<std::string> names_;
  Duration limit_;
  std::vector<Time> heard_;
};

}  // namespace docent::localization
