#include "docent/task_control/navigation_goals/navigation_goals.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace docent::task_control {
namespace {

constexpr double kFarthest = 10'000.0;   // [m] as the mission allows
constexpr double kShownSpeed_s = 5.0;    // [s] of driving, after which the robot has shown its speed
constexpr double kLeastSpeed = 0.05;     // [m/s] so that a robot that waits is not reckoned to wait for ever
constexpr double kLargestStep_m = 1.0;   // a pose farther from the last one is no drive
constexpr double kLongestPause_s = 1.0;  // [s] between two ticks that count as driving

bool is_place(const Pose2& pose) { return std::abs(pose.x) < kFarthest && std::abs(pose.y) < kFarthest; }

std::string target_of(const Pose2& pose, bool is_last) {
  char text[64];
  if (is_last)
    std::snprintf(text, sizeof text, "%.2f,%.2f,%.3f", pose.x, pose.y, pose.theta.radians());
  else
    std::snprintf(text, sizeof text, "%.2f,%.2f", pose.x, pose.y);
  return text;
}

}  // namespace

std::optional<Angle> heading_of(double x, double y, double z, double w) {
  constexpr double kRounding = 0.05;  // of the length: clients write two digits
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  if (!(std::abs(length - 1.0) <= kRounding)) return std::nullopt;
  return Angle::radians(std::atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z));
}

std::string NavigationGoalParams::fault() const {
  if (!(resend_s > 0.0)) return "resend_s must be > 0";
  if (!(silence_s > resend_s)) return "silence_s must be > resend_s";
  if (!(gone_s > 0.0)) return "gone_s must be > 0";
  if (!(speed > 0.0)) return "speed must be > 0";
  if (most_poses < 1 || most_poses > 1000) return "most_poses must be in 1..1000";
  return {};
}

std::string NavigationGoals::refusal(const NavigationGoal& goal) const {
  if (goal.map_from_base.empty()) return "the goal has no pose";
  if (goal.map_from_base.size() > static_cast<std::size_t>(params_.most_poses))
    return "the goal has more than " + std::to_string(params_.most_poses) + " poses";
  if (!std::all_of(goal.map_from_base.begin(), goal.map_from_base.end(), is_place))
    return "a pose of the goal is no place";
  return {};
}

void NavigationGoals::begin(NavigationGoal goal, Time now) {
  tick(now);
  if (present_) {
    const bool is_cancelled = present_->cancel_began.has_value();
    if (!is_cancelled) withdraw(now);
    end(is_cancelled ? GoalOutcome::canceled : GoalOutcome::aborted, "replaced");
  }
  present_.emplace();
  present_->goal = std::move(goal);
  present_->began = now;
  heard_ = now;
  request_next(now);
}

void NavigationGoals::request_next(Time now) {
  Present& present = *present_;
  const auto& poses = present.goal.map_from_base;
  const bool is_last = present.at + 1 == poses.size();
  present.request = {request_id(now, present.goal.id, present.requests++), RequestKind::point,
                     target_of(poses.at(present.at), is_last)};
  present.is_on_board = false;
  present.is_active = false;
  present.requested = now;
  present.sent = now;
  send(present.request);
}

void NavigationGoals::withdraw(Time now) {
  Present& present = *present_;
  const std::string id = request_id(now, present.goal.id, present.requests++);
  withdrawals_.push_back({present.request.id, {id, RequestKind::cancel, present.request.id}, now});
  send(withdrawals_.back().cancel);
}

void NavigationGoals::end(GoalOutcome outcome, std::string reason) {
  actions_.ends.push_back({present_->goal.id, outcome, std::move(reason)});
  present_.reset();
}

void NavigationGoals::cancel(const GoalId& id, Time now) {
  tick(now);
  if (!present_ || present_->goal.id != id || present_->cancel_began) return;
  present_->cancel_began = now;
  withdraw(now);
}

void NavigationGoals::deactivate(Time now) {
  tick(now);
  if (!present_) return;
  if (!present_->cancel_began) withdraw(now);
  end(present_->cancel_began ? GoalOutcome::canceled : GoalOutcome::aborted, "deactivated");
}

