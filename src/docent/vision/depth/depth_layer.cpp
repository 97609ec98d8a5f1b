#include "docent/vision/depth/depth_layer.h"

#include <algorithm>
#include <cmath>

namespace docent::vision {

Result<void> DepthLayerParams::validate() const {
  constexpr double kMostCells = 1000.0;
  if (!(cell > 0.0 && side > cell && side / cell <= kMostCells))
    return fail("depth layer: it takes 0 < cell < side, and at most 1000 cells a side");
  if (!(body_radius >= 0.0)) return fail("depth layer: body_radius must be >= 0");
  if (!(hit > 0.0 && pass > 0.0 && most > 0.0)) return fail("depth layer: hit, pass and most must be > 0");
  if (!(unanswered >= 0.0 && silent_floor >= 0.0)) return fail("depth layer: unanswered and silent_floor must be >= 0");
  if (!(occupied > 0.0 && occupied <= most)) return fail("depth layer: occupied must be in (0, most]");
  if (!(least_pixels >= 1)) return fail("depth layer: least_pixels must be >= 1");
  return {};
}

DepthLayer::DepthLayer(const DepthCamera& camera, const DepthLayerParams& params, double low, double robot_height)
    : camera_{camera},
      projector_{camera},
      params_{params},
      low_{low},
      storey_{(robot_height - low) / kStoreys},
      cells_{static_cast<int>(std::lround(params.side / params.cell))},
      columns_(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_)),
      strongest_(columns_.size()),
      shown_(columns_.size()) {}

void DepthLayer::note(int slot) {
  const Column& column = columns_[static_cast<std::size_t>(slot)];
  strongest_[static_cast<std::size_t>(slot)] =
      std::max(column.drop, *std::max_element(column.odds.begin(), column.odds.end()));
}

void DepthLayer::move_to(Point2 odom) {
  const int first_column = index_of(odom.x) - cells_ / 2, first_row = index_of(odom.y) - cells_ / 2;
  if (is_placed_ && first_column == first_column_ && first_row == first_row_) return;
  const int old_column = first_column_, old_row = first_row_;
  first_column_ = first_column;
  first_row_ = first_row;
  ring_column_ = (first_column % cells_ + cells_) % cells_;
  ring_row_ = (first_row % cells_ + cells_) % cells_;
  for (int row = first_row_; row < first_row_ + cells_; ++row) {
    for (int column = first_column_; column < first_column_ + cells_; ++column) {
      const bool was_there = is_placed_ && column >= old_column && row >= old_row && column < old_column + cells_ &&
                             row < old_row + cells_;
      if (was_there) continue;
      columns_[static_cast<std::size_t>(slot(column, row))] = {};
      note(slot(column, row));
    }
  }
  is_placed_ = true;
}

void DepthLayer::add(const DepthPicture& picture, const Heights& heights, const Pose2& odom_from_base) {
  move_to(odom_from_base.position());
  if (heights.is_blind) return;
  place_ = odom_from_base.position();
  ahead_ = unit(odom_from_base.theta);
  count(heights);
  clear(picture, heights, odom_from_base);
  raise();
  free_body(odom_from_base.position());
  for (const int touched : touched_) shown_[static_cast<std::size_t>(touched)] = {};
  touched_.clear();
}

DepthLayer::Shown* DepthLayer::shown_at(float x, float y) {
  const double dx = static_cast<double>(x), dy = static_cast<double>(y);
  const int column = index_of(place_.x + ahead_.x * dx - ahead_.y * dy);
  const int row = index_of(place_.y + ahead_.y * dx + ahead_.x * dy);
  if (!holds(column, row)) return nullptr;
  const int at = slot(column, row);
  Shown& shown = shown_[static_cast<std::size_t>(at)];
  if (!shown.is_touched) touched_.push_back(at);
  shown.is_touched = true;
  return &shown;
}

void DepthLayer::count(const Heights& heights) {
  for (const HeightPoint& point : heights.points) {
    Shown* shown = shown_at(point.x, point.y);
    if (shown == nullptr) continue;
    if (point.kind == HeightPoint::Kind::drop) ++shown->drops;
    if (point.kind == HeightPoint::Kind::silent) ++shown->silent;
    if (point.kind != HeightPoint::Kind::obstacle) continue;
    const int storey = static_cast<int>((static_cast<double>(point.height) - low_) / storey_);
    const auto i = static_cast<std::size_t>(std::clamp(storey, 0, kStoreys - 1));
    ++shown->hits[i];
    shown->heights[i] += point.height;
  }
  for (const Point2 floor : heights.floor)
    if (Shown* shown = shown_at(static_cast<float>(floor.x), static_cast<float>(floor.y))) ++shown->floor;
}

