#include "docent/collision_avoidance/plausibility/scanner_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace docent::collision_avoidance {
namespace {

constexpr float kNoReading = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kSamples = 180;

/// A run of samples as beams of the sweep that was thinned to them.
BeamRun beams_of(const BeamRun& samples, const SweepView& view, const SensorSweep& sweep) {
  const auto stride = static_cast<std::size_t>(std::lround(view.bearing_step / sweep.bearing_step));
  const bool is_last = samples.end == view.ranges.size();
  return {samples.first * stride, is_last ? sweep.ranges.size() : samples.end * stride};
}

}  // namespace

ScannerWatch::ScannerWatch(std::string name, const BaseLimits& limits,
                           std::shared_ptr<const sensor_models::RayCaster> walls, const ScannerWatchParams& params)
    : name_{std::move(name)},
      limits_{limits},
      params_{params},
      map_{std::move(walls), params.map},
      motion_{params.motion},
      repeats_{params.repeats},
      old_{params.old},
      succession_{limits, params.succession},
      sectors_{params.sectors},
      of_map_{params.sectors},
      near_{params.near},
      rings_{params.rings},
      straight_{params.straight},
      parallax_{params.parallax} {}

void ScannerWatch::convict(Lie lie, Time when) {
  if (!lie_) {
    lie_ = std::move(lie);
    lie_->first_sign = when;
  }
  lie_->last_sign = when;
  is_proven_ = false;
}

void ScannerWatch::follow_mount(const SensorSweep& sweep) {
  constexpr double kMatters = 0.02;      // [m] and
  constexpr double kMattersTurn = 0.01;  // [rad]: less lies within the noise
  const Pose2 moved = inverse(base_from_sensor_) * sweep.base_from_sensor;
  const bool is_first = newest_ == Time{};
  base_from_sensor_ = sweep.base_from_sensor;
  if (is_first || (norm(moved.position()) < kMatters && std::abs(moved.theta.radians()) < kMattersTurn)) return;
  if (lie_ && lie_->by == Lie::By::sweeps) return;  // it was seen to begin: that was no mount
  lie_.reset();
  lies_ = 0;
  before_.reset();
  forget_places();
  old_.forget();
  straight_.forget();
  parallax_.forget();
  word_ = {.broken = sweep.stamp, .remounted = sweep.stamp};
}

void ScannerWatch::judge_form(const SensorSweep& sweep) {
  form_ = form_of(sweep, std::max(sweep.min_range, near_.blind_within()), limits_, params_.form);
  const FormFault fault = form_.has_wrong_units ? FormFault::units
                          : form_.is_covered    ? FormFault::covered
                          : form_.is_silent     ? FormFault::silent
                                                : FormFault::none;
  if (fault != FormFault::none) {
    form_fault_ = fault;
    well_formed_ = 0;
  } else if (++well_formed_ >= params_.good_again) {
    form_fault_ = FormFault::none;
  }
}

void ScannerWatch::judge_silence(const SweepView& view) {
  is_silence_explained_ = false;
  if (!form_.is_silent) return;
  if (map_said_ != Time{} && view.stamp - map_said_ < seconds(params_.silence_map)) {
    is_silence_explained_ = map_has_nothing_;
    return;
  }
  if (!before_) return;
  // What was met last must by now lie out of reach, or out of the field.
  if (view.stamp - before_->stamp > seconds(params_.people_stay))
    expect(walls_of(*before_), inverse(view.odom_from_sensor) * before_->odom_from_sensor, view, expected_);
  const RangeLaw law = find_law(expected_, view, params_.law);
  is_silence_explained_ = law.compared <= params_.gone * before_->answers;
}

void ScannerWatch::follow_lie(const SweepView& view, const RangeLaw& law) {
  const int by_lie = count_by_law(surely_expected(view), view, lie_->law.scale, lie_->law.offset, params_.law);
  const double enough = params_.returns * law.compared;
  const bool is_as_before = law.as_expected >= enough && law.as_expected >= params_.clearly * by_lie;
  // A robot that was carried farther from a wall sees a factor, too: that is for the motion to find out.
  const bool lasts = by_lie >= enough && by_lie >= params_.clearly * law.as_expected;
  if (lasts && !may_try()) lie_->last_sign = view.stamp;
  lies_ = is_as_before ? lies_ + 1 : 0;
  if (lies_ < params_.sure) return;
  acquit();
  before_ = view;
}

