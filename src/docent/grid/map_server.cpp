#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <numbers>
#include <set>

#include "docent/base/files.h"
#include "docent/base/text.h"
#include "docent/base/yaml.h"
#include "docent/grid/map_image.h"
#include "docent/grid/map_reading.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/grid/turned.h"

// Maps as ROS's map_server (ROS 1 and Nav2) reads and writes them: a YAML file that names an image; the image's first
// row is the map's top. In one thing more is known than it makes of them: every map_saver writes 205 of 255 for
// unknown, and Nav2's writes `free_thresh: 0.25` beside it, by which the same picture would come back as one slab of
// free floor.

namespace docent {
namespace {

constexpr double kSaversUnknown = 205.0 / 255.0;  ///< of white
constexpr double kNearSaversUnknown = 0.005;      ///< of white
constexpr std::size_t kLarge = 25'000'000;        ///< [cells]: of a larger map only what is known is kept
constexpr std::size_t kMost = 400'000'000;        ///< [cells]
constexpr std::size_t kRowsBetween = 256;         ///< between two words of how far the reading is
constexpr double kCoarse = 0.5, kFine = 0.002;    ///< [m] beyond these a resolution is as likely a slip
constexpr int kRim = 20;                          ///< [cells] of what is unknown round what is kept

struct MapYaml {
  std::string image;
  double resolution = 0.0;
  std::vector<std::string> origin;
  std::string negate = "0";
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
  std::string mode = "trinary";
  template <class V>
  void visit(V& v) {
    v.required("image", image);
    v.required("resolution", resolution);
    v.required("origin", origin);
    v("negate", negate);
    v("occupied_thresh", occupied_thresh);
    v("free_thresh", free_thresh);
    v("mode", mode);
  }
};

/// A key that stands twice says two things, and each reader of YAML takes another one.
Result<void> keys_stand_once(const YamlFile& file) {
  std::set<std::string> keys;
  if (!file.root().IsMap()) return {};
  for (const auto& entry : file.root())
    if (entry.first.IsScalar() && !keys.insert(entry.first.Scalar()).second)
      return tl::unexpected<Error>(file.fault(entry.first, "key '" + entry.first.Scalar() + "' stands here twice"));
  return {};
}

/// The first document of the file, which is all that map_server reads.
Result<YamlFile> load_first_document(const std::filesystem::path& path, std::vector<std::string>& notes) {
  auto text = read_file(path);
  if (!text) return tl::unexpected<Error>(text.error());
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(*text);
    const auto another = std::find_if(documents.begin() + (documents.empty() ? 0 : 1), documents.end(),
                                      [](const YAML::Node& document) { return !document.IsNull(); });
    if (another != documents.end()) {
      const auto mark = another->Mark();
      notes.push_back("another YAML document begins in line " + std::to_string(mark.line + 1) + ": it is left out");
      text->resize(text->rfind("---", static_cast<std::size_t>(mark.pos)));
    }
  } catch (const YAML::Exception&) {
    return YamlFile::parse(*text, path.string());  // says where
  }
  return YamlFile::parse(*text, path.string());
}

/// What is said by the file, in the terms of this program.
struct Meaning {
  double resolution = 0.0;  ///< [m]
  Pose2 origin;             ///< of the image's lower left corner, [m, rad]
  bool is_negated = false;
  double occupied_thresh = 0.0, free_thresh = 0.0;
  std::string mode;
};

/// [rad] of the origin; what some savers write for a heading that they never had ("-nan") is none.
Result<double> yaw_of(const std::string& text, std::vector<std::string>& notes) {
  const std::string plain = lower_case(text);
  if (plain.ends_with("nan")) {
    notes.emplace_back("the origin's yaw is not a number, which some programs write for 0");
    return 0.0;
  }
  char* end = nullptr;
  const double yaw = std::strtod(plain.c_str(), &end);
  if (plain.empty() || *end != '\0' || !std::isfinite(yaw))
    return fail("origin must be [x, y, yaw], found '" + text + "'");
  constexpr double kTurn = 6.2832;  // [rad] as people round it: nobody writes more than that and means radians
  if (std::abs(yaw) > kTurn) return fail("the origin's yaw is in radians, and " + text + " is more than a turn");
  return std::remainder(yaw, 2.0 * std::numbers::pi);
}

Result<Meaning> meaning_of(const YamlFile& file, const MapYaml& yaml, std::vector<std::string>& notes) {
  const auto fault = [&](const char* key, const std::string& what) {
    return tl::unexpected<Error>(file.fault(file.root()[key], what));
  };
  constexpr double kFinest = 1e-4;   // [m]
  constexpr double kFarthest = 1e7;  // [m] as far as one coordinate goes on Earth
  Meaning meaning{.resolution = yaml.resolution,
                  .origin = {},
                  .occupied_thresh = yaml.occupied_thresh,
                  .free_thresh = yaml.free_thresh,
                  .mode = lower_case(yaml.mode)};
  if (!(yaml.resolution >= kFinest && yaml.resolution < 10.0))
    return fault("resolution", "resolution must be in (0, 10) m");
  if (yaml.resolution > kCoarse || yaml.resolution < kFine) {
    std::array<char, 120> text{};
    std::snprintf(text.data(), text.size(), "the resolution of %g m a cell is far %s than that of robots' maps",
                  yaml.resolution, yaml.resolution > kCoarse ? "coarser" : "finer");
    notes.emplace_back(text.data());
  }
  if (yaml.origin.size() != 3) return fault("origin", "origin must be [x, y, yaw]");
  for (const auto& [text, field] :
       {std::pair{yaml.origin[0], &meaning.origin.x}, {yaml.origin[1], &meaning.origin.y}}) {
    char* end = nullptr;
    *field = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0') return fault("origin", "origin must be [x, y, yaw], found '" + text + "'");
    if (!(std::abs(*field) <= kFarthest)) return fault("origin", "origin lies nowhere on Earth");
  }
  const auto yaw = yaw_of(yaml.origin[2], notes);
  if (!yaw) return fault("origin", yaw.error().message);
  meaning.origin.theta = Angle::radians(*yaw);
  const std::string negate = lower_case(yaml.negate);
  const auto is_one_of = [&](std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(), [&](const char* word) { return negate == word; });
  };
  meaning.is_negated = is_one_of({"1", "true", "yes", "on", "y"});  // YAML 1.1's words for it
  if (!meaning.is_negated && !is_one_of({"0", "false", "no", "off", "n"}))
    return fault("negate", "negate must be 0 or 1");
  if (!(0.0 <= yaml.free_thresh && yaml.free_thresh < yaml.occupied_thresh && yaml.occupied_thresh <= 1.0)) {
    return fault("occupied_thresh", "thresholds must hold 0 <= free_thresh < occupied_thresh <= 1");
  }
  if (meaning.mode != "trinary" && meaning.mode != "scale" && meaning.mode != "raw")
    return fault("mode", "mode must be trinary, scale or raw");
  return meaning;
}