void NavigationGoals::board(std::span<const RequestNews> all, Time now) {
  tick(now);
  const auto find = [&](const std::string& id) -> const RequestNews* {
    const auto place = std::find_if(all.begin(), all.end(), [&](const RequestNews& news) { return news.id == id; });
    return place == all.end() ? nullptr : &*place;
  };
  if (present_) {
    const RequestNews* news = find(present_->request.id);
    // A robot whose store is gone knows nothing of it any more: it is told again.
    if (news == nullptr && present_->is_on_board) present_->requested = now;
    present_->is_on_board = news != nullptr;
    present_->is_active = news != nullptr && news->status == RequestStatus::active;
    if (news != nullptr) judge(*news, now);
  }
  std::erase_if(withdrawals_, [&](const Withdrawal& withdrawal) {
    const RequestNews* request = find(withdrawal.request);
    const bool is_over = request != nullptr && !docent::is_open(request->status);
    const bool is_done = is_over || find(withdrawal.cancel.id) != nullptr;
    if (is_done && present_ && present_->cancel_began && present_->request.id == withdrawal.request)
      end(GoalOutcome::canceled, to_text(ReasonWord::cancelled));
    return is_done;
  });
}

void NavigationGoals::judge(const RequestNews& news, Time now) {
  Present& present = *present_;
  switch (news.status) {
    case RequestStatus::queued:
    case RequestStatus::active:
      return;
    case RequestStatus::fulfilled:
      if (++present.at == present.goal.map_from_base.size()) return end(GoalOutcome::succeeded, "");
      if (present.cancel_began) return end(GoalOutcome::canceled, to_text(ReasonWord::cancelled));
      return request_next(now);
    case RequestStatus::cancelled:
    case RequestStatus::failed:
    case RequestStatus::refused:
      end(present.cancel_began ? GoalOutcome::canceled : GoalOutcome::aborted,
          news.reason.empty() ? to_text(news.status) : news.reason);
  }
}

void NavigationGoals::drive(double remaining_m, bool is_blocked, Time now) {
  tick(now);
  heard_ = now;
  remaining_m_ = std::isfinite(remaining_m) ? std::max(0.0, remaining_m) : 0.0;
  const bool was_blocked = std::exchange(is_blocked_, is_blocked);
  if (is_blocked && !was_blocked && present_ && present_->is_active) ++present_->blocked;
}

void NavigationGoals::pose(const Pose2& map_from_base) {
  if (!is_place(map_from_base)) return;
  if (present_ && present_->is_active && map_from_base_) {
    const double step = distance(map_from_base.position(), map_from_base_->position());
    if (step < kLargestStep_m) present_->driven_m += step;
  }
  map_from_base_ = map_from_base;
}

void NavigationGoals::begin_time_anew(Time now) {
  heard_ = now;
  for (Withdrawal& withdrawal : withdrawals_) withdrawal.sent = now;
  if (!present_) return;
  present_->began = present_->requested = present_->sent = now;
  if (present_->cancel_began) present_->cancel_began = now;
}

void NavigationGoals::tick(Time now) {
  if (now < now_) begin_time_anew(now);
  const double passed_s = to_seconds(now - std::exchange(now_, now));
  const Duration period = seconds(params_.resend_s);
  for (Withdrawal& withdrawal : withdrawals_) {
    if (now - withdrawal.sent < period) continue;
    withdrawal.sent = now;
    send(withdrawal.cancel);
  }
  if (!present_) return;
  Present& present = *present_;
  if (present.is_active && passed_s > 0.0 && passed_s < kLongestPause_s) present.driving_s += passed_s;
  const bool is_unheard = !present.is_on_board && now - present.requested >= seconds(params_.silence_s);
  const bool is_uncancelled = present.cancel_began && now - *present.cancel_began >= seconds(params_.silence_s);
  if (is_unheard || is_uncancelled || now - heard_ >= seconds(params_.gone_s)) {
    if (!present.cancel_began) withdraw(now);
    return end(GoalOutcome::aborted, "robot_silent");
  }
  if (present.is_on_board || present.cancel_began || now - present.sent < period) return;
  present.sent = now;
  send(present.request);
}

std::optional<GoalProgress> NavigationGoals::progress(Time now) const {
  if (!present_) return std::nullopt;
  const Present& present = *present_;
  const auto& poses = present.goal.map_from_base;
  GoalProgress progress{present.goal.id, map_from_base_};
  if (present.is_active) {
    progress.distance_m = remaining_m_;
  } else if (map_from_base_) {
    progress.distance_m = distance(map_from_base_->position(), poses.at(present.at).position());
  }
  for (std::size_t i = present.at + 1; i < poses.size(); ++i)
    progress.distance_m += distance(poses[i - 1].position(), poses[i].position());
  const bool has_shown = present.driving_s >= kShownSpeed_s;
  const double speed = has_shown ? std::max(kLeastSpeed, present.driven_m / present.driving_s) : params_.speed;
  progress.navigation_s = std::max(0.0, to_seconds(now - present.began));
  progress.remaining_s = progress.distance_m / speed;
  progress.poses_remaining = static_cast<int>(poses.size() - present.at);
  progress.blocked = present.blocked;
  return progress;
}

}  // namespace docent::task_control