ScannerWatch::Verdict ScannerWatch::verdict(const RangeLaw& law, Time since, std::span<const Word> others) const {
  Verdict found = Verdict::none;
  for (const Word& other : others) {
    if (other.newest < since) continue;
    if (other.unbroken < since || (other.law && is_same(*other.law, law))) return Verdict::borne_out;
    found = Verdict::carried_off;
  }
  return found;
}

void ScannerWatch::forget_places() {
  motion_.forget();
  parallax_.forget_place();
  walls_.reset();
  near_.forget();
  sectors_.forget_newest();
}

void ScannerWatch::begin_anew(const SweepView& view) {
  lies_ = 0;
  before_ = view;
  forget_places();
  is_proven_ = false;
}

void ScannerWatch::watch_for_breaks(const SweepView& view, std::span<const Word> others) {
  breaks_ = false;
  before_says_ = {};
  if (before_ && !form_.is_silent) {
    before_says_ = find_law(expected_, view, params_.law);
    const RangeLaw& law = before_says_;
    breaks_ = law.answered >= params_.breaks_least && law.answered_as_expected < params_.breaks * law.answered;
    if (law.answered >= params_.breaks_least) {
      word_.newest = view.stamp;
      word_.law.reset();
      if (breaks_) word_.unbroken = view.stamp;
    }
    if (breaks_ && word_.broken < before_->stamp) {
      word_.broken = view.stamp;
      forget_places();
    }
  }
  for (const Word& other : others) {
    if (other.broken <= joined_ || view.stamp - other.broken > seconds(params_.with_others)) continue;
    joined_ = other.broken;
    forget_places();
  }
}

std::vector<float> ScannerWatch::surely_expected(const SweepView& view) const {
  std::vector<float> sure = expected_;  // as a law is found: without what may well give no answer
  for (float& range : sure)
    if (range > params_.law.surely_within * view.max_range) range = kNoReading;
  return sure;
}

bool ScannerWatch::is_clear(const RangeLaw& law, const SweepView& view) const {
  const std::vector<float> sure = surely_expected(view);
  int compared = 0;
  int by_law = 0;
  int as_before = 0;
  for (std::size_t i = 0; i < sure.size(); ++i) {
    const auto before = static_cast<double>(sure[i]);
    const double should = law.scale * before + law.offset;
    if (!(should <= params_.law.surely_within * view.max_range) || std::isnan(view.ranges[i])) continue;
    ++compared;
    if (!view.met(i)) continue;
    // Carried on, a place falls between two samples: half a sample aside it is this much nearer or farther.
    const double spread = view.farthest[i] < kNoAnswer ? static_cast<double>(view.farthest[i] - view.nearest[i]) : 0.0;
    const double tolerance = params_.closely.noise + params_.closely.per_metre * should + 0.25 * spread;
    const auto reading = static_cast<double>(view.ranges[i]);
    if (std::abs(reading - should) <= tolerance) ++by_law;
    if (std::abs(reading - before) <= tolerance) ++as_before;
  }
  return compared >= params_.law.least && by_law >= params_.alone * compared &&
         as_before <= params_.alone_as_before * compared;
}

void ScannerWatch::judge_onset(const SweepView& view, std::span<const Word> others) {
  if (form_.is_silent) return;
  const bool is_long_ago = before_ && view.stamp - before_->stamp > seconds(params_.onset);
  if (!before_ || (is_long_ago && !lie_ && lies_ == 0)) {
    if (is_long_ago) word_.broken = view.stamp;
    before_ = view;
    word_.unbroken = view.stamp;
    return;
  }
  const RangeLaw& law = before_says_;
  const bool tells = law.compared >= params_.law.least;
  if (lie_) {
    if (lie_->by == Lie::By::sweeps) word_.law = lie_->law;
    if (lie_->by == Lie::By::sweeps && tells) follow_lie(view, law);
    return;
  }
  if (!tells || !is_lie(law, params_.law)) {
    lies_ = 0;
    if (!breaks_) before_ = view;
    return;  // of a lie, the sweep before stays what it is compared with
  }
  if (lies_ == 0) suspected_ = view.stamp;
  word_.law = law;
  if (++lies_ < params_.sure) return;
  const Verdict others_say =
      rings_.contradicts(law, suspected_) ? Verdict::carried_off : verdict(law, suspected_, others);
  if (others_say == Verdict::borne_out || (others_say == Verdict::none && is_clear(law, view))) {
    lies_ = 0;
    convict({.what = "the distances of the " + name_ + " are " + to_words(law),
             .law = law,
             .is_brief = others_say == Verdict::none && law.offset == 0.0},
            view.stamp);
  } else if (others_say == Verdict::carried_off || lies_ >= params_.alone_at_most) {
    begin_anew(view);
  }
}