/// What each shade from 0 to `white` says by the file's mode.
std::vector<std::int8_t> cells_of_shades(const Meaning& meaning, std::uint32_t white) {
  std::vector<std::int8_t> cells(white + std::size_t{1});
  // Of a coarser white the shade that it is rounded to, if that is near enough to be it.
  const double step = std::clamp(0.5 / white, 0.5 / 255.0, kNearSaversUnknown);
  for (std::uint32_t value = 0; value <= white; ++value) {
    const double shade = static_cast<double>(value) / white;
    const double occupied = meaning.is_negated ? shade : 1.0 - shade;
    const bool is_trinary = meaning.mode == "trinary";
    std::int8_t cell = OccupancyGrid::kUnknown;
    if (meaning.mode == "raw") {
      const long percent = std::lround(shade * 255.0);
      if (percent <= OccupancyGrid::kOccupied) cell = static_cast<std::int8_t>(percent);
    } else if (is_trinary && !meaning.is_negated && std::abs(shade - kSaversUnknown) <= step) {
      cell = OccupancyGrid::kUnknown;
    } else if (occupied > meaning.occupied_thresh) {
      cell = OccupancyGrid::kOccupied;
    } else if (occupied < meaning.free_thresh) {
      cell = OccupancyGrid::kFree;
    } else if (!is_trinary) {
      const double share = (occupied - meaning.free_thresh) / (meaning.occupied_thresh - meaning.free_thresh);
      cell = static_cast<std::int8_t>(std::lround(100.0 * share));
    }
    cells[value] = cell;
  }
  return cells;
}

/// A row without what is unknown at its ends.
struct KnownPart {
  long from = 0;
  std::vector<std::int8_t> cells;
};

