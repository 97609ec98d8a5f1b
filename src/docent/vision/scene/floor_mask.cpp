#include "docent/vision/scene/floor_mask.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace docent::vision {
namespace {

/// Gaussian both ways; what lies outside is as the border.
std::vector<float> blurred(std::vector<float> values, int columns, int rows, double deviation) {
  const int reach = std::max(1, static_cast<int>(std::ceil(3.0 * deviation)));
  std::vector<float> kernel;
  float sum = 0.0F;
  for (int i = -reach; i <= reach; ++i) {
    kernel.push_back(static_cast<float>(std::exp(-0.5 * i * i / (deviation * deviation))));
    sum += kernel.back();
  }
  std::vector<float> result(values.size());
  for (const bool is_across : {true, false}) {
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        float value = 0.0F;
        for (int k = -reach; k <= reach; ++k) {
          const int x = is_across ? std::clamp(column + k, 0, columns - 1) : column;
          const int y = is_across ? row : std::clamp(row + k, 0, rows - 1);
          value += kernel[static_cast<std::size_t>(k + reach)] * values[static_cast<std::size_t>(y * columns + x)];
        }
        result[static_cast<std::size_t>(row * columns + column)] = value / sum;
      }
    }
    std::swap(values, result);
  }
  return values;
}

using Part = std::vector<int>;  // sites

/// Connected parts of what is marked, the largest first; equal ones in the order of their first sites.
std::vector<Part> parts_of(const std::vector<unsigned char>& marked, int columns, int rows) {
  std::vector<Part> parts;
  std::vector<unsigned char> is_left = marked;
  for (int first = 0; first < columns * rows; ++first) {
    if (is_left[static_cast<std::size_t>(first)] == 0) continue;
    Part part{first};
    is_left[static_cast<std::size_t>(first)] = 0;
    for (std::size_t next = 0; next < part.size(); ++next) {
      const int column = part[next] % columns, row = part[next] / columns;
      const auto take = [&](int x, int y) {
        if (x < 0 || y < 0 || x >= columns || y >= rows) return;
        unsigned char& left = is_left[static_cast<std::size_t>(y * columns + x)];
        if (left != 0) part.push_back(y * columns + x);
        left = 0;
      };
      take(column - 1, row);
      take(column + 1, row);
      take(column, row - 1);
      take(column, row + 1);
    }
    parts.push_back(std::move(part));
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.size() > b.size(); });
  return parts;
}

/// The share of a part's columns in which floor that is kept already lies below it.
double shaded_share(const Part& part, const FloorMask& mask) {
  std::vector<int> lowest(static_cast<std::size_t>(mask.columns), -1);
  for (const int site : part) {
    int& low = lowest[static_cast<std::size_t>(site % mask.columns)];
    low = std::max(low, site / mask.columns);
  }
  int columns = 0, shaded = 0;
  for (int column = 0; column < mask.columns; ++column) {
    const int low = lowest[static_cast<std::size_t>(column)];
    if (low < 0) continue;
    ++columns;
    for (int row = low + 1; row < mask.rows; ++row) {
      if (mask.is_floor[mask.index(column, row)] == 0) continue;
      ++shaded;
      break;
    }
  }
  return static_cast<double>(shaded) / columns;
}

}  // namespace

Result<void> FloorMaskParams::validate() const {
  if (!(blur > 0.0 && blur <= 10.0)) return fail("floor mask: blur must be in (0, 10]");
  if (!std::isfinite(least_odds)) return fail("floor mask: least_odds must be finite");
  if (!(reach > 0.0)) return fail("floor mask: reach must be > 0");
  if (!(least_sites >= 1)) return fail("floor mask: least_sites must be >= 1");
  if (!(shaded >= 0.0 && shaded <= 1.0)) return fail("floor mask: shaded must be in 0..1");
  return {};
}

std::vector<unsigned char> below_horizon(const Sites& sites, const DepthCamera& camera, double reach) {
  std::vector<unsigned char> may_be(sites.cells.size(), 0);
  const Eigen::Matrix3d turn = camera.base_from_camera();
  for (int row = 0; row < sites.rows; ++row) {
    for (int column = 0; column < sites.columns; ++column) {
      const double x = (column + 0.5) * sites.block - 0.5, y = (row + 0.5) * sites.block - 0.5;
      const double rising = turn(2, 0) * (x - camera.centre_x) + turn(2, 1) * (y - camera.centre_y);
      const double sinking = -rising / camera.focal - turn(2, 2);
      if (sinking * reach > camera.mount.z) may_be[sites.index(column, row)] = 1;
    }
  }
  return may_be;
}

FloorMask find_floor(const RoughSites& seen, const FloorColours& colours, const DepthCamera& camera,
                     const FloorMaskParams& params) {
  const Sites& sites = seen.sites;
  FloorMask mask{sites.columns, sites.rows, sites.block, std::vector<unsigned char>(sites.cells.size(), 0), {}};
  std::vector<unsigned char> may_be = below_horizon(sites, camera, params.reach);
  std::vector<float> odds(sites.cells.size(), 0.0F);
  for (std::size_t i = 0; i < odds.size(); ++i)
    if (may_be[i] != 0) odds[i] = colours.log_odds(sites.cells[i], seen.roughness[i]);
  odds = blurred(std::move(odds), sites.columns, sites.rows, params.blur);
  for (std::size_t i = 0; i < odds.size(); ++i)
    if (!(odds[i] > static_cast<float>(params.least_odds))) may_be[i] = 0;
  for (const Part& part : parts_of(may_be, sites.columns, sites.rows)) {
    if (part.size() < static_cast<std::size_t>(params.least_sites)) break;
    if (shaded_share(part, mask) >= params.shaded) continue;
    for (const int site : part) mask.is_floor[static_cast<std::size_t>(site)] = 1;
  }
  mask.odds = std::move(odds);
  return mask;
}

}  // namespace docent::vision