void ScannerWatch::look_for_walls(const SweepView& view) {
  if (!walls_) {
    walls_ = walls_of(view);
    return;
  }
  const Pose2 now_from_then = inverse(view.odom_from_sensor) * walls_->odom_from_sensor;
  const double turn = std::abs(now_from_then.theta.radians());
  const double way = norm(now_from_then.position());
  const bool is_other = turn > params_.walls_least_turn || way > params_.walls_least_way;
  const bool is_old = turn > params_.walls_turn || way > params_.walls_way ||
                      view.stamp - walls_->stamp > seconds(params_.walls_longest);
  if (is_other && !is_old) {
    expect(*walls_, now_from_then, view, expected_);
    sectors_.look_for(view, expected_, params_.walls_patience, params_.walls_hole);
  }
  if (is_old) walls_ = walls_of(view);
}

void ScannerWatch::judge_age(const SweepView& view, const SensorSweep& sweep, const Pose2& odom_from_base) {
  if (form_.is_covered) return;  // whoever stands before it gives the same reading everywhere, again and again
  if (repeats_.add(sweep.stamp, sweep.ranges, view.answers, odom_from_base))
    convict({.what = "the " + name_ + " repeats old sweeps", .by = Lie::By::motion, .is_late = true}, view.stamp);
  const auto age = old_.add(view, sweep.base_from_sensor);
  if (old_.is_refuted() && lie_ && lie_->is_late) acquit();
  if (age) convict({.what = "the " + name_ + " gives old sweeps", .by = Lie::By::motion, .is_late = true}, view.stamp);
}

void ScannerWatch::judge_motion(const SweepView& view) {
  if (!lie_ && is_proven_ && does_map_fit(view.stamp)) return motion_.follow(view);
  switch (motion_.add(view, lie_ && lie_->is_late, !is_alone())) {
    case MotionCheck::Finding::too_long: {
      RangeLaw law;
      law.scale = motion_.scale();
      if (rings_.contradicts(law, {})) break;
      convict({.what = "the distances of the " + name_ + " do not fit the motion: " + to_words(law),
               .by = Lie::By::motion,
               .law = law},
              view.stamp);
      break;
    }
    case MotionCheck::Finding::in_order:
      if (!lie_) {
        is_proven_ = true;
      } else if (is_tried(view.stamp)) {
        acquit();
      }
      break;
    case MotionCheck::Finding::untold:
      if (!lie_) is_proven_ = true;
      break;
    case MotionCheck::Finding::late:  // or wheels that slip
    case MotionCheck::Finding::nothing:
      break;
  }
}

bool ScannerWatch::is_borne_out_by_map(const RangeLaw& law, Time now, std::span<const Word> others) const {
  const auto bears_out = [&](const Word& other) {
    const bool fits = other.fits_map != Time{} && now - other.fits_map < seconds(params_.silence_map);
    return fits || (other.by_map && is_same(*other.by_map, law));
  };
  if (std::any_of(others.begin(), others.end(), bears_out)) return true;
  const bool is_settled = word_.broken == Time{} || now - word_.broken > seconds(params_.unsettled);
  return is_settled && law.as_law >= params_.map_alone * law.compared;
}

