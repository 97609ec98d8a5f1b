#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "docent/vision/regions/sites.h"

namespace docent::vision {

/// A picture in blocks, with how rough each block is.
struct RoughSites {
  Sites sites;
  std::vector<float> roughness;  ///< [rows * columns] standard deviation of the block's luminance
};

/// @pre 1 <= block <= the shorter side of the picture. O(pixels)
[[nodiscard]] RoughSites rough_sites_of(const pictures::Image& picture, int block);

/// What is known of a site while the robot learns.
enum class SiteKind : unsigned char { unknown, floor, other };

/// How the floor of this building looks beside all else: histograms over luminance, two colours relative to it (shadows
/// change luminance alone) and roughness. Learned where something else tells floor from what is none, such as a depth
/// camera; used where nothing does. Deterministic.
class FloorColours {
 public:
  FloorColours();

  /// @param kinds  [rows * columns]. O(sites)
  void learn(const RoughSites& seen, const std::vector<SiteKind>& kinds);
  /// After the last `learn` and before the first `log_odds`. O(bins)
  void finish();
  /// Of floor against all else, by the looks of a site alone; between -most and most. @pre finished
  [[nodiscard]] float log_odds(const Site& site, float roughness) const;
  [[nodiscard]] bool is_empty() const { return counts_[0] == 0.0 || counts_[1] == 0.0; }

 private:
  static constexpr std::array<int, 4> kBins{21, 28, 28, 10};
  [[nodiscard]] static std::size_t bin_of(const Site& site, float roughness);
  std::array<std::vector<float>, 2> histograms_;  ///< of all else and of floor, [bins]
  std::array<double, 2> counts_{};
  std::vector<float> log_odds_;  ///< [bins]
};

}  // namespace docent::vision
