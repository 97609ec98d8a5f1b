#pragma once

#include <cstddef>
#include <vector>

#include "docent/base/result.h"
#include "docent/vision/regions/sites.h"

namespace docent::vision {

struct RegionMergingParams {
  double luminance = 1.0;     ///< weight of the square of a difference in luminance,
  double colour = 2.0;        ///< and of one in the opponent colours: shadows change the former alone
  double most_unlike = 2500;  ///< [square of grey levels] sites differ by this at most: what is small joins its
                              ///< surroundings, however unlike it is
  double a_region = 40000;    ///< [likewise] that each region costs: the more, the fewer regions
  [[nodiscard]] Result<void> validate() const;
};

/// A connected part of a picture that looks much the same all over.
struct Region {
  std::size_t sites = 0;
  Site mean;
  double inhomogeneity = 0.0;  ///< [square of grey levels] mean weighted square of its sites' differences from the mean
  int first_column = 0, last_column = 0, first_row = 0, last_row = 0;  ///< around it, both ends included
  std::size_t at_border = 0;                                           ///< of its sites lie at the picture's border
};

struct Segmentation {
  int columns = 0;
  int rows = 0;
  std::vector<int> of;          ///< [rows * columns] index of each site's region
  std::vector<Region> regions;  ///< the largest first
};

/// Divides a picture into homogeneous connected regions by merging neighbours, the second stage of [Buhmann1995]: of all
/// partitions it looks for the one with the least sum of the regions' inhomogeneities and of what each region costs.
/// Two neighbours A and B are merged where the costs after are less: where n_A n_B / (n_A + n_B) min(d², most_unlike) <
/// a_region, d the weighted difference of their means; the pair that saves most first. Equal pairs in the order of
/// their places: deterministic. O(n log n) in sites.
[[nodiscard]] Segmentation merge_regions(const Sites& sites, const RegionMergingParams& params = {});

}  // namespace docent::vision
