#include "docent/apps/laboratory/take_pictures/picture_drive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>

namespace docent::apps::take_pictures_command {
namespace {

constexpr double kCell = 0.2;          // [m] of the floor's grid
constexpr double kAhead = 0.4;         // [m] the point that it steers for
constexpr double kMostTurning = 0.9;   // [rad/s]
constexpr double kLongest = 36'000.0;  // [s] of a drive

/// Where the robot's centre may be.
class FreeFloor {
 public:
  FreeFloor(const simulator::World& world, double clearance) {
    low_ = world.operating_area.front();
    Point2 high = low_;
    for (const Point2 p : world.operating_area) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    columns_ = static_cast<int>((high.x - low_.x) / kCell) + 1;
    rows_ = static_cast<int>((high.y - low_.y) / kCell) + 1;
    is_free_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), false);
    for (std::size_t i = 0; i < is_free_.size(); ++i) {
      const Point2 at = centre(i);
      is_free_[i] = contains(world.operating_area, at) &&
                    std::none_of(world.solids.begin(), world.solids.end(), [&](const simulator::Solid& solid) {
                      return solid.bottom < 1.5 && distance(solid.polygon, at) < clearance;
                    });
    }
  }
  [[nodiscard]] std::size_t size() const { return is_free_.size(); }
  [[nodiscard]] bool is_free(std::size_t cell) const { return is_free_[cell]; }
  [[nodiscard]] Point2 centre(std::size_t cell) const {
    const auto width = static_cast<std::size_t>(columns_);
    return low_ + kCell * Point2{static_cast<double>(cell % width) + 0.5, static_cast<double>(cell / width) + 0.5};
  }
  /// The way to the nearest free cell that `is_goal` likes, from a free cell; empty: there is none.
  template <class Goal>
  [[nodiscard]] std::vector<std::size_t> way(std::size_t from, const Goal& is_goal) const {
    std::vector<std::size_t> before(is_free_.size(), is_free_.size());
    std::deque<std::size_t> next{from};
    before[from] = from;
    while (!next.empty()) {
      const std::size_t cell = next.front();
      next.pop_front();
      if (cell != from && is_goal(cell)) return unrolled(before, from, cell);
      for (const auto& [dx, dy] :
           std::array<std::array<int, 2>, 8>{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}}) {
        const int x = static_cast<int>(cell) % columns_ + dx, y = static_cast<int>(cell) / columns_ + dy;
        if (x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
        const auto other = static_cast<std::size_t>(y * columns_ + x);
        if (!is_free_[other] || before[other] != is_free_.size()) continue;
        before[other] = cell;
        next.push_back(other);
      }
    }
    return {};
  }

 private:
  static std::vector<std::size_t> unrolled(const std::vector<std::size_t>& before, std::size_t from, std::size_t to) {
    std::vector<std::size_t> cells;
    for (std::size_t cell = to; cell != from; cell = before[cell]) cells.push_back(cell);
    std::reverse(cells.begin(), cells.end());
    return cells;
  }

  Point2 low_;
  int columns_ = 0, rows_ = 0;
  std::vector<bool> is_free_;
};

/// Corners rounded: the mean of each point and its neighbours.
std::vector<Point2> smoothed(const std::vector<Point2>& way) {
  constexpr std::ptrdiff_t kReach = 2;
  std::vector<Point2> result;
  const auto last = static_cast<std::ptrdiff_t>(way.size()) - 1;
  for (std::ptrdiff_t i = 0; i <= last; ++i) {
    Point2 sum;
    for (std::ptrdiff_t k = -kReach; k <= kReach; ++k)
      sum = sum + way[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i + k, 0, last))];
    result.push_back((1.0 / (2.0 * kReach + 1.0)) * sum);
  }
  return result;
}

/// Drives piece by piece of a way and takes pictures.
class Driver {
 public:
  Driver(const DriveOptions& options, Pose2 start) : options_{options}, now_{start} {}
  [[nodiscard]] bool is_done() const { return drive_.pictures.size() >= options_.pictures || time_ > kLongest; }

  void follow(const std::vector<Point2>& way) {
    std::size_t next = 0;
    while (!is_done()) {
      while (next < way.size() && distance(way[next], now_.position()) < kAhead) ++next;
      if (next == way.size()) return;
      step(way[next]);
    }
  }
  Drive take() { return std::move(drive_); }

 private:
  void step(Point2 target) {
    remember();
    const double off = (direction(now_.position(), target) - now_.theta).radians();
    const double turning = std::clamp(2.5 * off, -kMostTurning, kMostTurning);
    const double slow = std::max(0.0, std::cos(std::min(std::abs(off) * 1.3, 0.5 * std::numbers::pi)));
    const double speed = options_.speed * slow * slow;
    const Angle middle = now_.theta + Angle::radians(0.5 * turning * kTick);
    const Point2 moved = now_.position() + speed * kTick * unit(middle);
    now_ = {moved.x, moved.y, now_.theta + Angle::radians(turning * kTick)};
    gone_ += speed * kTick;
    turned_ += std::abs(turning) * kTick;
    time_ += kTick;
  }
  void remember() {
    if (drive_.pictures.empty() || gone_ >= options_.spacing || turned_ >= options_.turning) {
      drive_.pictures.push_back(drive_.moments.size());
      gone_ = turned_ = 0.0;
    }
    drive_.moments.push_back({time_, now_});
  }

