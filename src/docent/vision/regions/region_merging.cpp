#include "docent/vision/regions/region_merging.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

namespace docent::vision {
namespace {

/// Sums over the sites of a region that tell its mean and its inhomogeneity.
struct Sums {
  double n = 0.0;
  double luminance = 0.0, red_green = 0.0, yellow_blue = 0.0;
  double squares = 0.0;  ///< weighted

  void add(const Sums& other) {
    n += other.n;
    luminance += other.luminance;
    red_green += other.red_green;
    yellow_blue += other.yellow_blue;
    squares += other.squares;
  }
};

class Merger {
 public:
  Merger(const Sites& sites, const RegionMergingParams& params) : sites_{sites}, params_{params} {
    for (const Site& site : sites.cells) {
      const double l = site.luminance, r = site.red_green, y = site.yellow_blue;
      sums_.push_back({1.0, l, r, y, params.luminance * l * l + params.colour * (r * r + y * y)});
    }
    const std::size_t count = sums_.size();
    next_.resize(count);
    std::iota(next_.begin(), next_.end(), std::size_t{0});
    version_.assign(count, 0);
    neighbours_.resize(count);
    for (int row = 0; row < sites.rows; ++row) {
      for (int column = 0; column < sites.columns; ++column) {
        const std::size_t here = sites.index(column, row);
        if (column + 1 < sites.columns) touch(here, here + 1);
        if (row + 1 < sites.rows) touch(here, sites.index(column, row + 1));
      }
    }
  }

  void merge_all() {
    while (!queue_.empty()) {
      const Pair best = queue_.top();
      queue_.pop();
      if (version_[best.a] != best.version_a || version_[best.b] != best.version_b) continue;
      merge(best.a, best.b);
    }
  }

  /// The region that a site is in now.
  std::size_t root_of(std::size_t site) {
    while (next_[site] != site) site = next_[site] = next_[next_[site]];
    return site;
  }
  [[nodiscard]] const Sums& sums(std::size_t root) const { return sums_[root]; }

 private:
  struct Pair {
    double change = 0.0;  ///< of the costs
    double n = 0.0;       ///< sites of both: of pairs that save as much the smaller is merged first, so that even
                          ///< ground does not grow site by site
    std::size_t a = 0, b = 0;
    int version_a = 0, version_b = 0;
    /// Of two pairs the one that is merged later.
    bool operator<(const Pair& other) const {
      if (change != other.change) return change > other.change;
      if (n != other.n) return n > other.n;
      return std::pair{a, b} > std::pair{other.a, other.b};
    }
  };

  [[nodiscard]] double change_of(const Sums& a, const Sums& b) const {
    const double l = a.luminance / a.n - b.luminance / b.n;
    const double r = a.red_green / a.n - b.red_green / b.n;
    const double y = a.yellow_blue / a.n - b.yellow_blue / b.n;
    const double unlike = params_.luminance * l * l + params_.colour * (r * r + y * y);
    return a.n * b.n / (a.n + b.n) * std::min(unlike, params_.most_unlike) - params_.a_region;
  }
  void touch(std::size_t a, std::size_t b) {
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
    offer(a, b);
  }
  void offer(std::size_t a, std::size_t b) {
    if (b < a) std::swap(a, b);
    const double change = change_of(sums_[a], sums_[b]);
    if (change < 0.0) queue_.push({change, sums_[a].n + sums_[b].n, a, b, version_[a], version_[b]});
  }
  void merge(std::size_t a, std::size_t b) {
    if (neighbours_[a].size() < neighbours_[b].size()) std::swap(a, b);
    next_[b] = a;
    sums_[a].add(sums_[b]);
    ++version_[a];
    ++version_[b];
    std::vector<std::size_t>& around = neighbours_[a];
    around.insert(around.end(), neighbours_[b].begin(), neighbours_[b].end());
    neighbours_[b] = {};
    for (std::size_t& other : around) other = root_of(other);
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    std::erase(around, a);
    for (const std::size_t other : around) offer(a, other);
  }

  const Sites& sites_;
  const RegionMergingParams params_;
  std::vector<Sums> sums_;         ///< [sites] of the regions' roots
  std::vector<std::size_t> next_;  ///< [sites] towards the root
  std::vector<int> version_;       ///< [sites] how often a root has changed
  std::vector<std::vector<std::size_t>>
      neighbours_;  ///< [sites] of the roots; some stand for what they were merged into
  std::priority_queue<Pair> queue_;
};

}  // namespace

Result<void> RegionMergingParams::validate() const {
  if (!(luminance >= 0.0 && colour >= 0.0 && luminance + colour > 0.0))
    return fail("regions: luminance and colour must be >= 0, and not both 0");
  if (!(most_unlike > 0.0)) return fail("regions: most_unlike must be > 0");
  if (!(a_region > 0.0)) return fail("regions: a_region must be > 0");
  return {};
}

Segmentation merge_regions(const Sites& sites, const RegionMergingParams& params) {
  Merger merger{sites, params};
  merger.merge_all();
  std::map<std::size_t, Region> by_root;
  std::vector<std::size_t> roots(sites.cells.size());
  for (int row = 0; row < sites.rows; ++row) {
    for (int column = 0; column < sites.columns; ++column) {
      const std::size_t site = sites.index(column, row);
      const std::size_t root = roots[site] = merger.root_of(site);
      const auto [place, is_new] = by_root.try_emplace(root);
      Region& region = place->second;
      if (is_new) {
        region.first_column = region.last_column = column;
        region.first_row = row;
      }
      ++region.sites;
      region.first_column = std::min(region.first_column, column);
      region.last_column = std::max(region.last_column, column);
      region.last_row = row;
      if (row == 0 || column == 0 || row + 1 == sites.rows || column + 1 == sites.columns) ++region.at_border;
    }
  }
  std::vector<std::pair<std::size_t, Region>> ordered(by_root.begin(), by_root.end());
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const auto& a, const auto& b) { return a.second.sites > b.second.sites; });
  Segmentation result{sites.columns, sites.rows, std::vector<int>(roots.size()), {}};
  std::map<std::size_t, int> number_of;
  for (auto& [root, region] : ordered) {
    const Sums& sums = merger.sums(root);
    const double l = sums.luminance / sums.n, r = sums.red_green / sums.n, y = sums.yellow_blue / sums.n;
    region.mean = {static_cast<float>(l), static_cast<float>(r), static_cast<float>(y)};
    region.inhomogeneity =
        std::max(0.0, sums.squares / sums.n - params.luminance * l * l - params.colour * (r * r + y * y));
    number_of[root] = static_cast<int>(result.regions.size());
    result.regions.push_back(region);
  }
  for (std::size_t i = 0; i < roots.size(); ++i) result.of[i] = number_of[roots[i]];
  return result;
}

}  // namespace docent::vision
