#pragma once

#include <optional>

#include "docent/base/yaml.h"
#include "docent/simulator/transport/wire.h"

namespace docent::simulator {

enum class Sensor;  // scenario.h

/// From now on a sensor's messages come over such a wire, with a clock of its own; without `sensor` those of all, each
/// over one of its own.
struct Transport {
  std::optional<Sensor> sensor;  ///< "all" in a file
  double duration = 0.0;         ///< [s]; 0: to the end
  WireParams wire;
};

/// `{sensor: odom, jitter: 0.05, drop: 0.1, for: 60}`, with the keys of WireParams. Throws YamlFault.
[[nodiscard]] Transport read_transport(const YamlFile& file, const YAML::Node& node);

}  // namespace docent::simulator
