#include "docent/vision/scene/floor_colours.h"

#include <algorithm>
#include <cmath>

#include "docent/base/check.h"

namespace docent::vision {
namespace {

// The bins were chosen on frames of one kitchen: half as wide or twice as wide they do nearly as well.
constexpr float kLuminanceBin = 12.0F;                         // grey levels
constexpr float kColourBins = 20.0F;                           // for a colour as strong as the luminance
constexpr float kDarkest = 15.0F;                              // grey levels below which colours are noise
constexpr float kRoughnessBins = 1.6F;                         // for a root of a grey level
constexpr float kRare = 2e-6F;                                 // share of a class that says nothing
constexpr float kMostOdds = 5.0F;                              // one site never decides
constexpr std::array<float, 4> kBlur{1.0F, 0.7F, 0.7F, 0.7F};  // bins, standard deviation

int clamped_bin(float value, int bins) { return std::clamp(static_cast<int>(std::floor(value)), 0, bins - 1); }

/// Gaussian along one dimension of a histogram; what would leave it stays at its end.
void blur_along(std::vector<float>& histogram, int bins, std::size_t stride, float deviation) {
  constexpr int kReach = 3;
  std::array<float, 2 * kReach + 1> kernel{};
  float sum = 0.0F;
  for (int i = -kReach; i <= kReach; ++i) {
    const float weight = std::exp(-0.5F * static_cast<float>(i * i) / (deviation * deviation));
    kernel[static_cast<std::size_t>(i + kReach)] = weight;
    sum += weight;
  }
  std::vector<float> line(static_cast<std::size_t>(bins));
  for (std::size_t first = 0; first < histogram.size(); ++first) {
    if (first / stride % static_cast<std::size_t>(bins) != 0) continue;
    for (int i = 0; i < bins; ++i) {
      float value = 0.0F;
      for (int k = -kReach; k <= kReach; ++k) {
        const auto from = static_cast<std::size_t>(std::clamp(i + k, 0, bins - 1));
        value += kernel[static_cast<std::size_t>(k + kReach)] * histogram[first + from * stride];
      }
      line[static_cast<std::size_t>(i)] = value / sum;
    }
    for (std::size_t i = 0; i < line.size(); ++i) histogram[first + i * stride] = line[i];
  }
}

}  // namespace

RoughSites rough_sites_of(const pictures::Image& picture, int block) {
  RoughSites seen{sites_of(picture, block), {}};
  seen.roughness.reserve(seen.sites.cells.size());
  const auto bytes = picture.bytes();
  const float count = static_cast<float>(block * block);
  for (int row = 0; row < seen.sites.rows; ++row) {
    for (int column = 0; column < seen.sites.columns; ++column) {
      float squares = 0.0F;
      const float mean = seen.sites.cells[seen.sites.index(column, row)].luminance;
      for (int y = row * block; y < (row + 1) * block; ++y) {
        const std::uint8_t* pixel =
            &bytes[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width()) +
                        static_cast<std::size_t>(column * block))];
        for (int x = 0; x < block; ++x, pixel += 4) {
          const float off = static_cast<float>(pixel[0] + pixel[1] + pixel[2]) / 3.0F - mean;
          squares += off * off;
        }
      }
      seen.roughness.push_back(std::sqrt(squares / count));
    }
  }
  return seen;
}

FloorColours::FloorColours() {
  std::size_t bins = 1;
  for (const int side : kBins) bins *= static_cast<std::size_t>(side);
  for (auto& histogram : histograms_) histogram.assign(bins, 0.0F);
}

std::size_t FloorColours::bin_of(const Site& site, float roughness) {
  const float scale = kColourBins / std::max(site.luminance, kDarkest);
  const std::array<int, 4> at{
      clamped_bin(site.luminance / kLuminanceBin, kBins[0]),
      clamped_bin(site.red_green * scale + 0.36F * static_cast<float>(kBins[1]), kBins[1]),
      clamped_bin(site.yellow_blue * scale + 0.36F * static_cast<float>(kBins[2]), kBins[2]),
      clamped_bin(std::sqrt(roughness) * kRoughnessBins, kBins[3]),
  };
  std::size_t bin = 0;
  for (std::size_t k = 0; k < at.size(); ++k)
    bin = bin * static_cast<std::size_t>(kBins[k]) + static_cast<std::size_t>(at[k]);
  return bin;
}

void FloorColours::learn(const RoughSites& seen, const std::vector<SiteKind>& kinds) {
  DOCENT_CHECK(kinds.size() == seen.sites.cells.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] == SiteKind::unknown) continue;
    const std::size_t which = kinds[i] == SiteKind::floor ? 1 : 0;
    histograms_[which][bin_of(seen.sites.cells[i], seen.roughness[i])] += 1.0F;
    counts_[which] += 1.0;
  }
}

void FloorColours::finish() {
  std::array<std::vector<float>, 2> blurred = histograms_;
  for (auto& histogram : blurred) {
    std::size_t stride = 1;
    for (std::size_t k = kBins.size(); k-- > 0;) {
      blur_along(histogram, kBins[k], stride, kBlur[k]);
      stride *= static_cast<std::size_t>(kBins[k]);
    }
  }
  log_odds_.resize(blurred[0].size());
  const auto other = static_cast<float>(std::max(1.0, counts_[0])),
             floor = static_cast<float>(std::max(1.0, counts_[1]));
  for (std::size_t i = 0; i < log_odds_.size(); ++i)
    log_odds_[i] =
        std::clamp(std::log((blurred[1][i] / floor + kRare) / (blurred[0][i] / other + kRare)), -kMostOdds, kMostOdds);
}

float FloorColours::log_odds(const Site& site, float roughness) const {
  DOCENT_CHECK(!log_odds_.empty());
  return log_odds_[bin_of(site, roughness)];
}

}  // namespace docent::vision
