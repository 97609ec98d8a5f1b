#include "docent/vision/ceiling/height_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace docent::vision {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr float kLeastPictures = 4.0F;  // that see a cell
constexpr int kRounds = 8;              // in which cells listen to their neighbours
constexpr double kFewLooks = 30.0;      // degrees of freedom of a variance that is half believed
constexpr float kBelieved = -0.3F;      // [nat] by which the best height must lie below the middle one
constexpr float kFarBetter = -0.45F;    // [nat] from which a height explains a cell far better than another
constexpr std::size_t kMostParts = 16;
constexpr float kNeighbour = 0.25F;  // [nat] that a neighbour of another part costs, and
constexpr float kOther = 0.15F;      // that not being of the main part costs

/// A picture without what is slow in it: less what it shows round each block on the average. So neither the light of a
/// picture nor that which a lens loses towards the rim makes heights differ.
class SharpPicture {
 public:
  explicit SharpPicture(const ShrunkPicture& picture)
      : columns_{picture.columns()}, rows_{picture.rows()}, block_{picture.block()} {
    const int reach = std::max(2, columns_ / kSlow);
    const auto width = static_cast<std::size_t>(columns_) + 1;
    std::vector<double> sums(width * (static_cast<std::size_t>(rows_) + 1));
    const auto at = [&](int column, int row) -> double& {
      return sums[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)];
    };
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column)
        at(column + 1, row + 1) =
            at(column, row + 1) + at(column + 1, row) - at(column, row) + static_cast<double>(picture.at(column, row));
    values_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (int row = 0; row < rows_; ++row) {
      const int low = std::max(0, row - reach), high = std::min(rows_, row + reach + 1);
      for (int column = 0; column < columns_; ++column) {
        const int left = std::max(0, column - reach), right = std::min(columns_, column + reach + 1);
        const double sum = at(right, high) - at(left, high) - at(right, low) + at(left, low);
        values_.push_back(picture.at(column, row) - static_cast<float>(sum / ((right - left) * (high - low))));
      }
    }
  }
  /// Between blocks; false outside. @param x, y  [pixels of the whole picture]
  [[nodiscard]] bool look(double x, double y, float& value) const {
    const double u = (x - 0.5 * (block_ - 1)) / block_, v = (y - 0.5 * (block_ - 1)) / block_;
    if (!(u >= 0.0 && v >= 0.0 && u < columns_ - 1 && v < rows_ - 1)) return false;  // NaN neither
    const int column = static_cast<int>(u), row = static_cast<int>(v);
    const auto s = static_cast<float>(u - column), t = static_cast<float>(v - row);
    const float* cell =
        &values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)];
    value =
        (1.0F - t) * ((1.0F - s) * cell[0] + s * cell[1]) + t * ((1.0F - s) * cell[columns_] + s * cell[columns_ + 1]);
    return true;
  }

 private:
  static constexpr int kSlow = 6;  // so many windows lie beside one another across the picture, about
  int columns_, rows_, block_;
  std::vector<float> values_;
};

/// What the pictures show at the cells at one height.
struct Shown {
  std::vector<float> sums, squares, counts;
};

Shown shown_at(const GridFrame& cells, const CeilingCamera& camera, std::span<const SharpPicture> pictures,
               std::span<const PictureUnknowns> unknowns, double height, const HeightSweepParams& params,
               std::size_t stride, double farthest) {
  Shown shown{std::vector<float>(cells.size()), std::vector<float>(cells.size()), std::vector<float>(cells.size())};
  const double above = height - camera.mount.position.z();
  const double reach = std::min(farthest, params.steepest * above);
  for (std::size_t n = 0; n < pictures.size(); n += stride) {
    const auto& unknown = unknowns[n];
    const Pose2 map_from_robot{unknown.pose[0], unknown.pose[1], Angle::radians(unknown.pose[2])};
    const Pose2 robot_from_map = inverse(map_from_robot);
    const Point2 lens = map_from_robot * Point2{camera.mount.position.x(), camera.mount.position.y()};
    const auto darker = static_cast<float>(std::exp(-unknown.light[0]));
    const CellIndex low = cells.cell_at(lens - Point2{reach, reach}), high = cells.cell_at(lens + Point2{reach, reach});
    for (int row = std::max(0, low.row); row <= std::min(cells.rows - 1, high.row); ++row) {
      for (int column = std::max(0, low.column); column <= std::min(cells.columns - 1, high.column); ++column) {
        const Point2 centre = cells.centre({column, row});
        if (distance(centre, lens) > reach) continue;
        const auto pixel = camera.pixel_of(robot_from_map * centre, height);
        float value = 0.0F;
        if (!pixel || !pictures[n].look(pixel->x(), pixel->y(), value)) continue;
        const std::size_t cell = cells.index({column, row});
        const float as_bright = value * darker;
        shown.sums[cell] += as_bright, shown.squares[cell] += as_bright * as_bright, shown.counts[cell] += 1.0F;
      }
    }
  }
  return shown;
}

