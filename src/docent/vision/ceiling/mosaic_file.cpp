#include "docent/vision/ceiling/mosaic_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "docent/base/files.h"
#include "docent/base/text.h"
#include "docent/base/yaml.h"
#include "docent/grid/map_image.h"
#include "docent/pictures/png/png_file.h"

namespace docent::vision {
namespace {

namespace fs = std::filesystem;

constexpr double kWhite = 65535.0;
constexpr double kMostCells = 1e8;    // a hall of 200 m x 200 m at 2 cm
constexpr double kHighest = 200.0;    // [m] of a ceiling
constexpr double kFarthest = 1e7;     // [m] of the origin: as far as one coordinate goes on Earth
constexpr double kFinest = 1e-3;      // [m] of a cell
constexpr double kCoarsest = 1.0;     // [m]
constexpr double kBrightest = 100.0;  // of brightness, either way

struct CeilingYaml {
  std::string picture, parts;
  double resolution = 0.0;
  std::vector<double> origin, heights, brightness;
  std::string digest;
  bool cut_short = false;
  template <class V>
  void visit(V& v) {
    v.required("picture", picture);
    v.required("parts", parts);
    v.required("resolution", resolution);
    v.required("origin", origin);
    v.required("heights", heights);
    v.required("brightness", brightness);
    v("digest", digest);
    v("cut_short", cut_short);
  }
};

/// FNV-1a of 64 bits.
std::string digest_of(std::string_view one, std::string_view other) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const std::string_view bytes : {one, other})
    for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

fs::path beside(const fs::path& yaml, const char* ending) {
  return yaml.parent_path() / (yaml.stem().string() + ending);
}

Result<void> check(const CeilingMosaic& mosaic) {
  const std::size_t size = mosaic.frame.size();
  if (mosaic.frame.columns < 1 || mosaic.frame.rows < 1 || mosaic.part.size() != size ||
      mosaic.brightness.size() != size)
    return fail("a mosaic whose cells are not as many as its frame says");
  if (mosaic.heights.empty()) return fail("a mosaic without heights");
  for (std::size_t i = 0; i < size; ++i) {
    if (mosaic.part[i] == CeilingMosaic::kUnknown) continue;
    if (mosaic.part[i] >= mosaic.heights.size()) return fail("a mosaic with a cell of a part that it has not");
    if (!(std::abs(mosaic.brightness[i]) <= static_cast<float>(kBrightest)))
      return fail("a mosaic with a cell of no brightness");
  }
  return {};
}

/// Least and most of what is known; never the same.
std::pair<double, double> range_of(const CeilingMosaic& mosaic) {
  double low = 0.0, high = 1.0;
  for (std::size_t i = 0; i < mosaic.part.size(); ++i) {
    if (mosaic.part[i] == CeilingMosaic::kUnknown) continue;
    low = std::min(low, static_cast<double>(mosaic.brightness[i]));
    high = std::max(high, static_cast<double>(mosaic.brightness[i]));
  }
  return {low, high};
}

Result<void> check(const YamlFile& file, const CeilingYaml& yaml) {
  const auto fault = [&](const char* key, const std::string& what) -> Result<void> {
    return tl::unexpected<Error>(file.fault(file.root()[key], what));
  };
  const auto within = [](double low, double high) {
    return [low, high](double value) { return value >= low && value <= high; };
  };
  if (!within(kFinest, kCoarsest)(yaml.resolution)) return fault("resolution", "resolution must be 0.001 to 1 m");
  if (yaml.origin.size() != 2 || !std::all_of(yaml.origin.begin(), yaml.origin.end(), within(-kFarthest, kFarthest)))
    return fault("origin", "origin must be [x, y] in m");
  if (yaml.heights.empty() || yaml.heights.size() >= CeilingMosaic::kUnknown)
    return fault("heights", "heights must be 1 to 254 numbers");
  if (!std::all_of(yaml.heights.begin(), yaml.heights.end(), within(0.1, kHighest)))
    return fault("heights", "heights must be 0.1 to 200 m above the floor");
  if (yaml.brightness.size() != 2 ||
      !std::all_of(yaml.brightness.begin(), yaml.brightness.end(), within(-kBrightest, kBrightest)) ||
      yaml.brightness[0] >= yaml.brightness[1])
    return fault("brightness", "brightness must be [of black, of white], the second above the first");
  return {};
}

/// Opens an image that the file names under `key`.
Result<std::unique_ptr<MapImage>> open(const YamlFile& file, const fs::path& path, const char* key) {
  auto image = open_map_image(path);
  if (image) return image;
  if (!fs::is_regular_file(path))
    return tl::unexpected<Error>(file.fault(file.root()[key], std::string{key} + " " + image.error().message));
  return image;
}

/// Hands out `cell(index, shade)` for each cell of an image whose first row is the map's top.
template <class Cell>
Result<void> read_cells(MapImage& image, const GridFrame& frame, const Cell& cell) {
  std::vector<std::uint32_t> shades;
  for (int row = frame.rows - 1; row >= 0; --row) {
    if (auto read = image.read_row(shades); !read) return read;
    for (int column = 0; column < frame.columns; ++column)
      cell(frame.index({column, row}), shades[static_cast<std::size_t>(column)]);
  }
  return {};
}

/// That both images are those that the file was written with.
Result<void> check_digest(const YamlFile& file, const CeilingYaml& yaml, const fs::path& picture,
                          const fs::path& parts) {
  if (yaml.digest.empty()) return {};
  const auto one = read_file(picture);
  if (!one) return tl::unexpected<Error>(one.error());
  const auto other = read_file(parts);
  if (!other) return tl::unexpected<Error>(other.error());
  if (digest_of(*one, *other) == yaml.digest) return {};
  return tl::unexpected<Error>(
      file.fault(file.root()["digest"], yaml.picture + " and " + yaml.parts +
                                            " are not those that this file was written with; take this line out if "
                                            "they were changed on purpose"));
}

}  // namespace

