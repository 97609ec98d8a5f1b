#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent {

/// The image of a map, read row by row from the top: a huge one is never whole in memory. What a sample says is a share
/// of white, whatever its depth; colours count as the mean of their channels, as in map_server, and neither gamma nor
/// colour profile is applied: those say how a screen shows it.
class MapImage {
 public:
  static constexpr std::uint32_t kClear = std::numeric_limits<std::uint32_t>::max();  ///< less than half opaque

  virtual ~MapImage() = default;
  /// The next row. @param shades  [width], each 0 (black) to white(), or kClear
  [[nodiscard]] virtual Result<void> read_row(std::vector<std::uint32_t>& shades) = 0;

  [[nodiscard]] long width() const { return header.width; }              ///< [pixels]
  [[nodiscard]] long height() const { return header.height; }            ///< [pixels]
  [[nodiscard]] std::uint32_t white() const { return header.white; }     ///< the lightest shade
  [[nodiscard]] const std::string& note() const { return header.note; }  ///< what is odd in the file; empty: nothing

 protected:
  /// What the file says of all rows; whoever opens it fills it in.
  struct Header {
    long width = 0, height = 0;
    std::uint32_t white = 255;
    std::string note;
  } header;
};

/// Opens a PGM (P2, P5) or PNG image, by its content. Faults name file and line, and say of other kinds of images which
/// they are.
[[nodiscard]] Result<std::unique_ptr<MapImage>> open_map_image(const std::filesystem::path& path);

/// The same, of each kind.
[[nodiscard]] Result<std::unique_ptr<MapImage>> open_pgm(const std::filesystem::path& path);
[[nodiscard]] Result<std::unique_ptr<MapImage>> open_png(const std::filesystem::path& path);

}  // namespace docent