/// Sums over squares of cells, each in constant time.
class SummedArea {
 public:
  /// @param value_of  of a cell's index
  template <typename ValueOf>
  SummedArea(const GridFrame& cells, const ValueOf& value_of)
      : columns_{static_cast<std::size_t>(cells.columns)},
        rows_{static_cast<std::size_t>(cells.rows)},
        sums_((columns_ + 1) * (rows_ + 1)) {
    for (std::size_t row = 0; row < rows_; ++row)
      for (std::size_t column = 0; column < columns_; ++column)
        at(column + 1, row + 1) =
            at(column, row + 1) + at(column + 1, row) - at(column, row) + value_of(row * columns_ + column);
  }
  [[nodiscard]] double round(std::size_t column, std::size_t row, std::size_t reach) const {
    const std::size_t left = column > reach ? column - reach : 0, right = std::min(columns_, column + reach + 1);
    const std::size_t low = row > reach ? row - reach : 0, high = std::min(rows_, row + reach + 1);
    return at(right, high) - at(left, high) - at(right, low) + at(left, low);
  }

 private:
  [[nodiscard]] double at(std::size_t column, std::size_t row) const { return sums_[row * (columns_ + 1) + column]; }
  double& at(std::size_t column, std::size_t row) { return sums_[row * (columns_ + 1) + column]; }
  std::size_t columns_, rows_;
  std::vector<double> sums_;
};

/// How well one height explains each cell.
struct HeightCost {
  std::vector<float> nats;      ///< <= 0 about; 0 tells nothing, kNone where too few pictures see it
  std::vector<float> variance;  ///< of what the pictures show at one place, round the cell
};

/// Round each cell: ln of the variance of what pictures show of one place, over that of all that they show there. What
/// is flat has neither, and tells nothing, whatever the height: heights at which the pictures look at one place from
/// hardly different sides are no better for it.
HeightCost cost_of(const GridFrame& cells, const Shown& shown, int reach, double texture, double few_looks) {
  const auto is_known = [&](std::size_t i) { return shown.counts[i] >= kLeastPictures; };
  const SummedArea counts{cells,
                          [&](std::size_t i) { return is_known(i) ? static_cast<double>(shown.counts[i]) : 0.0; }};
  const SummedArea places{cells, [&](std::size_t i) { return is_known(i) ? 1.0 : 0.0; }};
  const SummedArea sums{cells, [&](std::size_t i) { return is_known(i) ? static_cast<double>(shown.sums[i]) : 0.0; }};
  const SummedArea squares{cells,
                           [&](std::size_t i) { return is_known(i) ? static_cast<double>(shown.squares[i]) : 0.0; }};
  const SummedArea of_means{cells, [&](std::size_t i) {
                              const auto sum = static_cast<double>(shown.sums[i]);
                              return is_known(i) ? sum * sum / static_cast<double>(shown.counts[i]) : 0.0;
                            }};
  HeightCost cost{std::vector<float>(cells.size(), kNone), std::vector<float>(cells.size(), kNone)};
  for (int row = 0; row < cells.rows; ++row)
    for (int column = 0; column < cells.columns; ++column) {
      const std::size_t cell = cells.index({column, row});
      if (!is_known(cell)) continue;
      const auto round = [&](const SummedArea& of) {
        return of.round(static_cast<std::size_t>(column), static_cast<std::size_t>(row),
                        static_cast<std::size_t>(reach));
      };
      const double n = round(counts), sum = round(sums), square = round(squares);
      const double of_place = std::max(0.0, square - round(of_means)) / (n - round(places));
      const double of_all = std::max(0.0, square - sum * sum / n) / (n - 1.0);
      const double noise = texture * texture;
      const double free = n - round(places);  // degrees of freedom
      cost.nats[cell] = static_cast<float>(free / (free + few_looks) * std::log((of_place + noise) / (of_all + noise)));
      cost.variance[cell] = static_cast<float>(of_place);
    }
  return cost;
}

using HeightCosts = std::vector<HeightCost>;

