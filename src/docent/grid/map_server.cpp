#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstring>

#include "docent/base/files.h"
#include "docent/base/yaml.h"
#include "docent/grid/occupancy_grid.h"

// Maps as ROS's map_server (ROS 1 and Nav2) reads and writes them: a YAML file that names an image; the image's first
// row is the map's top. In one thing more is known than it makes of them: every map_saver writes 205 of 255 for
// unknown, and Nav2's writes `free_thresh: 0.25` beside it, by which the same picture would come back as one slab of
// free floor.

namespace docent {
namespace {

constexpr long kMostPixels = 400L * 1000L * 1000L;
constexpr std::uint16_t kSaversUnknown = 205;  ///< of a white of 255

struct GreyImage {
  long width = 0;
  long height = 0;
  double white = 255.0;
  std::vector<std::uint16_t> pixels;
  std::vector<bool> is_clear;  ///< not opaque; empty: everything is
};

struct MapYaml {
  std::string image;
  double resolution = 0.0;
  std::vector<double> origin;
  int negate = 0;
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

/// Reads the header of a PGM token by token, knowing the line for faults.
class PgmReader {
 public:
  PgmReader(const std::string& bytes, const std::string& name) : bytes_{bytes}, name_{name} {}

  Result<GreyImage> read() {
    if (bytes_.size() < 2) return fault("not a PGM image: it ends too early");
    const bool is_text = bytes_[1] == '2';
    at_ = 2;
    GreyImage image;
    long white = 0;
    for (long* number : {&image.width, &image.height, &white}) {
      if (!read_number(*number)) return fault("not a PGM image: expected a number in the header");
    }
    if (image.width <= 0 || image.height <= 0 || image.width > kMostPixels / image.height) {
      return fault("PGM of " + std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels");
    }
    if (white <= 0 || white > 65535) return fault("PGM with a white of " + std::to_string(white));
    image.white = static_cast<double>(white);
    const auto count = static_cast<std::size_t>(image.width * image.height);
    if (is_text) {
      if (bytes_.size() - at_ < count) return fault("PGM ends early");
      image.pixels.resize(count);
      for (auto& pixel : image.pixels) {
        long number = 0;
        if (!read_number(number) || number > white) return fault("PGM ends early or holds a value above its white");
        pixel = static_cast<std::uint16_t>(number);
      }
      return image;
    }
    ++at_;  // the one white space behind the header
    const std::size_t width = white > 255 ? 2 : 1;
    if (at_ > bytes_.size() || bytes_.size() - at_ < count * width) {
      return fault("PGM ends early: " + std::to_string(count * width) + " bytes of pixels expected, " +
                   std::to_string(bytes_.size() - std::min(at_, bytes_.size())) + " found");
    }
    image.pixels.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(bytes_[at_ + k]); };
      image.pixels[i] = width == 1 ? byte(i) : static_cast<std::uint16_t>(byte(2 * i) << 8U | byte(2 * i + 1));
    }
    return image;
  }

 private:
  [[nodiscard]] tl::unexpected<Error> fault(const std::string& what) const {
    const auto line =
        1 + std::count(bytes_.begin(), bytes_.begin() + static_cast<long>(std::min(at_, bytes_.size())), '\n');
    return fail(name_ + ":" + std::to_string(line) + ": " + what);
  }
  bool read_number(long& number) {
    while (at_ < bytes_.size()) {
      if (bytes_[at_] == '#') {
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      } else if (std::isspace(static_cast<unsigned char>(bytes_[at_])) != 0) {
        ++at_;
      } else {
        break;
      }
    }
    const std::size_t start = at_;
    number = 0;
    while (at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9' && number < 100000000L) {
      number = number * 10 + (bytes_[at_++] - '0');
    }
    return at_ > start;
  }
  const std::string& bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
};

Result<GreyImage> read_png(const std::string& bytes, const std::string& name) {
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    return fail(name + ":1: not a PNG image: " + png.message);
  }
  if (static_cast<long>(png.width) > kMostPixels / std::max(1L, static_cast<long>(png.height))) {
    png_image_free(&png);
    return fail(name + ":1: PNG too large");
  }
  const bool has_alpha = (png.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  png.format = PNG_FORMAT_GA;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr) == 0) {
    return fail(name + ":1: damaged PNG image: " + png.message);
  }
  GreyImage image;
  image.width = png.width;
  image.height = png.height;
  const std::size_t count = pixels.size() / 2;
  image.pixels.resize(count);
  if (has_alpha) image.is_clear.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    image.pixels[i] = pixels[2 * i];
    if (has_alpha) image.is_clear[i] = pixels[2 * i + 1] != 255;
  }
  return image;
}