void ScannerWatch::judge_by_map(const SweepView& view, std::span<const Word> others) {
  const auto is_new = [&](Time remounted) {
    return remounted != Time{} && view.stamp - remounted < seconds(params_.mount_settles);
  };
  if (is_new(word_.remounted) ||
      std::any_of(others.begin(), others.end(), [&](const Word& other) { return is_new(other.remounted); }))
    return;
  const auto found = map_.compare(view);
  if (!found) return;
  word_.by_map.reset();
  if (!found->is_known) return;
  map_said_ = view.stamp;
  map_has_nothing_ = found->is_nothing_near;
  // People all round are nearer than what the map has; nothing but a lie is behind its walls.
  const bool is_too_long = found->lie && (found->lie->offset > 0.0 || found->lie->scale > 1.0);
  if (is_too_long) word_.by_map = found->lie;
  if (found->in_order) word_.fits_map = view.stamp;
  if (is_too_long && !rings_.contradicts(*found->lie, {}) && is_borne_out_by_map(*found->lie, view.stamp, others)) {
    convict({.what = "the distances of the " + name_ + " are " + to_words(*found->lie),
             .by = Lie::By::map,
             .law = *found->lie},
            view.stamp);
  } else if (found->in_order && !lie_) {
    is_proven_ = true;
  } else if (found->in_order && !lie_->is_late && view.stamp - lie_->last_sign > seconds(params_.stands)) {
    acquit();
  }
  of_map_.forget();
  if (found->fits) of_map_.look_for(view, map_.expected(), params_.map_patience);
  of_map_row_ = of_map_.runs().empty() ? 0 : of_map_row_ + 1;
  if (of_map_row_ >= params_.map_silences) sectors_.look_for(view, map_.expected(), params_.map_patience);
}

bool ScannerWatch::is_glass(const RangeLaw& law) const {
  return fits_rings_ != Time{} && (law.offset >= params_.unseen || law.scale >= params_.unseen_factor);
}

void ScannerWatch::judge_by_rings(const SweepView& view, const RingCheck::Finding& found) {
  if (view.stamp - word_.newest > seconds(params_.onset) || word_.broken > fits_rings_) fits_rings_ = {};
  // What the sensors said before a break counts as long as they remember it.
  const bool is_settled = view.stamp - word_.broken > seconds(params_.rings.memory);
  if (found.in_order && is_settled && word_.newest == view.stamp && !lie_) fits_rings_ = view.stamp;
  // Glass all round: the map has what the laser sees through it, or it has seen so all the while.
  const bool is_lie = found.too_long && !does_map_fit(view.stamp) && !is_glass(*found.too_long);
  rings_row_ = is_lie ? rings_row_ + 1 : 0;
  if (rings_row_ >= params_.rings_sure)
    convict({.what = "the distances of the " + name_ + " are " + to_words(*found.too_long) + " for sonar and infrared",
             .by = Lie::By::rings,
             .law = *found.too_long},
            view.stamp);
  if (lie_ && !lie_->is_late && rings_row_ == 0) {
    const bool is_in_order =
        lie_->by == Lie::By::rings ? found.in_order : rings_.contradicts(lie_->law, lie_->first_sign);
    if (is_in_order) acquit();
  }
}

void ScannerWatch::judge_by_walls(const SweepView& view) {
  const auto found = form_.is_silent ? StraightWallsCheck::Finding::nothing : straight_.add(view);
  const bool is_accused = lie_ && lie_->by == Lie::By::walls;
  if (found == StraightWallsCheck::Finding::in_order && is_accused) return acquit(), begin_anew(view);
  const RangeLaw law{.offset = straight_.offset()};
  if (found != StraightWallsCheck::Finding::offset || does_map_fit(view.stamp) || rings_.contradicts(law, {})) return;
  const std::string what = "walls that the " + name_ + " sees are bent: its distances are " + to_words(law);
  convict({.what = what, .by = Lie::By::walls, .law = law}, view.stamp);
  straight_.forget();  // it may be mended
}

void ScannerWatch::judge_by_parallax(const SweepView& view) {
  if (lie_ || form_.is_silent || has_ring_) return parallax_.forget_place();
  if (parallax_.add(view) != ParallaxCheck::Finding::offset) return;
  const RangeLaw law{.offset = parallax_.offset()};
  if (does_map_fit(view.stamp) || rings_.contradicts(law, {})) return;
  const std::string what = "the distances of the " + name_ + " do not fit the motion: " + to_words(law);
  convict({.what = what, .by = Lie::By::walls, .law = law}, view.stamp);
  straight_.forget();  // it may be mended
}