/// The height that most cells choose; nothing where none has texture.
std::optional<std::size_t> main_height(const HeightCosts& costs, const std::vector<double>& heights,
                                       const HeightSweepParams& params) {
  std::vector<double> support(heights.size());
  for (std::size_t cell = 0; cell < costs.front().nats.size(); ++cell) {
    std::vector<float> known;
    std::size_t best = 0;
    float least = kNone;
    for (std::size_t h = 0; h < heights.size(); ++h) {
      const float cost = costs[h].nats[cell];
      if (cost == kNone) continue;
      known.push_back(cost);
      if (cost < least) least = cost, best = h;
    }
    if (known.size() < 3) continue;
    std::nth_element(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2), known.end());
    if (least < kBelieved + known[known.size() / 2]) support[best] += params.cell * params.cell;
  }
  std::optional<std::size_t> found;
  double most = params.smallest;
  for (std::size_t h = 0; h < heights.size(); ++h) {
    double sum = 0.0;
    for (std::size_t k = 0; k < heights.size(); ++k)
      if (std::abs(std::log(heights[h] / heights[k])) < 0.5 * params.same) sum += support[k];
    if (sum > most) most = sum, found = h;
  }
  return found;
}

/// The largest connected set of marked cells. @returns how many, and their gain
std::pair<std::size_t, double> largest_patch(const GridFrame& cells, const std::vector<float>& gains) {
  std::vector<bool> seen(gains.size());
  std::vector<std::size_t> open;
  std::pair<std::size_t, double> largest{};
  for (std::size_t start = 0; start < gains.size(); ++start) {
    if (seen[start] || gains[start] <= 0.0F) continue;
    std::pair<std::size_t, double> patch{};
    open.assign(1, start);
    seen[start] = true;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      ++patch.first;
      patch.second += static_cast<double>(gains[at]);
      const CellIndex cell{static_cast<int>(at % static_cast<std::size_t>(cells.columns)),
                           static_cast<int>(at / static_cast<std::size_t>(cells.columns))};
      for (const CellIndex step : {CellIndex{1, 0}, CellIndex{-1, 0}, CellIndex{0, 1}, CellIndex{0, -1}}) {
        const CellIndex beside{cell.column + step.column, cell.row + step.row};
        if (!cells.holds(beside)) continue;
        const std::size_t next = cells.index(beside);
        if (seen[next] || gains[next] <= 0.0F) continue;
        seen[next] = true;
        open.push_back(next);
      }
    }
    if (patch.first > largest.first) largest = patch;
  }
  return largest;
}

/// Heights of parts in ascending order: the main one, then each that explains a patch of cells far better than those
/// before.
std::vector<double> heights_of_parts(const GridFrame& cells, const HeightCosts& costs,
                                     const std::vector<double>& heights, const HeightSweepParams& params) {
  const auto main = main_height(costs, heights, params);
  if (!main) return {};
  std::vector<double> found{heights[*main]};
  std::vector<float> best = costs[*main].nats, gains(best.size());
  while (found.size() < kMostParts) {
    std::size_t next = 0;
    double most = 0.0;
    for (std::size_t h = 0; h < heights.size(); ++h) {
      const auto same = [&](double other) { return std::abs(std::log(heights[h] / other)) < params.same; };
      if (std::any_of(found.begin(), found.end(), same)) continue;
      for (std::size_t i = 0; i < gains.size(); ++i) {
        const float cost = costs[h].nats[i];
        const float gain = best[i] == kNone || cost == kNone ? 0.0F : best[i] - cost;
        gains[i] = gain > -kFarBetter && cost < kFarBetter ? gain : 0.0F;
      }
      const auto [count, gain] = largest_patch(cells, gains);
      if (static_cast<double>(count) * params.cell * params.cell >= params.smallest && gain > most)
        most = gain, next = h;
    }
    if (most == 0.0) break;
    found.push_back(heights[next]);
    for (std::size_t i = 0; i < best.size(); ++i)
      if (best[i] != kNone) best[i] = std::min(best[i], costs[next].nats[i]);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Each cell's part: what its own cost and its neighbours say (iterated conditional modes). The part that is best for
/// most cells is that of all that tells nothing; where no height makes the pictures agree, there is no ceiling.
std::vector<std::uint8_t> parts_of(const GridFrame& cells, const HeightCosts& costs, const HeightSweepParams& params) {
  std::vector<std::uint8_t> part(cells.size(), CeilingMosaic::kUnknown);
  std::vector<std::size_t> best(costs.size());
  std::vector<bool> is_ceiling(cells.size());
  const auto unlike = static_cast<float>(params.unlike * params.unlike);
  for (std::size_t cell = 0; cell < part.size(); ++cell) {
    std::size_t least = 0;
    for (std::size_t p = 1; p < costs.size(); ++p)
      if (costs[p].nats[cell] < costs[least].nats[cell]) least = p;
    is_ceiling[cell] = costs[least].variance[cell] < unlike;
    if (is_ceiling[cell] && costs[least].nats[cell] < kBelieved) ++best[least];
  }
  const auto main = static_cast<std::size_t>(std::max_element(best.begin(), best.end()) - best.begin());
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<std::uint8_t> last = part;
    for (int row = 0; row < cells.rows; ++row)
      for (int column = 0; column < cells.columns; ++column) {
        float least = kNone;
        const std::size_t cell = cells.index({column, row});
        if (!is_ceiling[cell]) continue;
        for (std::size_t p = 0; p < costs.size(); ++p) {
          if (costs[p].nats[cell] == kNone) continue;
          float cost = costs[p].nats[cell] + (p == main ? 0.0F : kOther);
          for (int v = -1; v <= 1; ++v)
            for (int u = -1; u <= 1; ++u) {
              const CellIndex beside{column + u, row + v};
              if (!cells.holds(beside)) continue;
              const std::uint8_t other = last[cells.index(beside)];
              if (other != CeilingMosaic::kUnknown && other != p) cost += kNeighbour;
            }
          if (cost < least) least = cost, part[cell] = static_cast<std::uint8_t>(p);
        }
      }
  }
  return part;
}

}  // namespace

