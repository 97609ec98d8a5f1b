#include "docent/planning/exploration/exploration_drive.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace docent::planning {
namespace {

constexpr double kBlockedRadius = 0.5;  // [m] about what holds it up
constexpr double kBlockedAhead = 0.7;   // [m] from the robot's centre: where it stands
constexpr int kTriesAGoal = 3;          // times that it was held up on its way to one place, then it lets that be
constexpr double kOneGoal = 0.8;        // [m]
constexpr int kMostChoices = 4;  // times that it set out for one place and turned away: then it lets that be, too
constexpr double kDrivenBetween = 3.0;  // [m] at least between two such times: nearby places may take turns
constexpr Duration kBacksOff = std::chrono::seconds{15};  // at most
constexpr std::size_t kTriesHome = 5;                     // ways home on which it was held up, then it stays

/// The mean of five cells for each: a way over cells is a staircase.
std::vector<Point2> smoothed(const std::vector<Point2>& cells) {
  constexpr std::ptrdiff_t kHalf = 2;
  const auto last = static_cast<std::ptrdiff_t>(cells.size()) - 1;
  std::vector<Point2> way;
  for (std::ptrdiff_t i = 0; i <= last; ++i) {
    const std::ptrdiff_t half = std::min({kHalf, i, last - i});
    Point2 sum;
    for (std::ptrdiff_t k = i - half; k <= i + half; ++k) sum = sum + cells[static_cast<std::size_t>(k)];
    way.push_back((1.0 / static_cast<double>(2 * half + 1)) * sum);
  }
  return way;
}

}  // namespace

Result<void> ExplorationDriveParams::validate() const {
  if (!(horizon > 0.0)) return fail("horizon must be > 0 m");
  if (!(held_up > 0.0)) return fail("held_up must be > 0 s");
  if (!(barred > 0.0)) return fail("barred must be > 0 s");
  if (!(moved > 0.0)) return fail("moved must be > 0 m");
  if (!(turned_away > 0.0)) return fail("turned_away must be > 0 s");
  if (!(home_tolerance > 0.0)) return fail("home_tolerance must be > 0 m");
  if (!(patience >= 0.0)) return fail("patience must be >= 0 s");
  if (!(forget >= 0.0)) return fail("forget must be >= 0 s");
  if (!(enclosed >= 0.0)) return fail("enclosed must be >= 0 s");
  return {};
}

ExplorationDrive::ExplorationDrive(const ExplorationDriveParams& params, Explorer explorer, Point2 home)
    : params_{params}, explorer_{std::move(explorer)}, home_{home} {
  explorer_.set_home(home);
}

void ExplorationDrive::set_home(Point2 home) {
  home_ = home;
  explorer_.set_home(home);
}

void ExplorationDrive::set_way(std::vector<Point2> cells) { way_ = smoothed(cells); }

void ExplorationDrive::note_held_up(Point2 robot, bool stays, Time now) {
  Point2 at = way_.back();
  for (const Point2 point : way_) {
    if (distance(point, robot) < kBlockedAhead) continue;
    at = point;
    break;
  }
  note_failure(way_.back(), robot, stays);
  obstacles_.push_back({at, now + seconds(params_.turned_away), stays});
  if (state_ == State::returning) {
    ++held_up_on_way_home_;
    wants_room_ = true;
  }
  progress_ = now;
}

void ExplorationDrive::forget_what_may_go() {
  std::erase_if(obstacles_, [](const Obstacle& obstacle) { return !obstacle.stays; });
}

void ExplorationDrive::note_progress(Point2 robot, bool waits, Time now, Hindrance hindrance) {
  // Who knows no way is not held up on it.
  if (waits || !progress_ || way_.empty() || distance(robot, last_progress_) >= params_.moved) {
    last_progress_ = robot;
    progress_ = now;
  }
  std::erase_if(obstacles_, [&](const Obstacle& obstacle) { return !obstacle.stays && obstacle.until <= now; });
  const double patience = hindrance == Hindrance::ground ? params_.barred : params_.held_up;
  const bool stays = hindrance == Hindrance::ground || hindrance == Hindrance::thing;
  // On its way home it goes by whatever opens.
  if (now - *progress_ >= seconds(patience) && !way_.empty())
    note_held_up(robot, stays && state_ == State::exploring, now);
  explorer_.unblock();
  for (const Obstacle& obstacle : obstacles_) {
    // Never so wide that the robot stands within it.
    const double radius = std::min(kBlockedRadius, distance(obstacle.place, robot) - 0.1);
    if (radius > 0.0) explorer_.block(obstacle.place, radius);
  }
}

void ExplorationDrive::note_failure(Point2 goal, Point2 robot, bool stays) {
  auto known = std::find_if(failures_.begin(), failures_.end(),
                            [&](const Failure& failure) { return distance(failure.goal, goal) < kOneGoal; });
  if (known == failures_.end()) known = failures_.insert(failures_.end(), {goal, 0});
  const bool is_there = distance(goal, robot) < kBlockedAhead;
  if (++known->times >= kTriesAGoal || is_there || stays) explorer_.give_up(goal, kOneGoal);
}

