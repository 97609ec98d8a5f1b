#pragma once

#include "docent/base/yaml.h"

namespace docent::simulator {

/// The charger gives no current.
struct ChargerFault {
  enum class Kind {
    dead,    ///< and the battery says that it does not charge
    claims,  ///< and the battery says that it charges
    mute     ///< and the battery says nothing of it, nor ever after
  };
  Kind kind = Kind::dead;
  double duration = 0.0;  ///< [s]; 0: to the end
};

/// `{kind: dead, for: 60}`. Throws YamlFault.
[[nodiscard]] ChargerFault read_charger(const YamlFile& file, const YAML::Node& node);

}  // namespace docent::simulator