Result<void> HeightSweepParams::validate() const {
  if (!(least > 0.0 && most > least)) return fail("height_sweep.least must be > 0, and height_sweep.most above it");
  if (!(step > 0.0 && same > 0.0)) return fail("height_sweep.step and height_sweep.same must be > 0");
  if (!(texture > 0.0)) return fail("height_sweep.texture must be > 0");
  if (!(cell > 0.0 && window > 0.0 && smallest > 0.0 && steepest > 0.0 && unlike > 0.0 && farthest > 0.0 &&
        looks > 0.0))
    return fail("height_sweep.cell, window, smallest, steepest, unlike, farthest and looks must be > 0");
  if (pictures == 0) return fail("height_sweep.pictures must be > 0");
  return {};
}

namespace {

/// [m] So far that the average cell is in params.looks pictures.
double farthest_of(std::span<const PictureUnknowns> unknowns, std::size_t stride, const HeightSweepParams& params) {
  double left = unknowns[0].pose[0], right = left, low = unknowns[0].pose[1], high = low;
  for (const PictureUnknowns& unknown : unknowns) {
    left = std::min(left, unknown.pose[0]), right = std::max(right, unknown.pose[0]);
    low = std::min(low, unknown.pose[1]), high = std::max(high, unknown.pose[1]);
  }
  const double area = std::max(1.0, (right - left) * (high - low));
  const double pictures = static_cast<double>(unknowns.size()) / static_cast<double>(stride);
  return std::max(params.farthest, std::sqrt(params.looks * area / (std::numbers::pi * pictures)));
}

}  // namespace

CeilingMosaic sweep_heights(const GridFrame& frame, const CeilingCamera& camera,
                            std::span<const ShrunkPicture> pictures, std::span<const PictureUnknowns> unknowns,
                            const HeightSweepParams& params) {
  GridFrame cells = frame;
  cells.resolution = params.cell;
  cells.columns = std::max(1, static_cast<int>(std::ceil(frame.columns * frame.resolution / params.cell)));
  cells.rows = std::max(1, static_cast<int>(std::ceil(frame.rows * frame.resolution / params.cell)));
  const std::size_t stride = (pictures.size() + params.pictures - 1) / params.pictures;
  const double farthest = farthest_of(unknowns, stride, params);
  std::vector<double> heights;
  for (double height = std::max(params.least, camera.mount.position.z() + 0.3); height <= params.most;
       height *= 1.0 + params.step)
    heights.push_back(height);
  const std::vector<SharpPicture> sharp(pictures.begin(), pictures.end());
  const auto costs_at = [&](const std::vector<double>& tried, int reach, double few_looks) {
    HeightCosts costs;
    for (const double height : tried)
      costs.push_back(cost_of(cells, shown_at(cells, camera, sharp, unknowns, height, params, stride, farthest), reach,
                              params.texture, few_looks));
    return costs;
  };
  const int reach = std::max(1, static_cast<int>(std::lround(0.5 * params.window / params.cell)));
  CeilingMosaic mosaic{frame, heights_of_parts(cells, costs_at(heights, reach, 0.0), heights, params), {}, {}};
  mosaic.part.assign(frame.size(), CeilingMosaic::kUnknown);
  mosaic.brightness.assign(frame.size(), 0.0F);
  if (mosaic.heights.empty()) return mosaic;
  const std::vector<std::uint8_t> part = parts_of(cells, costs_at(mosaic.heights, 1, kFewLooks), params);
  for (int row = 0; row < frame.rows; ++row)
    for (int column = 0; column < frame.columns; ++column) {
      const CellIndex coarse = cells.cell_at(frame.centre({column, row}));
      if (cells.holds(coarse)) mosaic.part[frame.index({column, row})] = part[cells.index(coarse)];
    }
  return mosaic;
}

}  // namespace docent::vision
