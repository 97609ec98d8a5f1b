#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"

namespace docent::vision {

/// A picture in shades of grey.
struct GreyPicture {
  int columns = 0;
  int rows = 0;
  std::vector<std::uint8_t> shades;  ///< [rows * columns] from the top left
};

/// A place of a picture [pixels]; the centre of the first pixel is (0.5, 0.5), as AprilTag counts.
struct Pixel {
  double column = 0.0, row = 0.0;
};

struct TagFinderParams {
  double decimate = 1.0;    ///< >= 1: tags are looked for in a picture so much smaller; 2 takes a third of the time and
                            ///< loses a quarter of small tags
  int most_wrong_bits = 1;  ///< 0..2 of a tag's 36
  double least_margin = 5.0;  ///< >= 0 grey levels by which its bits are told apart
  [[nodiscard]] Result<void> validate() const;
};

/// A tag of family 36h11 as it is seen.
struct SeenTag {
  int id = 0;
  std::array<Pixel, 4> corners{};  ///< of the black square: lower left, lower right, upper right, upper left of the tag
  double margin = 0.0;             ///< [grey levels]
};

/// Finds AprilTags of family 36h11 by libapriltag. One thread; the same picture gives the same tags.
class TagFinder {
 public:
  /// @pre params are valid
  explicit TagFinder(const TagFinderParams& params = {});
  TagFinder(TagFinder&&) noexcept;
  TagFinder& operator=(TagFinder&&) noexcept;
  ~TagFinder();

  /// By id, then from left to right. @pre picture has as many shades as pixels
  [[nodiscard]] std::vector<SeenTag> find(const GreyPicture& picture);

 private:
  struct Detector;
  TagFinderParams params_;
  std::unique_ptr<Detector> detector_;
};

}  // namespace docent::vision
