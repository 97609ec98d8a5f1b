#include "docent/simulator/scenario/transport_event.h"

#include <algorithm>
#include <array>
#include <string>

#include "docent/simulator/scenario/scenario.h"

namespace docent::simulator {
namespace {

constexpr double kLongestWire = 1e8;  // [s]

}  // namespace

Transport read_transport(const YamlFile& file, const YAML::Node& node) {
  Transport event;
  std::string sensor;
  YamlReader reader{file, node};
  reader.required("sensor", sensor);
  reader("for", event.duration);
  event.wire.visit(reader);
  reader.finish();
  if (sensor != "all") {
    const auto* const name = std::find(kSensorNames.begin(), kSensorNames.end(), sensor);
    if (name == kSensorNames.end()) {
      std::string names;
      for (const char* known : kSensorNames) names += std::string{known} + ", ";
      throw YamlFault{file.fault(node["sensor"], "expected one of " + names + "all, found '" + sensor + "'")};
    }
    event.sensor = static_cast<Sensor>(name - kSensorNames.begin());
  }
  if (!(event.duration >= 0.0 && event.duration <= kLongestWire))
    throw YamlFault{file.fault(node, "'for' must be from 0 to 1e8")};
  if (const auto valid = event.wire.validate(); !valid) throw YamlFault{file.fault(node, valid.error().message)};
  return event;
}

}  // namespace docent::simulator
