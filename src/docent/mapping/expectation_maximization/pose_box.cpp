#include "docent/mapping/expectation_maximization/pose_box.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace docent::mapping {
namespace {

/// A Gaussian over cells, summing to 1, as far as three deviations.
std::vector<float> gaussian_kernel(double variance_in_cells) {
  const double sigma = std::sqrt(std::max(variance_in_cells, 1e-9));
  const int reach = static_cast<int>(std::ceil(3.0 * sigma - 0.5));
  std::vector<float> kernel;
  for (int i = -std::max(reach, 0); i <= reach; ++i) {
    const double low = (i - 0.5) / (sigma * std::numbers::sqrt2);
    const double high = (i + 0.5) / (sigma * std::numbers::sqrt2);
    kernel.push_back(static_cast<float>(0.5 * (std::erf(high) - std::erf(low))));
  }
  const float sum = std::accumulate(kernel.begin(), kernel.end(), 0.0F);
  for (float& k : kernel) k /= sum;
  return kernel;
}

int reach_of(std::span<const float> kernel) { return static_cast<int>(kernel.size() / 2); }

int floor_mod(int value, int n) { return ((value % n) + n) % n; }

}  // namespace

double PoseCells::step() const { return 2.0 * std::numbers::pi / turns; }

PoseBox::PoseBox(const PoseCells& cells, const Pose2& at)
    : cells_{cells},
      first_column_{static_cast<int>(std::lround(at.x / cells.cell))},
      first_row_{static_cast<int>(std::lround(at.y / cells.cell))},
      first_turn_{static_cast<int>(std::lround(at.theta.radians() / cells.step()))},
      values_(1, 1.0F) {}

Pose2 PoseBox::pose(std::size_t i) const {
  const auto columns = static_cast<std::size_t>(columns_);
  const auto rows = static_cast<std::size_t>(rows_);
  const int column = static_cast<int>(i % columns);
  const int row = static_cast<int>(i / columns % rows);
  const int turn = static_cast<int>(i / (columns * rows));
  return {(first_column_ + column) * cells_.cell, (first_row_ + row) * cells_.cell,
          Angle::radians((first_turn_ + turn) * cells_.step())};
}

double PoseBox::value_at(const Pose2& pose) const {
  const int column = static_cast<int>(std::lround(pose.x / cells_.cell)) - first_column_;
  const int row = static_cast<int>(std::lround(pose.y / cells_.cell)) - first_row_;
  const int turn =
      floor_mod(static_cast<int>(std::lround(pose.theta.radians() / cells_.step())) - first_turn_, cells_.turns);
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_ || turn >= arc_) return 0.0;
  return values_[index(column, row, turn)];
}

void PoseBox::widen(int places, int turns) {
  const int arc = std::min(cells_.turns, arc_ + 2 * turns);
  const int turn_border = arc == cells_.turns && arc_ + 2 * turns > cells_.turns ? (arc - arc_) / 2 : turns;
  PoseBox wide{*this};
  wide.first_column_ -= places;
  wide.first_row_ -= places;
  wide.first_turn_ -= turn_border;
  wide.columns_ += 2 * places;
  wide.rows_ += 2 * places;
  wide.arc_ = arc;
  wide.values_.assign(
      static_cast<std::size_t>(wide.columns_) * static_cast<std::size_t>(wide.rows_) * static_cast<std::size_t>(arc),
      0.0F);
  for (int turn = 0; turn < arc_; ++turn) {
    for (int row = 0; row < rows_; ++row) {
      std::copy_n(
          values_.begin() + static_cast<std::ptrdiff_t>(index(0, row, turn)), columns_,
          wide.values_.begin() + static_cast<std::ptrdiff_t>(wide.index(places, row + places, turn + turn_border)));
    }
  }
  *this = std::move(wide);
}