/// What a pixel says by the file's mode. What is not opaque is unknown in every mode, as in map_server's `scale`.
std::int8_t cell_of(const MapYaml& yaml, const GreyImage& image, std::size_t pixel) {
  const std::uint16_t value = image.pixels[pixel];
  const double shade = static_cast<double>(value) / image.white;
  const double occupied = yaml.negate == 1 ? shade : 1.0 - shade;
  if (!image.is_clear.empty() && image.is_clear[pixel]) return OccupancyGrid::kUnknown;
  if (yaml.mode == "raw") {
    const long percent = std::lround(shade * 255.0);
    return percent <= OccupancyGrid::kOccupied ? static_cast<std::int8_t>(percent) : OccupancyGrid::kUnknown;
  }
  const bool is_savers_unknown = value == kSaversUnknown && image.white == 255.0 && yaml.negate == 0;
  if (yaml.mode == "trinary" && is_savers_unknown) return OccupancyGrid::kUnknown;
  if (occupied > yaml.occupied_thresh) return OccupancyGrid::kOccupied;
  if (occupied < yaml.free_thresh) return OccupancyGrid::kFree;
  if (yaml.mode == "trinary") return OccupancyGrid::kUnknown;
  const double share = (occupied - yaml.free_thresh) / (yaml.occupied_thresh - yaml.free_thresh);
  return static_cast<std::int8_t>(std::lround(100.0 * share));
}

}  // namespace

Result<OccupancyGrid> load_map(const std::filesystem::path& yaml_path) {
  if (const auto extension = yaml_path.extension(); extension == ".pgm" || extension == ".png") {
    const auto beside = std::filesystem::path{yaml_path}.replace_extension(".yaml");
    return fail(yaml_path.string() + ": this is the image of a map; name the YAML file that says its scale" +
                (std::filesystem::exists(beside) ? ", " + beside.string() : ""));
  }
  const auto file = YamlFile::load(yaml_path);
  if (!file) return tl::unexpected<Error>(file.error());
  MapYaml yaml;
  if (auto read = read_yaml(*file, file->root(), yaml); !read) return tl::unexpected<Error>(read.error());
  const auto fault = [&](const char* key, const std::string& what) {
    return tl::unexpected<Error>(file->fault(file->root()[key], what));
  };
  constexpr double kFinest = 1e-4;   // [m]
  constexpr double kFarthest = 1e7;  // [m] as far as one coordinate goes on Earth
  if (!(yaml.resolution >= kFinest && yaml.resolution < 10.0))
    return fault("resolution", "resolution must be in (0, 10) m");
  if (yaml.origin.size() != 3) return fault("origin", "origin must be [x, y, yaw]");
  if (!(std::abs(yaml.origin[0]) <= kFarthest && std::abs(yaml.origin[1]) <= kFarthest))
    return fault("origin", "origin lies nowhere on Earth");
  if (yaml.origin[2] != 0.0) return fault("origin", "a turned origin (yaw not 0) is not supported");
  if (yaml.negate != 0 && yaml.negate != 1) return fault("negate", "negate must be 0 or 1");
  if (!(0.0 <= yaml.free_thresh && yaml.free_thresh < yaml.occupied_thresh && yaml.occupied_thresh <= 1.0)) {
    return fault("occupied_thresh", "thresholds must hold 0 <= free_thresh < occupied_thresh <= 1");
  }
  if (yaml.mode != "trinary" && yaml.mode != "scale" && yaml.mode != "raw")
    return fault("mode", "mode must be trinary, scale or raw");

  const auto image_path = yaml_path.parent_path() / yaml.image;
  const auto bytes = read_file(image_path);
  if (!bytes) return fault("image", "image " + bytes.error().message);
  const bool is_pgm = bytes->size() > 2 && (*bytes)[0] == 'P' && ((*bytes)[1] == '5' || (*bytes)[1] == '2');
  const auto image = is_pgm ? PgmReader{*bytes, image_path.string()}.read() : read_png(*bytes, image_path.string());
  if (!image) return tl::unexpected<Error>(image.error());

  OccupancyGrid map;
  map.frame = {static_cast<int>(image->width),
               static_cast<int>(image->height),
               yaml.resolution,
               {yaml.origin[0], yaml.origin[1]}};
  map.cells.resize(map.frame.size());
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      const std::size_t from = map.frame.index({column, map.frame.rows - 1 - row});
      map.cells[map.frame.index({column, row})] = cell_of(yaml, *image, from);
    }
  }
  return map;
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