/// Two places may each look worse when the robot comes near, and it would drive to and fro between them for ever.
void ExplorationDrive::note_choice(Point2 goal) {
  auto known = std::find_if(choices_.begin(), choices_.end(),
                            [&](const Choice& choice) { return distance(choice.goal, goal) < kOneGoal; });
  if (known == choices_.end()) known = choices_.insert(choices_.end(), {goal, 0, driven_ - kDrivenBetween});
  if (driven_ - known->at < kDrivenBetween) return;
  known->at = driven_;
  if (++known->times >= kMostChoices) explorer_.give_up(goal, kOneGoal);
}

bool ExplorationDrive::explore(const OccupancyGrid& map, Point2 robot) {
  auto next = explorer_.next(map, robot);
  frontier_ = next ? next->frontier : 0;
  if (!next) return false;
  const Point2 goal = next->way.back();
  if (way_.empty() || distance(way_.back(), goal) > kOneGoal) note_choice(goal);
  set_way(std::move(next->way));
  return true;
}

bool ExplorationDrive::is_stuck_for(double most_s, Time now) {
  if (!stuck_) stuck_ = now;
  if (now - *stuck_ < seconds(most_s)) return false;
  stuck_.reset();
  return true;
}

std::vector<Point2> ExplorationDrive::way_home(const OccupancyGrid& map, Point2 robot) const {
  std::vector<Point2> way = explorer_.way_to(map, robot, home_);
  return way.empty() ? explorer_.way_to(map, robot, home_, true) : way;
}

void ExplorationDrive::go_home(const OccupancyGrid& map, Point2 robot, Time now) {
  set_way(way_home(map, robot));
  if (!way_.empty()) stuck_.reset();
  if (stuck_ && now - *stuck_ >= seconds(params_.forget)) obstacles_.clear();
  const bool is_there = distance(robot, home_) < params_.home_tolerance;
  const bool is_lost = way_.empty() && is_stuck_for(params_.enclosed, now);
  if (!is_there && !is_lost && held_up_on_way_home_ < kTriesHome) return;
  state_ = State::arrived;
  is_enclosed_ = is_lost && !is_there;
  way_.clear();
}

/// From where it stands it does not get through, though it came through: it goes to where there is room, and tries
/// anew. @returns whether there is any
bool ExplorationDrive::backs_off(const OccupancyGrid& map, Point2 robot, Time now) {
  std::vector<Point2> way = explorer_.way_to_room(map, robot);
  if (way.empty()) return false;
  set_way(std::move(way));
  backs_off_until_ = now + kBacksOff;
  return true;
}

bool ExplorationDrive::is_backing_off(Point2 robot, Time now) {
  constexpr double kThere = 0.25;  // [m]
  if (!backs_off_until_) return false;
  if (now < *backs_off_until_ && !way_.empty() && distance(robot, way_.back()) > kThere) return true;
  backs_off_until_.reset();
  progress_ = now;
  return false;
}

void ExplorationDrive::plan(const OccupancyGrid& map, Point2 robot, bool waits, Time now, Hindrance hindrance) {
  if (state_ == State::arrived) return;
  if (last_) driven_ += distance(*last_, robot);
  last_ = robot;
  note_progress(robot, waits, now, hindrance);
  if (is_backing_off(robot, now)) return;
  if (std::exchange(wants_room_, false) && backs_off(map, robot, now)) return;
  if (explore(map, robot)) {
    state_ = State::exploring;
    stuck_.reset();
    return;
  }
  if (state_ == State::returning) return go_home(map, robot, now);
  way_.clear();
  if (stuck_ && now - *stuck_ >= seconds(params_.forget)) forget_what_may_go();
  bool is_enclosed = way_home(map, robot).empty();
  // It came in, so what it thinks to stand there does not shut it in: the places beyond are given up, the ways are not.
  if (is_enclosed && stuck_ && now - *stuck_ >= seconds(params_.forget) && !obstacles_.empty()) {
    obstacles_.clear();
    explorer_.unblock();
    progress_ = now;
    if (backs_off(map, robot, now)) return;
    is_enclosed = way_home(map, robot).empty();
  }
  if (!is_stuck_for(is_enclosed ? params_.enclosed : params_.patience, now)) return;
  state_ = State::returning;
  obstacles_.clear();
  explorer_.unblock();
  go_home(map, robot, now);
}

ExplorationDrive::Ahead ExplorationDrive::ahead(Point2 robot) const {
  constexpr double kSpacing = 0.2;  // [m]
  Ahead result;
  if (way_.empty()) return result;
  const auto nearest = std::min_element(way_.begin(), way_.end(),
                                        [&](Point2 a, Point2 b) { return distance(a, robot) < distance(b, robot); });
  double length = 0.0;
  for (auto point = nearest; point != way_.end(); ++point) {
    if (point != nearest) length += distance(*(point - 1), *point);
    if (length > params_.horizon) return result;
    if (result.via.empty() || distance(result.via.back(), *point) >= kSpacing) result.via.push_back(*point);
  }
  if (result.via.empty() || distance(result.via.back(), way_.back()) > 0.0) result.via.push_back(way_.back());
  result.is_final = true;
  return result;
}

}  // namespace docent::planning