void PoseBox::blur_places(std::span<const float> kernel) {
  const int reach = reach_of(kernel);
  if (reach == 0) return;
  std::vector<float> line(static_cast<std::size_t>(std::max(columns_, rows_)));
  const auto blur_line = [&](std::size_t begin, int count, std::size_t stride) {
    for (int i = 0; i < count; ++i)
      line[static_cast<std::size_t>(i)] = values_[begin + static_cast<std::size_t>(i) * stride];
    for (int i = 0; i < count; ++i) {
      float sum = 0.0F;
      for (int k = std::max(0, i - reach); k <= std::min(count - 1, i + reach); ++k) {
        sum += kernel[static_cast<std::size_t>(i - k + reach)] * line[static_cast<std::size_t>(k)];
      }
      values_[begin + static_cast<std::size_t>(i) * stride] = sum;
    }
  };
  for (int turn = 0; turn < arc_; ++turn) {
    for (int row = 0; row < rows_; ++row) blur_line(index(0, row, turn), columns_, 1);
    for (int column = 0; column < columns_; ++column) {
      blur_line(index(column, 0, turn), rows_, static_cast<std::size_t>(columns_));
    }
  }
}

void PoseBox::blur_turns(std::span<const float> kernel) {
  const int reach = reach_of(kernel);
  if (reach == 0) return;
  const std::size_t slice = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  const bool is_circle = arc_ == cells_.turns;
  std::vector<float> blurred(values_.size(), 0.0F);
  for (int from = 0; from < arc_; ++from) {
    for (int k = -reach; k <= reach; ++k) {
      int to = from + k;
      if (is_circle) to = floor_mod(to, arc_);
      if (to < 0 || to >= arc_) continue;
      const float weight = kernel[static_cast<std::size_t>(k + reach)];
      const float* source = values_.data() + static_cast<std::size_t>(from) * slice;
      float* target = blurred.data() + static_cast<std::size_t>(to) * slice;
      for (std::size_t i = 0; i < slice; ++i) target[i] += weight * source[i];
    }
  }
  values_ = std::move(blurred);
}

void PoseBox::shift_turns(double turns) {
  const int whole = static_cast<int>(std::floor(turns));
  const auto part = static_cast<float>(turns - whole);
  first_turn_ += whole;
  const std::vector<float> kernel{0.0F, 1.0F - part, part};  // of [-1, 0, 1]
  blur_turns(kernel);
}

void PoseBox::shift_places(Point2 way, double sign) {
  const std::size_t slice = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  std::vector<float> shifted(values_.size(), 0.0F);
  for (int turn = 0; turn < arc_; ++turn) {
    const Pose2 heading{0.0, 0.0, Angle::radians((first_turn_ + turn) * cells_.step())};
    const Point2 by = (sign / cells_.cell) * (heading * way);
    const int column_by = static_cast<int>(std::floor(by.x));
    const int row_by = static_cast<int>(std::floor(by.y));
    const double px = by.x - column_by;
    const double py = by.y - row_by;
    const double weights[2][2] = {{(1 - px) * (1 - py), px * (1 - py)}, {(1 - px) * py, px * py}};
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const float value =
            values_[static_cast<std::size_t>(turn) * slice + static_cast<std::size_t>(row * columns_ + column)];
        if (value == 0.0F) continue;
        for (int j = 0; j < 2; ++j) {
          for (int i = 0; i < 2; ++i) {
            const int to_column = column + column_by + i;
            const int to_row = row + row_by + j;
            if (to_column < 0 || to_row < 0 || to_column >= columns_ || to_row >= rows_) continue;
            shifted[index(to_column, to_row, turn)] += value * static_cast<float>(weights[j][i]);
          }
        }
      }
    }
  }
  values_ = std::move(shifted);
}

PoseBox::Noise PoseBox::noise_of(const Motion& motion) const {
  // Sharing a cell's mass between its neighbours blurs by itself, by up to a quarter of a square cell.
  constexpr double kOwnBlur = 0.17;  // [cells2], the mean
  const auto kernel = [](double variance, double cell) {
    return gaussian_kernel(std::max(0.0, variance / (cell * cell) - kOwnBlur));
  };
  return {kernel(motion.way_variance, cells_.cell), kernel(motion.turn_variance, cells_.step())};
}

PoseBox PoseBox::with_room_for(const Motion& motion, const Noise& noise) const {
  PoseBox box{*this};
  const double way = norm(motion.before_from_after.position());
  box.widen(reach_of(noise.places) + static_cast<int>(std::ceil(way / cells_.cell)) + 1, reach_of(noise.turns) + 1);
  return box;
}