Result<void> write_ceiling(const fs::path& path, const CeilingMosaic& mosaic) {
  if (lower_case(path.extension().string()) != ".yaml" || path.stem().empty())
    return fail("'" + path.string() + "': expected FOLDER/NAME.yaml");
  if (auto sound = check(mosaic); !sound) return fail(path.string() + ": " + sound.error().message);
  const auto [low, high] = range_of(mosaic);
  const GridFrame& frame = mosaic.frame;
  std::vector<std::uint16_t> shades;
  std::vector<std::uint8_t> parts;
  shades.reserve(frame.size()), parts.reserve(frame.size());
  for (int row = frame.rows - 1; row >= 0; --row) {
    for (int column = 0; column < frame.columns; ++column) {
      const std::size_t cell = frame.index({column, row});
      const bool is_known = mosaic.part[cell] != CeilingMosaic::kUnknown;
      const double share = is_known ? (static_cast<double>(mosaic.brightness[cell]) - low) / (high - low) : 0.0;
      shades.push_back(static_cast<std::uint16_t>(std::lround(kWhite * share)));
      parts.push_back(mosaic.part[cell]);
    }
  }
  const auto picture_png = pictures::encode_png(frame.columns, frame.rows, std::span<const std::uint16_t>{shades});
  if (!picture_png) return tl::unexpected<Error>(picture_png.error());
  const auto parts_png = pictures::encode_png(frame.columns, frame.rows, std::span<const std::uint8_t>{parts});
  if (!parts_png) return tl::unexpected<Error>(parts_png.error());
  const fs::path picture = beside(path, "-picture.png"), part = beside(path, "-parts.png");
  YAML::Emitter yaml;
  yaml.SetDoublePrecision(12);
  yaml << YAML::BeginMap;
  yaml << YAML::Key << "picture" << YAML::Value << picture.filename().string();
  yaml << YAML::Key << "parts" << YAML::Value << part.filename().string();
  yaml << YAML::Key << "resolution" << YAML::Value << frame.resolution;
  yaml << YAML::Key << "origin" << YAML::Value << YAML::Flow << YAML::BeginSeq << frame.origin.x << frame.origin.y
       << YAML::EndSeq;
  yaml << YAML::Key << "heights" << YAML::Value << YAML::Flow << mosaic.heights;
  yaml << YAML::Key << "brightness" << YAML::Value << YAML::Flow << YAML::BeginSeq << low << high << YAML::EndSeq;
  yaml << YAML::Key << "digest" << YAML::Value << YAML::DoubleQuoted << digest_of(*picture_png, *parts_png);
  if (mosaic.is_cut_short) yaml << YAML::Key << "cut_short" << YAML::Value << true;
  yaml << YAML::EndMap;
  if (auto written = write_file_atomically(picture, *picture_png); !written) return written;
  if (auto written = write_file_atomically(part, *parts_png); !written) return written;
  return write_file_atomically(path, std::string{yaml.c_str()} + "\n");
}

