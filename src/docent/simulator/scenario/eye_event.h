#pragma once

#include "docent/base/yaml.h"

namespace docent::simulator {

/// Something happens to an eye of the robot, or to the light.
struct EyeFault {
  enum class Eye { depth, ceiling, front };
  enum class Kind {
    gone,         ///< no picture at all
    frozen,       ///< the last one again and again, with fresh stamps
    black,        ///< nothing on it
    upside_down,  ///< turned by half a turn
    late,         ///< pictures come `delay` seconds after their stamp
    exposure,     ///< the ceiling's is `gain` times as bright
    lamps_off     ///< all lamps of the hall are out
  };
  Eye eye = Eye::depth;
  Kind kind = Kind::gone;
  double duration = 0.0;  ///< [s]; 0: to the end
  double delay = 0.8;     ///< [s]
  double gain = 0.4;
};

/// `{eye: depth, kind: late, for: 60, delay: 0.8, gain: 0.4}`. Throws YamlFault.
[[nodiscard]] EyeFault read_eye_fault(const YamlFile& file, const YAML::Node& node);

}  // namespace docent::simulator
