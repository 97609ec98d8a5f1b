#include "docent/interaction/head/head_control.h"

namespace docent::interaction {
namespace {

constexpr Duration kHeadStaleAfter = std::chrono::seconds{1};    // whoever is silent for so long may be dead
constexpr Duration kMouthClosesAfter = std::chrono::seconds{1};  // should the voice die in the middle of a line

}  // namespace

HeadControl::HeadControl(const Params& params, const Rng& rng)
    : mood_{params.mood, rng}, gaze_choice_{params.gaze}, neck_{params.neck} {}

void HeadControl::block(Time now) { blocked_until_ = now + kHeadStaleAfter; }

void HeadControl::want(std::optional<Angle> heading, Time now) {
  wanted_ = heading;
  wanted_at_ = now;
}

void HeadControl::speech(bool is_speaking, Time start, double duration_s) {
  speech_end_ = is_speaking ? std::optional{start + seconds(duration_s)} : std::nullopt;
}

HeadShown HeadControl::step(const HeadSurroundings& around, Time now) {
  const bool is_blocked = now < blocked_until_;
  mood_.put_on(is_mingling() && !is_blocked ? task_.face : std::nullopt);
  mood_.step(is_blocked, now);
  const GazeTarget target = gaze_choice_.choose(view(around, now), now);
  neck_.step(target, now);
  const bool is_speaking = speech_end_ && now <= *speech_end_ + kMouthClosesAfter;
  return {mood_.mood(), mood_.valence(), is_speaking, target.at, neck_.pan(), neck_.tilt()};
}

bool HeadControl::is_under_way() const {
  const bool is_over = !state_.status || state_.status == TaskStatus::done || state_.status == TaskStatus::failed;
  return !task_.id.empty() && state_.id == task_.id && !is_over;
}

HeadView HeadControl::view(const HeadSurroundings& around, Time now) const {
  HeadView view;
  view.is_blocked = now < blocked_until_;
  view.people = around.people;
  if (around.odom_from_base && wanted_ && now - wanted_at_ <= kHeadStaleAfter)
    view.wanted = *wanted_ - around.odom_from_base->theta;
  if (pointed_ && around.map_from_base) view.pointed = inverse(*around.map_from_base) * *pointed_;
  if (task_.id.empty()) return view;
  view.task = task_.kind;
  if (state_.id == task_.id) view.status = state_.status;
  if (is_under_way()) view.look = state_.look;
  if (is_mingling()) view.company = task_.gaze.value_or(GazeStrategy::nearest);
  if (task_.shows && around.map_from_base) view.exhibit = inverse(*around.map_from_base) * *task_.shows;
  return view;
}

}  // namespace docent::interaction
