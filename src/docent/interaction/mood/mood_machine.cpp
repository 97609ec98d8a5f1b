#include "docent/interaction/mood/mood_machine.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace docent::interaction {
namespace {

constexpr std::array kOrder{Mood::happy, Mood::neutral, Mood::sad, Mood::angry};  // as a blockage lasts

Mood after(Mood mood, bool is_blocked) {
  for (std::size_t i = 0; i < kOrder.size(); ++i) {
    if (kOrder.at(i) != mood) continue;
    if (is_blocked) return kOrder.at(i + 1 < kOrder.size() ? i + 1 : i);
    return kOrder.at(i > 0 ? i - 1 : 0);
  }
  return mood;
}

}  // namespace

Result<void> MoodParams::validate() const {
  if (!(to_neutral_s > 0.0)) return fail("mood.to_neutral_s must be > 0");
  if (!(to_sad_s > 0.0)) return fail("mood.to_sad_s must be > 0");
  if (!(to_angry_s > 0.0)) return fail("mood.to_angry_s must be > 0");
  if (!(calm_s > 0.0)) return fail("mood.calm_s must be > 0");
  if (!(glide_s > 0.0)) return fail("mood.glide_s must be > 0");
  if (!(sad_valence >= -1.0 && sad_valence <= 0.0)) return fail("mood.sad_valence must be -1..0");
  return {};
}

MoodMachine::MoodMachine(const MoodParams& params, const Rng& rng)
    : params_{params}, rng_{rng}, hazard_left_{rng_.exponential(1.0)} {}

double MoodMachine::rate(bool is_blocked) const {
  if (!is_blocked) return mood_ == Mood::happy ? 0.0 : 1.0 / params_.calm_s;
  switch (mood_) {
    case Mood::happy:
      return 1.0 / params_.to_neutral_s;
    case Mood::neutral:
      return 1.0 / params_.to_sad_s;
    case Mood::sad:
      return 1.0 / params_.to_angry_s;
    case Mood::angry:
      return 0.0;
  }
  return 0.0;
}

double MoodMachine::valence_of(Mood mood) const {
  switch (mood) {
    case Mood::happy:
      return 1.0;
    case Mood::neutral:
      return 0.0;
    case Mood::sad:
      return params_.sad_valence;
    case Mood::angry:
      return -1.0;
  }
  return 0.0;
}

void MoodMachine::glide(double seconds) {
  const double target = valence_of(mood());
  valence_ = target + (valence_ - target) * std::exp(-seconds / params_.glide_s);
}

void MoodMachine::step(bool is_blocked, Time now) {
  double left = last_ ? std::max(0.0, to_seconds(now - *last_)) : 0.0;
  if (!last_ || now > *last_) last_ = now;
  while (left > 0.0) {
    const double present = rate(is_blocked);
    if (present <= 0.0 || present * left < hazard_left_) {
      hazard_left_ -= present * left;
      glide(left);
      return;
    }
    const double until_change = hazard_left_ / present;
    glide(until_change);
    left -= until_change;
    mood_ = after(mood_, is_blocked);
    hazard_left_ = rng_.exponential(1.0);
  }
}

}  // namespace docent::interaction
