#include "docent/collision_avoidance/plausibility/old_sweeps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace docent::collision_avoidance {

void OldSweeps::forget() {
  reference_.reset();
  trail_.clear();
  is_trail_cut_ = true;
  looks_.clear();
  row_ = 0;
  said_ = {};
}

void OldSweeps::follow(const SweepView& view) {
  double heading = 0.0;
  if (!trail_.empty()) {
    const Pose2 moved = inverse(trail_.back().odom_from_sensor) * view.odom_from_sensor;
    heading = trail_.back().heading + moved.theta.radians();
  }
  trail_.push_back({view.stamp, heading, view.odom_from_sensor});
  const Duration memory = seconds(params_.window + params_.longest + params_.most_lag);
  while (view.stamp - trail_.front().stamp > memory) trail_.pop_front();
  while (!looks_.empty() && view.stamp - looks_.front().stamp > seconds(params_.window)) looks_.pop_front();
}

bool OldSweeps::has_turned() const {
  const auto [least, most] = std::minmax_element(trail_.begin(), trail_.end(),
                                                 [](const Step& a, const Step& b) { return a.heading < b.heading; });
  return most->heading - least->heading >= params_.turned;
}

OldSweeps::Fit OldSweeps::fit_of(const SweepView& view, const Motion& motion, const Pose2& base_from_sensor) {
  const Angle half = Angle::radians(0.5 * motion.turn);
  const Point2 at = motion.way * unit(half);
  const Pose2 then_from_now{at.x, at.y, Angle::radians(motion.turn)};
  const Pose2 now_from_then = inverse(base_from_sensor) * inverse(then_from_now) * base_from_sensor;
  const Agreement agreement = agreement_of(*reference_, now_from_then, view, expected_, params_.law);
  return {motion, agreement.compared >= params_.law.least ? agreement.share : -1.0};
}

OldSweeps::Fit OldSweeps::best_near(const SweepView& view, Fit best, const Pose2& base_from_sensor) {
  for (int step = 0; step < params_.steps; ++step) {
    const Motion from = best.motion;
    for (const double turn : {-params_.step_turn, params_.step_turn}) {
      const Fit fit = fit_of(view, {from.way, from.turn + turn}, base_from_sensor);
      if (fit.share > best.share) best = fit;
    }
    for (const double way : {-params_.step_way, params_.step_way}) {
      const Fit fit = fit_of(view, {from.way + way, from.turn}, base_from_sensor);
      if (fit.share > best.share) best = fit;
    }
    if (best.motion.turn == from.turn && best.motion.way == from.way) break;
  }
  return best;
}

std::optional<OldSweeps::Motion> OldSweeps::measure(const SweepView& view, const Pose2& base_from_sensor) {
  const Pose2 moved =
      base_from_sensor * inverse(reference_->odom_from_sensor) * view.odom_from_sensor * inverse(base_from_sensor);
  const Point2 ahead = unit(Angle::radians(0.5 * moved.theta.radians()));
  const Fit by_wheels = fit_of(view, {moved.x * ahead.x + moved.y * ahead.y, moved.theta.radians()}, base_from_sensor);
  if (by_wheels.share >= params_.surely_fits) return by_wheels.motion;
  // As it was, or going on as it went; what is near to that is looked for.
  Fit best = fit_of(view, last_, base_from_sensor);
  const Motion onwards{2.0 * last_.way - before_.way, 2.0 * last_.turn - before_.turn};
  if (const Fit fit = fit_of(view, onwards, base_from_sensor); fit.share > best.share) best = fit;
  best = best_near(view, best, base_from_sensor);
  if (by_wheels.share >= best.share - params_.than_wheels) best = by_wheels;
  if (best.share < params_.fits) return std::nullopt;
  return best.motion;
}

void OldSweeps::refer_to(const SweepView& view) {
  reference_ = view;
  last_ = before_ = {};
}

double OldSweeps::heading_at(Time time) const {
  const auto after = std::lower_bound(trail_.begin(), trail_.end(), time,
                                      [](const Step& step, Time when) { return step.stamp < when; });
  if (after == trail_.end()) return trail_.back().heading;
  if (after == trail_.begin()) return trail_.front().heading;
  const Step& before = *std::prev(after);
  const double share = to_seconds(time - before.stamp) / std::max(1e-6, to_seconds(after->stamp - before.stamp));
  return before.heading + share * (after->heading - before.heading);
}

double OldSweeps::left_by(double lag, Time since, double most) const {
  constexpr double kRounding = 1.001;
  const double enough = kRounding * most * most * static_cast<double>(looks_.size());
  double sum = 0.0;
  int count = 0;
  for (const Look& look : looks_) {
    if (look.stamp < since) continue;
    const double then = heading_at(look.stamp - seconds(lag)) - heading_at(look.from - seconds(lag));
    sum += (look.turn - then) * (look.turn - then);
    ++count;
    if (sum > enough) return std::numeric_limits<double>::infinity();
  }
  return std::sqrt(sum / std::max(1, count));
}

