#include "docent/vision/objects/features.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "docent/base/check.h"

namespace docent::vision {
namespace {

constexpr float kBright = 235.0F;      // luminance of what mirrors a lamp,
constexpr float kDark = 60.0F;         // and of what swallows light
constexpr double kPaleGround = 200.0;  // luminance that is taken for the ground's where none is seen

struct FeatureSums {
  double n = 0.0, sum = 0.0, squares = 0.0;
  void add(double value) {
    n += 1.0;
    sum += value;
    squares += value * value;
  }
  [[nodiscard]] double mean() const { return sum / n; }
  [[nodiscard]] double deviation() const { return std::sqrt(std::max(0.0, squares / n - mean() * mean())); }
};

/// @param at  0..1; reorders the values
double quantile(std::vector<float>& values, double at) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(at * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return static_cast<double>(*place);
}

/// How steeply luminance changes at a site, by Sobel's operator; the border counts as doubled.
double slope_at(const Sites& sites, int column, int row) {
  const auto at = [&](int c, int r) {
    return static_cast<double>(
        sites.cells[sites.index(std::clamp(c, 0, sites.columns - 1), std::clamp(r, 0, sites.rows - 1))].luminance);
  };
  double across = 0.0, down = 0.0;
  for (const int k : {-1, 0, 1}) {
    const double weight = k == 0 ? 2.0 : 1.0;
    across += weight * (at(column + 1, row + k) - at(column - 1, row + k));
    down += weight * (at(column + k, row + 1) - at(column + k, row - 1));
  }
  return std::hypot(across, down);
}

}  // namespace

const std::array<const char*, kFeatures>& feature_names() {
  static constexpr std::array<const char*, kFeatures> kNames{"luminance_mean",      "luminance_deviation",
                                                             "red_green_mean",      "yellow_blue_mean",
                                                             "red_green_deviation", "yellow_blue_deviation",
                                                             "saturation_mean",     "saturation_deviation",
                                                             "saturation_high",     "size",
                                                             "elongation",          "width",
                                                             "slope_mean",          "slope_deviation",
                                                             "bright_share",        "dark_share",
                                                             "ground_luminance"};
  return kNames;
}

Features features_of(const Sites& sites, const StandingThing& thing) {
  DOCENT_CHECK(thing.sites > 0);
  constexpr double kFewSides = 0.05;  // of the sites at each side are left out of a thing's width and height
  const bool has_ground = thing.ground_sites > 0;
  const double ground = has_ground ? static_cast<double>(thing.ground.luminance) : kPaleGround;
  FeatureSums luminance, red_green, yellow_blue, saturation, slope;
  std::vector<float> columns, rows, saturations;
  double bright = 0.0, dark = 0.0;
  for (int row = 0; row < sites.rows; ++row) {
    for (int column = 0; column < sites.columns; ++column) {
      const std::size_t i = sites.index(column, row);
      if (!thing.is_thing[i]) continue;
      const Site& site = sites.cells[i];
      const float coloured = std::hypot(site.red_green, site.yellow_blue);
      luminance.add(site.luminance);
      red_green.add(site.red_green);
      yellow_blue.add(site.yellow_blue);
      saturation.add(coloured);
      slope.add(slope_at(sites, column, row));
      saturations.push_back(coloured);
      columns.push_back(static_cast<float>(column));
      rows.push_back(static_cast<float>(row));
      bright += site.luminance > kBright ? 1.0 : 0.0;
      dark += site.luminance < kDark ? 1.0 : 0.0;
    }
  }
  const double width = quantile(columns, 1.0 - kFewSides) - quantile(columns, kFewSides) + 1.0;
  const double height = quantile(rows, 1.0 - kFewSides) - quantile(rows, kFewSides) + 1.0;
  const double all = static_cast<double>(sites.cells.size());
  const double side = std::sqrt(all);
  return {luminance.mean() / ground,
          luminance.deviation(),
          red_green.mean() - static_cast<double>(thing.ground.red_green),
          yellow_blue.mean() - static_cast<double>(thing.ground.yellow_blue),
          red_green.deviation(),
          yellow_blue.deviation(),
          saturation.mean(),
          saturation.deviation(),
          std::log1p(quantile(saturations, 0.9)),
          std::log(luminance.n / all),
          std::log(width / height),
          std::log(width / side),
          std::log1p(slope.mean()),
          std::log1p(slope.deviation()),
          bright / luminance.n,
          dark / luminance.n,
          ground / 255.0};
}

}  // namespace docent::vision