/// The rows of the image, from the top. What is not at least half opaque is unknown in every mode.
Result<std::vector<KnownPart>> read_rows(MapImage& image, const Meaning& meaning, const ReadingProgress& progress) {
  const std::vector<std::int8_t> cell_of = cells_of_shades(meaning, image.white());
  std::vector<KnownPart> rows(static_cast<std::size_t>(image.height()));
  std::vector<std::uint32_t> shades;
  std::vector<std::int8_t> cells(static_cast<std::size_t>(image.width()));
  const auto is_known = [](std::int8_t cell) { return cell != OccupancyGrid::kUnknown; };
  std::size_t known = 0, done = 0;
  for (KnownPart& row : rows) {
    if (progress && done++ % kRowsBetween == 0) progress(static_cast<double>(done) / static_cast<double>(rows.size()));
    if (auto read = image.read_row(shades); !read) return tl::unexpected<Error>(read.error());
    std::transform(shades.begin(), shades.end(), cells.begin(), [&](std::uint32_t shade) {
      return shade == MapImage::kClear ? OccupancyGrid::kUnknown : cell_of[shade];
    });
    const auto first = std::find_if(cells.begin(), cells.end(), is_known);
    const auto last = std::find_if(cells.rbegin(), std::make_reverse_iterator(first), is_known).base();
    row.from = first - cells.begin();
    row.cells.assign(first, last);
    known += row.cells.size();
    if (known > kMost) return fail("more than " + std::to_string(kMost) + " cells are known");
  }
  return rows;
}

/// The grid of all rows, or, of a large image most of whose rim is unknown, of the part that is known.
Result<OccupancyGrid> grid_of(const MapImage& image, const std::vector<KnownPart>& rows, const Meaning& meaning,
                              std::vector<std::string>& notes) {
  long left = 0, right = image.width(), top = 0, bottom = image.height();
  const auto cells_of = [&] { return static_cast<std::size_t>(right - left) * static_cast<std::size_t>(bottom - top); };
  const std::size_t all = cells_of();
  if (all > kLarge) {
    left = image.width(), right = 0, top = image.height(), bottom = 0;
    for (long row = 0; row < image.height(); ++row) {
      const KnownPart& part = rows[static_cast<std::size_t>(row)];
      if (part.cells.empty()) continue;
      left = std::min(left, part.from), right = std::max(right, part.from + static_cast<long>(part.cells.size()));
      top = std::min(top, row), bottom = row + 1;
    }
    if (right <= left) return fail("nothing in it is known");
    left = std::max(0L, left - kRim), right = std::min(image.width(), right + kRim);
    top = std::max(0L, top - kRim), bottom = std::min(image.height(), bottom + kRim);
    if (cells_of() > kMost)
      return fail(std::to_string(right - left) + " x " + std::to_string(bottom - top) +
                  " pixels of it are known: more than " + std::to_string(kMost));
    if (2 * cells_of() > all && all <= kMost) left = top = 0, right = image.width(), bottom = image.height();
    if (cells_of() < all)
      notes.push_back("of " + std::to_string(image.width()) + " x " + std::to_string(image.height()) + " pixels the " +
                      std::to_string(right - left) + " x " + std::to_string(bottom - top) +
                      " round what is known are used");
  }
  OccupancyGrid map;
  map.frame = {static_cast<int>(right - left),
               static_cast<int>(bottom - top),
               meaning.resolution,
               {static_cast<double>(left) * meaning.resolution,
                static_cast<double>(image.height() - bottom) * meaning.resolution}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kUnknown);
  for (long row = top; row < bottom; ++row) {
    const KnownPart& part = rows[static_cast<std::size_t>(row)];
    if (part.cells.empty()) continue;
    const CellIndex to{static_cast<int>(part.from - left), static_cast<int>(bottom - 1 - row)};
    std::copy(part.cells.begin(), part.cells.end(),
              map.cells.begin() + static_cast<std::ptrdiff_t>(map.frame.index(to)));
  }
  return map;
}

/// Lays the map, whose frame begins at the image's corner, to where the file says.
void place(OccupancyGrid& map, const MapImage& image, const Pose2& origin, std::vector<std::string>& notes) {
  const double reach = std::hypot(static_cast<double>(image.width()), static_cast<double>(image.height()));  // [pixels]
  const double angle = origin.theta.radians();
  if (std::abs(angle) * reach > 0.5) {  // else no cell becomes another one
    map = turned(map, angle);
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(), "turned by %.3g degrees, as the origin's yaw says", origin.theta.degrees());
    notes.emplace_back(text.data());
  }
  map.frame.origin = map.frame.origin + origin.position();
}

}  // namespace