PoseBox PoseBox::moved(const Motion& motion) const {
  const Noise noise = noise_of(motion);
  PoseBox box = with_room_for(motion, noise);
  box.shift_places(motion.before_from_after.position(), 1.0);
  box.shift_turns(motion.before_from_after.theta.radians() / cells_.step());
  box.blur_turns(noise.turns);
  box.blur_places(noise.places);
  return box;
}

PoseBox PoseBox::moved_back(const Motion& motion) const {
  const Noise noise = noise_of(motion);
  PoseBox box = with_room_for(motion, noise);
  box.blur_places(noise.places);
  box.blur_turns(noise.turns);
  box.shift_turns(-motion.before_from_after.theta.radians() / cells_.step());
  box.shift_places(motion.before_from_after.position(), -1.0);
  return box;
}

double PoseBox::normalise() {
  double sum = 0.0;
  for (const float value : values_) sum += value;
  if (sum <= 0.0) return 0.0;
  const auto scale = static_cast<float>(1.0 / sum);
  for (float& value : values_) value *= scale;
  return sum;
}

void PoseBox::crop(float least) {
  const float most = *std::max_element(values_.begin(), values_.end());
  if (most <= 0.0F) return;
  int low[3] = {columns_, rows_, arc_};
  int high[3] = {-1, -1, -1};
  for (int turn = 0; turn < arc_; ++turn) {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        float& value = values_[index(column, row, turn)];
        if (value < least * most) {
          value = 0.0F;
          continue;
        }
        const int at[3] = {column, row, turn};
        for (int k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], at[k]);
          high[k] = std::max(high[k], at[k]);
        }
      }
    }
  }
  PoseBox small{*this};
  small.first_column_ += low[0];
  small.first_row_ += low[1];
  small.first_turn_ += low[2];
  small.columns_ = high[0] - low[0] + 1;
  small.rows_ = high[1] - low[1] + 1;
  small.arc_ = high[2] - low[2] + 1;
  small.values_.clear();
  for (int turn = low[2]; turn <= high[2]; ++turn) {
    for (int row = low[1]; row <= high[1]; ++row) {
      const auto begin = values_.begin() + static_cast<std::ptrdiff_t>(index(low[0], row, turn));
      small.values_.insert(small.values_.end(), begin, begin + small.columns_);
    }
  }
  *this = std::move(small);
}

void PoseBox::multiply(const PoseBox& other) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (values_[i] > 0.0F) values_[i] *= static_cast<float>(other.value_at(pose(i)));
  }
}

Pose2 PoseBox::mode() const {
  const auto heaviest = static_cast<std::size_t>(std::max_element(values_.begin(), values_.end()) - values_.begin());
  const Pose2 centre = pose(heaviest);
  double sum = 0.0;
  double x = 0.0;
  double y = 0.0;
  double turn = 0.0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (values_[i] == 0.0F) continue;
    const Pose2 at = pose(i);
    const double turned = (at.theta - centre.theta).radians();
    if (distance(at.position(), centre.position()) > 2.5 * cells_.cell || std::abs(turned) > 2.5 * cells_.step())
      continue;
    const double weight = values_[i];
    sum += weight;
    x += weight * (at.x - centre.x);
    y += weight * (at.y - centre.y);
    turn += weight * turned;
  }
  if (sum <= 0.0) return centre;
  return {centre.x + x / sum, centre.y + y / sum, centre.theta + Angle::radians(turn / sum)};
}

PoseBox::Spread PoseBox::spread() const {
  const Pose2 centre = mode();
  double sum = 0.0;
  double metres = 0.0;
  double radians = 0.0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (values_[i] == 0.0F) continue;
    const Pose2 at = pose(i);
    const double apart = distance(at.position(), centre.position());
    const double turned = (at.theta - centre.theta).radians();
    sum += values_[i];
    metres += values_[i] * apart * apart;
    radians += values_[i] * turned * turned;
  }
  return {std::sqrt(metres / sum), std::sqrt(radians / sum)};
}

}  // namespace docent::mapping
