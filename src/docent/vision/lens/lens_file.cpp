#include "docent/vision/lens/lens_file.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "docent/base/text.h"

namespace docent::vision {
namespace {

constexpr double kCorner = 0.5;  // [pixels] from the upper left corner of a picture to the middle of its first pixel
constexpr std::size_t kBrown = 5, kFisheye = 4;  // coefficients

struct LensYaml {
  std::string model;
  int width = 0, height = 0;
  std::vector<double> focal, centre, distortion;
  template <class V>
  void visit(V& v) {
    v.required("model", model);
    v.required("width", width);
    v.required("height", height);
    v.required("focal", focal);
    v.required("centre", centre);
    v.required("distortion", distortion);
  }
};

}  // namespace

Result<Lens> read_lens(const YamlFile& file, const YAML::Node& node) {
  if (!node.IsMap()) return tl::unexpected<Error>(file.fault(node, "expected a lens: model, width, height, ..."));
  LensYaml yaml;
  const auto unknown = read_yaml_leniently(file, node, yaml);
  if (!unknown) return tl::unexpected<Error>(unknown.error());
  for (const std::string& key : *unknown)
    if (key != "mount") return tl::unexpected<Error>(file.fault(node[key], "unknown key '" + key + "'"));
  const auto fault = [&](const char* key, const std::string& what) {
    return tl::unexpected<Error>(file.fault(node[key], std::string{key} + " " + what));
  };
  LensParams lens;
  if (yaml.model != "brown" && yaml.model != "fisheye")
    return fault("model", "must be brown or fisheye, found '" + yaml.model + "'");
  lens.kind = yaml.model == "fisheye" ? LensParams::Kind::fisheye : LensParams::Kind::pinhole;
  if (yaml.focal.size() != 2) return fault("focal", "must be [x, y] in pixels");
  if (yaml.centre.size() != 2) return fault("centre", "must be [x, y] in pixels");
  const std::size_t bends = yaml.model == "fisheye" ? kFisheye : kBrown;
  if (yaml.distortion.size() != bends)
    return fault("distortion", "of a " + yaml.model + " lens must be " + std::to_string(bends) + " numbers");
  lens.columns = yaml.width, lens.rows = yaml.height;
  lens.focal_x = yaml.focal[0], lens.focal_y = yaml.focal[1];
  lens.centre_x = yaml.centre[0] - kCorner, lens.centre_y = yaml.centre[1] - kCorner;
  std::copy(yaml.distortion.begin(), yaml.distortion.end(), lens.bend.begin());
  auto made = Lens::make(lens);
  if (!made) return tl::unexpected<Error>(file.fault(node, made.error().message));
  return made;
}

std::string lens_to_yaml(const LensParams& lens, const std::string& indent) {
  const bool is_fisheye = lens.kind == LensParams::Kind::fisheye;
  const auto line = [&](const char* key, const std::string& value) { return indent + key + ": " + value + "\n"; };
  const double focal[] = {lens.focal_x, lens.focal_y}, centre[] = {lens.centre_x + kCorner, lens.centre_y + kCorner};
  return line("model", is_fisheye ? "fisheye" : "brown") + line("width", std::to_string(lens.columns)) +
         line("height", std::to_string(lens.rows)) + line("focal", yaml_list(focal)) +
         line("centre", yaml_list(centre)) +
         line("distortion", yaml_list(std::span{lens.bend}.first(is_fisheye ? kFisheye : kBrown)));
}

}  // namespace docent::vision