Result<LoadedMap> read_map(const std::filesystem::path& yaml_path) { return read_map(yaml_path, {}); }

Result<LoadedMap> read_map(const std::filesystem::path& yaml_path, const ReadingProgress& progress) {
  if (const auto extension = lower_case(yaml_path.extension().string()); extension == ".pgm" || extension == ".png") {
    const auto beside = std::filesystem::path{yaml_path}.replace_extension(".yaml");
    return fail(yaml_path.string() + ": this is the image of a map; name the YAML file that says its scale" +
                (std::filesystem::exists(beside) ? ", " + beside.string() : ""));
  }
  LoadedMap loaded;
  const auto file = load_first_document(yaml_path, loaded.notes);
  if (!file) return tl::unexpected<Error>(file.error());
  MapYaml yaml;
  if (auto once = keys_stand_once(*file); !once) return tl::unexpected<Error>(once.error());
  const auto unknown = read_yaml_leniently(*file, file->root(), yaml);
  if (!unknown) return tl::unexpected<Error>(unknown.error());
  for (const std::string& key : *unknown) loaded.notes.push_back("key '" + key + "' is not known here, and left out");
  const auto meaning = meaning_of(*file, yaml, loaded.notes);
  if (!meaning) return tl::unexpected<Error>(meaning.error());
  const auto image_path = yaml_path.parent_path() / yaml.image;
  const auto image = open_map_image(image_path);
  if (!image && !std::filesystem::is_regular_file(image_path))
    return tl::unexpected<Error>(file->fault(file->root()["image"], "image " + image.error().message));
  if (!image) return tl::unexpected<Error>(image.error());
  const auto in_image = [&](const Error& error) {
    const bool is_named = error.message.starts_with(image_path.string());
    return tl::unexpected<Error>(is_named ? error : Error{image_path.string() + ":1: " + error.message});
  };
  const auto rows = read_rows(**image, *meaning, progress);
  if (!rows) return in_image(rows.error());
  if (!(*image)->note().empty()) loaded.notes.push_back((*image)->note());
  auto map = grid_of(**image, *rows, *meaning, loaded.notes);
  if (!map) return in_image(map.error());
  loaded.map = std::move(*map);
  place(loaded.map, **image, meaning->origin, loaded.notes);
  return loaded;
}

Result<OccupancyGrid> load_map(const std::filesystem::path& yaml_path) {
  auto loaded = read_map(yaml_path);
  if (!loaded) return tl::unexpected<Error>(loaded.error());
  return std::move(loaded->map);
}

Result<void> save_map(const OccupancyGrid& map, const std::filesystem::path& path_without_extension) {
  const auto name = path_without_extension.filename();
  if (name.empty() || name == "." || name == "..")
    return fail("'" + path_without_extension.string() + "': the map's name is missing: expected FOLDER/NAME");
  std::string pgm = "P5\n" + std::to_string(map.frame.columns) + " " + std::to_string(map.frame.rows) + "\n255\n";
  for (int row = map.frame.rows - 1; row >= 0; --row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      const auto cell = map.cells[map.frame.index({column, row})];
      // The shades of map_server: unknown lies between its thresholds.
      pgm += static_cast<char>(cell < 0 ? 205 : cell >= 65 ? 0 : cell < 20 ? 254 : 255 - (cell * 255 + 50) / 100);
    }
  }
  const auto with = [&](const char* extension) {
    auto path = path_without_extension;
    path += extension;
    return path;
  };
  if (auto written = write_file_atomically(with(".pgm"), pgm); !written) return written;
  YAML::Emitter yaml;
  yaml << YAML::BeginMap;
  yaml << YAML::Key << "image" << YAML::Value << with(".pgm").filename().string();
  yaml << YAML::Key << "resolution" << YAML::Value << map.frame.resolution;
  yaml << YAML::Key << "origin" << YAML::Value << YAML::Flow << YAML::BeginSeq << map.frame.origin.x
       << map.frame.origin.y << 0.0 << YAML::EndSeq;
  yaml << YAML::Key << "negate" << YAML::Value << 0;
  yaml << YAML::Key << "occupied_thresh" << YAML::Value << 0.65;
  yaml << YAML::Key << "free_thresh" << YAML::Value << 0.196;
  yaml << YAML::EndMap;
  return write_file_atomically(with(".yaml"), std::string{yaml.c_str()} + "\n");
}

}  // namespace docent
