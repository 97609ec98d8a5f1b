#include "docent/vision/objects/standing_thing.h"

#include <cmath>

namespace docent::vision {
namespace {

bool is_ground(const Region& region, double border, const GroundParams& params) {
  return region.mean.luminance >= params.least_luminance &&
         std::hypot(region.mean.red_green, region.mean.yellow_blue) <= params.most_coloured &&
         region.inhomogeneity <= params.most_uneven &&
         static_cast<double>(region.at_border) >= params.least_of_border * border;
}

}  // namespace

StandingThing part_from_ground(const Sites& sites, const Segmentation& regions, const GroundParams& params) {
  const double border = 2.0 * (sites.columns + sites.rows) - 4.0;
  std::vector<bool> is_part_of_ground;
  for (const Region& region : regions.regions) is_part_of_ground.push_back(is_ground(region, border, params));
  StandingThing thing{std::vector<bool>(sites.cells.size()), 0, {}, 0};
  double luminance = 0.0, red_green = 0.0, yellow_blue = 0.0;
  for (std::size_t i = 0; i < sites.cells.size(); ++i) {
    if (!is_part_of_ground[static_cast<std::size_t>(regions.of[i])]) {
      thing.is_thing[i] = true;
      ++thing.sites;
      continue;
    }
    ++thing.ground_sites;
    luminance += sites.cells[i].luminance;
    red_green += sites.cells[i].red_green;
    yellow_blue += sites.cells[i].yellow_blue;
  }
  if (thing.ground_sites > 0) {
    const double share = 1.0 / static_cast<double>(thing.ground_sites);
    thing.ground = {static_cast<float>(share * luminance), static_cast<float>(share * red_green),
                    static_cast<float>(share * yellow_blue)};
  }
  if (static_cast<double>(thing.sites) < params.least_of_picture * static_cast<double>(sites.cells.size())) {
    thing.is_thing.assign(sites.cells.size(), true);  // nothing stands out: a thing as pale as the ground
    thing.sites = sites.cells.size();
  }
  return thing;
}

}  // namespace docent::vision
