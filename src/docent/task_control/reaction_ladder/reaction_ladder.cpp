#include "docent/task_control/reaction_ladder/reaction_ladder.h"

namespace docent::task_control {

Result<void> LadderParams::validate() const {
  if (!(horn_after_s >= 0.0)) return fail("ladder.horn_after_s must be >= 0");
  if (!(horn_every_s > 0.0)) return fail("ladder.horn_every_s must be > 0");
  if (!(wait_after_s > 0.0)) return fail("ladder.wait_after_s must be > 0");
  if (!(ask_after_s >= wait_after_s)) return fail("ladder.ask_after_s must be >= wait_after_s");
  if (!(ask_every_s > 0.0)) return fail("ladder.ask_every_s must be > 0");
  if (!(patience_s > ask_after_s)) return fail("ladder.patience_s must be > ask_after_s");
  if (!(unreachable_patience_s > 0.0)) return fail("ladder.unreachable_patience_s must be > 0");
  if (!(thing_patience_s > 0.0)) return fail("ladder.thing_patience_s must be > 0");
  if (!(calm_s > 0.0)) return fail("ladder.calm_s must be > 0");
  if (!(flicker_s >= 0.0)) return fail("ladder.flicker_s must be >= 0");
  if (!(driving_s > 0.0)) return fail("ladder.driving_s must be > 0");
  return {};
}

std::vector<LadderStep> ReactionLadder::step(const LadderView& view, Time now) {
  std::vector<LadderStep> steps;
  if (!params_.active) return steps;
  const bool is_stuck = view.is_unreachable || view.is_in_vain || view.without_progress_s >= params_.wait_after_s;
  if (!episode_) {
    const bool is_new_way = view.detour != detour_ && view.detour != planning::Detour::none;
    if (!is_new_way) detour_ = view.detour;
    if (!view.is_hindered && !is_stuck && !is_new_way) return steps;
    episode_ = Episode{};
    episode_->began = now;
  }
  look(view, now);
  climb(view, now, steps);
  if (episode_->calm_since && now - *episode_->calm_since >= seconds(params_.calm_s)) {
    take(Rung::free, view, now, steps);
    episode_.reset();
  }
  return steps;
}

void ReactionLadder::look(const LadderView& view, Time now) {
  Episode& episode = *episode_;
  if (view.is_hindered || view.is_thing) episode.by_thing = view.is_thing;
  if (view.is_hindered && view.is_unmapped) {
    episode.unmapped_seen = now;
    if (!episode.unmapped_since) episode.unmapped_since = now;
  } else if (!episode.unmapped_seen || now - *episode.unmapped_seen > seconds(params_.flicker_s)) {
    episode.unmapped_since.reset();
  }
  if (!view.is_unreachable) {
    episode.unreachable_since.reset();
  } else if (!episode.unreachable_since) {
    episode.unreachable_since = now;
  }
  const bool is_calm =
      !view.is_hindered && !view.is_unreachable && !view.is_in_vain && view.without_progress_s < params_.driving_s;
  if (!is_calm) {
    episode.calm_since.reset();
  } else if (!episode.calm_since) {
    episode.calm_since = now;
  }
  if (is_calm) episode.waits = false;
}

void ReactionLadder::take(Rung rung, const LadderView& view, Time now, std::vector<LadderStep>& steps) {
  episode_->last[rung] = now;
  steps.push_back({rung, view.cause, to_seconds(now - episode_->began), ++episode_->counts[rung]});
}

bool ReactionLadder::is_due_again(Rung rung, double period_s, Time now) const {
  const auto last = episode_->last.find(rung);
  return last == episode_->last.end() || now - last->second >= seconds(period_s);
}

void ReactionLadder::climb(const LadderView& view, Time now, std::vector<LadderStep>& steps) {
  Episode& episode = *episode_;
  if (view.is_hindered && !episode.was_hindered) {
    episode.was_hindered = true;
    take(Rung::slow, view, now, steps);
  }
  const auto lasts = [&](const std::optional<Time>& since, double long_s) {
    return since && now - *since >= seconds(long_s);
  };
  // Two signs must coincide: something that is not in the map, and no progress.
  if (lasts(episode.unmapped_since, params_.horn_after_s) && !episode.by_thing &&
      view.without_progress_s >= params_.horn_after_s && is_due_again(Rung::horn, params_.horn_every_s, now)) {
    take(Rung::horn, view, now, steps);
  }
  if (view.detour != detour_) {
    detour_ = view.detour;
    if (view.detour == planning::Detour::local) take(Rung::local_detour, view, now, steps);
    if (view.detour == planning::Detour::global) take(Rung::global_detour, view, now, steps);
  }
  const bool is_stuck = view.is_unreachable || view.without_progress_s >= params_.wait_after_s;
  if (is_stuck && !episode.waits) {
    episode.waits = true;
    take(Rung::wait, view, now, steps);
  }
  const bool may_ask =
      view.without_progress_s >= params_.ask_after_s || lasts(episode.unreachable_since, params_.ask_after_s);
  if (params_.asks && may_ask && !episode.by_thing && is_due_again(Rung::ask, params_.ask_every_s, now))
    take(Rung::ask, view, now, steps);
  const double patience_s = episode.by_thing ? params_.thing_patience_s : params_.patience_s;
  if (view.is_in_vain || view.without_progress_s >= patience_s ||
      lasts(episode.unreachable_since, params_.unreachable_patience_s)) {
    if (episode.counts[Rung::give_up] == 0) take(Rung::give_up, view, now, steps);
  }
}

}  // namespace docent::task_control
