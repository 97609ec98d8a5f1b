#pragma once

#include <string>

#include "docent/base/yaml.h"
#include "docent/vision/lens/lens.h"

namespace docent::vision {

/// A lens as a mapping of YAML: `model` (brown or fisheye), `width`, `height`, `focal` [x, y], `centre` [x, y] from the
/// picture's upper left corner, so that the middle of the first pixel is 0.5, and `distortion` (five numbers of a brown
/// lens, four of a fisheye), all in pixels as LensParams has them. `mount` beside them is left to others.
/// Error: "FILE:LINE: ...".
[[nodiscard]] Result<Lens> read_lens(const YamlFile& file, const YAML::Node& node);

/// What read_lens reads, each line after `indent`.
[[nodiscard]] std::string lens_to_yaml(const LensParams& lens, const std::string& indent = "");

}  // namespace docent::vision