void ScannerWatch::hide(SensorSweep& sweep, const SweepView& view) const {
  const bool is_nothing_to_believe =
      lie_ || form_fault_ == FormFault::units || (form_.is_silent && !is_silence_explained_);
  if (lie_ && form_fault_ == FormFault::none && !has_ring_ && is_tried(view.stamp)) {
    // Nothing else sees where it creeps.
    const double share = lie_->law.scale > 1.0 ? params_.trusts / lie_->law.scale : 1.0;
    for (float& range : sweep.ranges) range *= static_cast<float>(share);
    return;
  }
  if (is_nothing_to_believe) {
    std::fill(sweep.ranges.begin(), sweep.ranges.end(), kNoReading);
    return;
  }
  const auto hide_silent = [&](const BeamRun& run) {
    for (std::size_t i = run.first; i < std::min(run.end, sweep.ranges.size()); ++i)
      if (sweep.ranges[i] >= sweep.max_range) sweep.ranges[i] = kNoReading;
  };
  for (const BeamRun& run : sectors_.runs()) hide_silent(beams_of(run, view, sweep));
  for (const BeamRun& run : near_.hidden_in(sweep, view.odom_from_sensor)) hide_silent(run);
  for (const BeamRun& run : form_.too_near) hide_silent(run);
}

SensorSweep ScannerWatch::judge(SensorSweep sweep, const Pose2& odom_from_base, bool is_motion_known,
                                std::span<const Word> others, std::span<const RingEcho> rings) {
  if (sweep.ranges.empty() || !(sweep.bearing_step > 0.0)) return sweep;
  follow_mount(sweep);
  newest_ = sweep.stamp;
  has_ring_ = has_ring_ || !rings.empty();
  judge_form(sweep);
  const SweepView view = view_of(sweep, odom_from_base * sweep.base_from_sensor, kSamples, rays_of_samples_);
  rays_of_samples_ = view.rays;
  if (!is_motion_known) {
    motion_.forget();
    parallax_.forget_place();
    old_.forget();
    forget_succession();
    before_.reset();
    walls_.reset();
    lies_ = 0;
    word_.broken = view.stamp;
  } else if (!form_.has_wrong_units) {
    if (before_) expect(*before_, inverse(view.odom_from_sensor) * before_->odom_from_sensor, view, expected_);
    const RingCheck::Finding by_rings = rings_.add(view, rings);
    judge_silence(view);
    sectors_.follow(view);
    watch_for_breaks(view, others);
    if (before_ && !form_.is_silent && !breaks_) {
      const double elapsed = to_seconds(view.stamp - before_->stamp);
      if (elapsed <= params_.onset) sectors_.look_for(view, expected_, elapsed);
      near_.add(*before_, view, expected_, form_);
      near_.hear(view, rings_.unanswered(view, rings),
                 can_be_too_near(sweep, std::max(sweep.min_range, near_.blind_within()), limits_));
    }
    judge_age(view, sweep, odom_from_base);
    judge_onset(view, others);
    judge_succession(view);
    judge_motion(view);
    judge_by_map(view, others);
    judge_by_rings(view, by_rings);
    judge_by_walls(view);
    judge_by_parallax(view);
    if (!form_.is_silent && !lie_) look_for_walls(view);
  }
  hide(sweep, view);
  return sweep;
}

std::optional<Complaint> ScannerWatch::complaint() const {
  if (form_fault_ == FormFault::units) return Complaint{0.0, "the distances of the " + name_ + " are in wrong units"};
  if (form_fault_ == FormFault::silent && !is_silence_explained_)
    return Complaint{0.0, "no beam of the " + name_ + " ends anywhere"};
  if (form_fault_ == FormFault::covered) return Complaint{0.0, "something covers the " + name_};
  if (lie_) return Complaint{is_tried(newest_) ? params_.trial_speed : 0.0, lie_->what};
  if (sectors_.is_any_sure())
    return Complaint{params_.crippled_speed, "the " + name_ + " sees nothing in a part of its field"};
  if (near_.is_any_sure())
    return Complaint{params_.crippled_speed, "the " + name_ + " says \"nothing there\" of what is too near"};
  if (form_fault_ == FormFault::silent && looks_ahead())
    return Complaint{params_.crippled_speed, "no beam of the " + name_ + " ends anywhere"};
  return std::nullopt;
}

}  // namespace docent::collision_avoidance
