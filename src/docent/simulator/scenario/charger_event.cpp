#include "docent/simulator/scenario/charger_event.h"

#include <string>

namespace docent::simulator {

ChargerFault read_charger(const YamlFile& file, const YAML::Node& node) {
  constexpr double kLongestFault = 1e8;  // [s]
  ChargerFault event;
  std::string kind;
  YamlReader reader{file, node};
  reader.required("kind", kind);
  reader("for", event.duration);
  reader.finish();
  using Kind = ChargerFault::Kind;
  if (kind == "dead") {
    event.kind = Kind::dead;
  } else if (kind == "claims") {
    event.kind = Kind::claims;
  } else if (kind == "mute") {
    event.kind = Kind::mute;
  } else {
    throw YamlFault{file.fault(node["kind"], "expected one of dead, claims, mute, found '" + kind + "'")};
  }
  if (!(event.duration >= 0.0 && event.duration <= kLongestFault))
    throw YamlFault{file.fault(node, "'for' must be from 0 to 1e8")};
  return event;
}

}  // namespace docent::simulator