Result<CeilingMosaic> read_ceiling(const fs::path& path) {
  if (begins_with(path, "\x89PNG"))
    return fail(path.string() + ": this is an image of a ceiling; name the YAML file that says its scale");
  const auto file = YamlFile::load(path);
  if (!file) return tl::unexpected<Error>(file.error());
  CeilingYaml yaml;
  if (auto read = read_yaml(*file, file->root(), yaml); !read) return tl::unexpected<Error>(read.error());
  if (auto good = check(*file, yaml); !good) return tl::unexpected<Error>(good.error());
  const fs::path picture = path.parent_path() / yaml.picture, parts = path.parent_path() / yaml.parts;
  const auto shades = open(*file, picture, "picture");
  if (!shades) return tl::unexpected<Error>(shades.error());
  const auto numbers = open(*file, parts, "parts");
  if (!numbers) return tl::unexpected<Error>(numbers.error());
  const long width = (*shades)->width(), height = (*shades)->height();
  if (static_cast<double>(width) * static_cast<double>(height) > kMostCells)
    return fail(picture.string() + ":1: more than 100 million pixels");
  if ((*numbers)->width() != width || (*numbers)->height() != height)
    return fail(parts.string() + ":1: is " + std::to_string((*numbers)->width()) + " x " +
                std::to_string((*numbers)->height()) + " pixels, but " + yaml.picture + " is " + std::to_string(width) +
                " x " + std::to_string(height));
  if ((*numbers)->white() != 255) return fail(parts.string() + ":1: expected grey of 8 bits, the numbers of the parts");
  if (auto same = check_digest(*file, yaml, picture, parts); !same) return tl::unexpected<Error>(same.error());
  CeilingMosaic mosaic;
  mosaic.frame = {static_cast<int>(width), static_cast<int>(height), yaml.resolution, {yaml.origin[0], yaml.origin[1]}};
  mosaic.heights = yaml.heights;
  mosaic.is_cut_short = yaml.cut_short;
  mosaic.part.resize(mosaic.frame.size());
  mosaic.brightness.resize(mosaic.frame.size());
  std::uint32_t odd = 0;
  auto read = read_cells(**numbers, mosaic.frame, [&](std::size_t cell, std::uint32_t shade) {
    const std::uint32_t part = shade == MapImage::kClear ? CeilingMosaic::kUnknown : shade;
    if (part != CeilingMosaic::kUnknown && part >= yaml.heights.size()) odd = std::max(odd, part);
    mosaic.part[cell] = static_cast<std::uint8_t>(part);
  });
  if (!read) return tl::unexpected<Error>(read.error());
  if (odd != 0)
    return fail(parts.string() + ":1: has a part " + std::to_string(odd) + ", counted from 0, but there are " +
                std::to_string(yaml.heights.size()) + " heights");
  const double white = (*shades)->white();
  read = read_cells(**shades, mosaic.frame, [&](std::size_t cell, std::uint32_t shade) {
    if (shade == MapImage::kClear) mosaic.part[cell] = CeilingMosaic::kUnknown;
    if (mosaic.part[cell] == CeilingMosaic::kUnknown) return;
    mosaic.brightness[cell] =
        static_cast<float>(yaml.brightness[0] + shade / white * (yaml.brightness[1] - yaml.brightness[0]));
  });
  if (!read) return tl::unexpected<Error>(read.error());
  return mosaic;
}

}  // namespace docent::vision