  const DriveOptions& options_;
  Pose2 now_;
  double time_ = 0.0, gone_ = 0.0, turned_ = 0.0;
  Drive drive_;
};

}  // namespace

Pose2 Drive::at(double time) const {
  const double place = std::clamp(time / kTick, 0.0, static_cast<double>(moments.size()) - 1.0);
  const auto before = static_cast<std::size_t>(place);
  const std::size_t after = std::min(before + 1, moments.size() - 1);
  const double share = place - static_cast<double>(before);
  const Pose2 &a = moments[before].world_from_base, &b = moments[after].world_from_base;
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          a.theta + Angle::radians(share * (b.theta - a.theta).radians())};
}

Result<Drive> drive_along(const std::vector<Point2>& way, const DriveOptions& options) {
  if (way.size() < 2) return fail("a way needs at least two points");
  Driver driver{options, {way[0].x, way[0].y, direction(way[0], way[1])}};
  std::vector<Point2> fine;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const int pieces = std::max(1, static_cast<int>(distance(way[i], way[i + 1]) / kCell));
    for (int k = 1; k <= pieces; ++k)
      fine.push_back(way[i] + (static_cast<double>(k) / pieces) * (way[i + 1] - way[i]));
  }
  driver.follow(fine);
  return driver.take();
}

Result<Drive> drive_everywhere(const simulator::World& world, const DriveOptions& options, Rng rng) {
  const FreeFloor floor{world, options.clearance};
  std::size_t here = floor.size();
  for (std::size_t i = 0; i < floor.size(); ++i)
    if (floor.is_free(i) &&
        (here == floor.size() || distance(floor.centre(i), world.home) < distance(floor.centre(here), world.home)))
      here = i;
  if (here == floor.size()) return fail("the robot has nowhere to drive");
  std::vector<bool> is_known(floor.size(), false);
  const auto look_round = [&](std::size_t cell) {
    for (std::size_t i = 0; i < floor.size(); ++i)
      if (distance(floor.centre(i), floor.centre(cell)) < options.lane) is_known[i] = true;
  };
  look_round(here);
  const Point2 start = floor.centre(here);
  Driver driver{options, {start.x, start.y, Angle::radians(rng.uniform(-3.0, 3.0))}};
  while (!driver.is_done()) {
    std::vector<std::size_t> cells = floor.way(here, [&](std::size_t cell) { return !is_known[cell]; });
    if (cells.empty()) {  // all seen: anywhere
      const auto goal = static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(floor.size()) - 1));
      cells = floor.way(here, [&](std::size_t cell) { return cell == goal; });
      if (cells.empty()) continue;
    }
    std::vector<Point2> way{floor.centre(here)};
    for (const std::size_t cell : cells) {
      look_round(cell);
      way.push_back(floor.centre(cell));
    }
    driver.follow(smoothed(way));
    here = cells.back();
  }
  return driver.take();
}

ToldPoses told_poses(const Drive& drive, Rng rng) {
  constexpr double kScale = 0.01;      // deviation of how long it takes a metre to be
  constexpr double kSlip = 0.01;       // [m] deviation a root metre
  constexpr double kDrift = 0.012;     // [rad] deviation a root metre
  constexpr double kBias = 0.004;      // [rad] deviation a metre, all the way
  constexpr double kOfTurn = 0.01;     // deviation of how far it takes a turn to be
  constexpr double kMapError = 0.03;   // [m] deviation, changes slowly
  constexpr double kMapJitter = 0.01;  // [m] deviation, another each time
  constexpr double kMapTurn = 0.007;   // [rad] deviation, changes slowly
  constexpr double kMapKeeps = 2.0;    // [m] so slowly
  const double scale = rng.normal(1.0, kScale), bias = rng.normal(0.0, kBias), of_turn = rng.normal(1.0, kOfTurn);
  ToldPoses told;
  std::array<double, 3> wrong{rng.normal(), rng.normal(), rng.normal()};
  Pose2 odometry;
  for (std::size_t i = 0; i < drive.pictures.size(); ++i) {
    const Pose2& here = drive.moments[drive.pictures[i]].world_from_base;
    if (i > 0) {
      const Pose2 step = inverse(drive.moments[drive.pictures[i - 1]].world_from_base) * here;
      const double way = norm(step.position()), root = std::sqrt(way);
      odometry =
          odometry * Pose2{scale * step.x + kSlip * root * rng.normal(), scale * step.y,
                           Angle::radians(of_turn * step.theta.radians() + bias * way + kDrift * root * rng.normal())};
      const double keeps = std::exp(-way / kMapKeeps);
      for (double& w : wrong) w = keeps * w + std::sqrt(1.0 - keeps * keeps) * rng.normal();
    }
    told.odometry.push_back(odometry);
    told.map.push_back({here.x + kMapError * wrong[0] + kMapJitter * rng.normal(),
                        here.y + kMapError * wrong[1] + kMapJitter * rng.normal(),
                        here.theta + Angle::radians(kMapTurn * wrong[2])});
  }
  return told;
}

}  // namespace docent::apps::take_pictures_command
