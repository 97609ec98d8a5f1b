#include "docent/vision/objects/seen_picture.h"

#include <algorithm>

#include "docent/vision/regions/region_merging.h"

namespace docent::vision {
namespace {

constexpr double kFineRegions = 3000.0;  // RegionMergingParams::a_region: a clear bottle is hardly unlike its ground

}  // namespace

SeenPicture see(const pictures::Image& picture) {
  SeenPicture seen;
  seen.sites = sites_of(picture, std::max(1, std::max(picture.width(), picture.height()) / kSitesAcross));
  seen.thing = part_from_ground(seen.sites, merge_regions(seen.sites, {.a_region = kFineRegions}));
  seen.features = features_of(seen.sites, seen.thing);
  return seen;
}

}  // namespace docent::vision