double OldSweeps::left_by_slip() const {
  // turn = a * time + b * odometry's turn
  double tt = 0.0, to = 0.0, oo = 0.0, ts = 0.0, os = 0.0;
  for (const Look& look : looks_) {
    const double time = to_seconds(look.stamp - look.from);
    const double odometry = heading_at(look.stamp) - heading_at(look.from);
    tt += time * time;
    to += time * odometry;
    oo += odometry * odometry;
    ts += time * look.turn;
    os += odometry * look.turn;
  }
  const double determinant = tt * oo - to * to;
  double a = tt > 0.0 ? ts / tt : 0.0;
  double b = 0.0;
  if (determinant > 1e-6 * tt * oo) {
    a = (ts * oo - os * to) / determinant;
    b = (os * tt - ts * to) / determinant;
  }
  double sum = 0.0;
  for (const Look& look : looks_) {
    const double odometry = heading_at(look.stamp) - heading_at(look.from);
    const double left = look.turn - a * to_seconds(look.stamp - look.from) - b * odometry;
    sum += left * left;
  }
  return std::sqrt(sum / static_cast<double>(looks_.size()));
}

std::optional<double> OldSweeps::lag() const {
  if (looks_.size() < params_.looks) return std::nullopt;
  const bool is_enough = std::any_of(looks_.begin(), looks_.end(),
                                     [&](const Look& look) { return std::abs(look.turn) >= params_.least_turn; });
  if (!is_enough) return std::nullopt;
  double best_lag = 0.0;
  double best = params_.exact;
  const int lags = static_cast<int>(std::lround(params_.most_lag / params_.lag_step));
  const auto is_soon = [&](int i) { return i * params_.lag_step < params_.least_lag; };
  // Before the trail begins it is not known how the robot moved.
  const auto is_known = [&](double lag) {
    return !is_trail_cut_ || looks_.front().from - seconds(lag) >= trail_.front().stamp;
  };
  for (int i = 0; i <= lags && is_known(i * params_.lag_step); ++i) {
    if (is_soon(i)) continue;
    const double left = left_by(i * params_.lag_step, {}, best);
    if (left > best || (left == best && best_lag > 0.0)) continue;
    best = left;
    best_lag = i * params_.lag_step;
  }
  if (best_lag == 0.0) return std::nullopt;
  const Time newest = looks_.back().stamp - seconds(params_.newest);
  double otherwise = std::min(left_by_slip(), left_by(0.0, newest));
  for (int i = 0; is_soon(i); ++i) otherwise = std::min(otherwise, left_by(i * params_.lag_step));
  const bool is_old = otherwise >= params_.otherwise && otherwise >= params_.better * best;
  return is_old ? std::optional{best_lag} : std::nullopt;
}

void OldSweeps::judge(const SweepView& view) {
  const Look& look = looks_.back();
  if (said_ != Time{} && look.from >= said_) {
    const double old = heading_at(look.stamp - seconds(lag_)) - heading_at(look.from - seconds(lag_));
    const double now = heading_at(look.stamp) - heading_at(look.from);
    if (std::abs(old - now) < params_.stops) return;
    is_refuted_ = std::abs(look.turn - now) < 0.5 * std::abs(look.turn - old);
    said_ = {};
    if (is_refuted_) {
      looks_.clear();
      row_ = 0;
      return;
    }
  }
  const auto found = lag();
  row_ = !found ? 0 : std::abs(*found - lag_) <= params_.same_lag ? row_ + 1 : 1;
  lag_ = found.value_or(0.0);
  if (row_ != params_.sure) return;
  said_ = view.stamp;
  refer_to(view);
}

std::optional<double> OldSweeps::add(const SweepView& view, const Pose2& base_from_sensor) {
  follow(view);
  is_refuted_ = false;
  if (!reference_) {
    refer_to(view);
    return std::nullopt;
  }
  if (view.stamp - looked_ < seconds(params_.between)) return std::nullopt;
  looked_ = view.stamp;
  const double age = to_seconds(view.stamp - reference_->stamp);
  if (!has_turned()) {
    if (age > 0.5 * params_.longest) refer_to(view);
    return std::nullopt;
  }
  const auto motion = measure(view, base_from_sensor);
  if (!motion) {
    refer_to(view);
    row_ = 0;
    return std::nullopt;
  }
  before_ = std::exchange(last_, *motion);
  looks_.push_back({reference_->stamp, view.stamp, motion->turn});
  if (age > params_.longest || std::abs(motion->turn) > params_.widest || std::abs(motion->way) > params_.farthest)
    refer_to(view);
  judge(view);
  return row_ >= params_.sure ? std::optional{lag_} : std::nullopt;
}

}  // namespace docent::collision_avoidance
