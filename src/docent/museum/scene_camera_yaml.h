#pragma once

#include <cmath>
#include <optional>

#include "docent/base/yaml.h"
#include "docent/museum/museum.h"

namespace docent::museum {

struct SceneCameraYaml {
  double x = 0.0;
  double y = 0.0;
  double height = SceneCamera{}.height;
  template <class V>
  void visit(V& v) {
    v.required("x", x);
    v.required("y", y);
    v("height", height);
  }
};

/// Key `scene_camera` of museum.yaml; nullopt: it has none. Throws YamlFault where no camera can hang.
inline std::optional<SceneCamera> read_scene_camera(const YamlFile& file, YamlReader& reader) {
  constexpr double kFarthest = 10'000.0;  // [m]
  std::optional<SceneCameraYaml> yaml;
  reader("scene_camera", yaml);
  if (!yaml) return std::nullopt;
  const auto fault = [&](const char* why) { return YamlFault{file.fault(reader.node("scene_camera"), why)}; };
  if (!(std::abs(yaml->x) <= kFarthest && std::abs(yaml->y) <= kFarthest)) throw fault("too far away");
  if (!(yaml->height >= 0.5 && yaml->height <= 50.0)) throw fault("height must be 0.5 to 50 m");
  return SceneCamera{{yaml->x, yaml->y}, yaml->height};
}

}  // namespace docent::museum