/// What the picture shows counts after what it frees: a voxel of which both are said is in the way. Of each column only
/// the lowest voxel is marked: what stands on the floor is gone when its foot is, also where its head is out of view.
void DepthLayer::raise() {
  const auto most = static_cast<float>(params_.most), hit = static_cast<float>(params_.hit);
  for (const int touched : touched_) {
    Column& column = columns_[static_cast<std::size_t>(touched)];
    const Shown& shown = shown_[static_cast<std::size_t>(touched)];
    int above = 0;
    for (const auto hits : shown.hits) above += hits;
    const auto lowest = static_cast<std::size_t>(
        std::find_if(shown.hits.begin(), shown.hits.end(), [](auto hits) { return hits > 0; }) - shown.hits.begin());
    if (above >= params_.least_pixels) {
      column.odds[lowest] = std::min(most, column.odds[lowest] + hit);
      column.at[lowest] = shown.heights[lowest] / static_cast<float>(shown.hits[lowest]);
    }
    if (shown.drops >= params_.least_pixels) {
      column.drop = std::min(most, column.drop + hit);
    } else if (shown.floor > 0) {
      column.drop = std::max(0.0F, column.drop - static_cast<float>(params_.pass));
    } else if (shown.silent > 0 && shown.floor == 0 && above == 0) {
      column.drop = std::min(most, column.drop + static_cast<float>(params_.silent_floor));
    }
    note(touched);
  }
}

/// How much the picture says that nothing is at a place: by the rays about it that go on behind it. < 0 is freed.
float DepthLayer::seen_through(const DepthPicture& picture, const PicturePlace& place) const {
  constexpr int kMostReach = 6;  // [pixels]
  const double half = 0.5 * params_.cell * camera_.focal / place.depth;
  const int reach = std::clamp(static_cast<int>(half), 1, kMostReach);
  const auto behind =
      static_cast<float>(place.depth + params_.cell) + 2.0F * depth_noise(static_cast<float>(place.depth));
  const int column = static_cast<int>(std::lround(place.column)), row = static_cast<int>(std::lround(place.row));
  int through = 0, answered = 0, silent = 0;
  for (int dy = -reach; dy <= reach; dy += reach) {
    for (int dx = -reach; dx <= reach; dx += reach) {
      if (column + dx < 0 || row + dy < 0 || column + dx >= picture.columns || row + dy >= picture.rows) continue;
      const float depth = picture.depth[picture.index(column + dx, row + dy)];
      if (!(depth > 0.0F)) {
        ++silent;
        continue;
      }
      ++answered;
      if (depth > behind) ++through;
    }
  }
  if (answered == 0) return silent > 0 ? -static_cast<float>(params_.unanswered) : 0.0F;
  return 2 * through > answered ? -static_cast<float>(params_.pass) : 0.0F;
}

void DepthLayer::clear(const DepthPicture& picture, const Heights& heights, const Pose2& odom_from_base) {
  const Pose2 base_from_odom = inverse(odom_from_base);
  const Eigen::Vector3d& normal = heights.ground.normal;
  for (int row = first_row_; row < first_row_ + cells_; ++row) {
    for (int cell = first_column_; cell < first_column_ + cells_; ++cell) {
      const int at = slot(cell, row);
      if (!(strongest_[static_cast<std::size_t>(at)] > 0.0F)) continue;
      Column& column = columns_[static_cast<std::size_t>(at)];
      const Point2 centre = base_from_odom * Point2{(cell + 0.5) * params_.cell, (row + 0.5) * params_.cell};
      const double floor = -(normal.x() * centre.x + normal.y() * centre.y + heights.ground.offset) / normal.z();
      for (std::size_t storey = 0; storey < kStoreys; ++storey) {
        float& odds = column.odds[storey];
        if (!(odds > 0.0F) || shown_[static_cast<std::size_t>(at)].hits[storey] > 0) continue;
        const bool is_floor = storey == 0 && shown_[static_cast<std::size_t>(at)].floor >= params_.least_pixels;
        const auto place = projector_.place_of({centre.x, centre.y, floor + static_cast<double>(column.at[storey])});
        const float change = is_floor ? -static_cast<float>(params_.pass)
                             : place  ? seen_through(picture, *place)
                                      : 0.0F;
        odds = std::max(0.0F, odds + change);
      }
      note(at);
    }
  }
}

void DepthLayer::free_body(Point2 odom) {
  const int reach = static_cast<int>(params_.body_radius / params_.cell);
  const int at_column = index_of(odom.x), at_row = index_of(odom.y);
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (dx * dx + dy * dy <= reach * reach) {
        const int at = slot(at_column + dx, at_row + dy);
        columns_[static_cast<std::size_t>(at)] = {};
        note(at);
      }
}

std::vector<LayerCell> DepthLayer::cells() const {
  std::vector<LayerCell> cells;
  const auto occupied = static_cast<float>(params_.occupied);
  for (int row = first_row_; row < first_row_ + cells_; ++row) {
    for (int column = first_column_; column < first_column_ + cells_; ++column) {
      const int at = slot(column, row);
      if (strongest_[static_cast<std::size_t>(at)] < occupied) continue;
      const bool is_drop = columns_[static_cast<std::size_t>(at)].drop >= occupied;
      cells.push_back({{(column + 0.5) * params_.cell, (row + 0.5) * params_.cell}, is_drop});
    }
  }
  return cells;
}

}  // namespace docent::vision
