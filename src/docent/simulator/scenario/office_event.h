#pragma once

#include <string>

#include "docent/base/yaml.h"

namespace docent::simulator {

/// Somebody in an office orders something of the robot, or begins to help it.
struct OfficeEvent {
  enum class Kind {
    deliver,  ///< to a room
    tidy,     ///< a room, or all
    confirm,
    stop,
    helper  ///< from now on somebody is there who takes what is brought, puts in what is pointed at, empties the bin
  };
  Kind kind = Kind::tidy;
  std::string room;    ///< its id
  double after = 5.0;  ///< [s] that a helper takes for each
};
/// As files and messages call it.
[[nodiscard]] const char* to_text(OfficeEvent::Kind kind);

/// `{kind: deliver, room: kitchen}`, `{kind: helper, after: 5}`. Throws YamlFault.
[[nodiscard]] OfficeEvent read_office_event(const YamlFile& file, const YAML::Node& node);

}  // namespace docent::simulator
