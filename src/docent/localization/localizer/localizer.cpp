#include "docent/localization/localizer/localizer.h"

#include <cmath>
#include <utility>

#include "docent/localization/beam_choice/person_shapes.h"
#include "docent/localization/expected_ranges/agreement.h"

namespace docent::localization {
namespace {

constexpr double kSurpriseWaits = 0.15;   // [s] between updates for a surprise
constexpr double kElsewhere = 1e-4;       // of the mass, when somebody has told where the robot is
constexpr double kDoubtful = 0.1;         // P(lost) of a robot that looks for better places
constexpr double kTrustedShare = 0.5;     // of a place that a lost robot does not leave for a fix
constexpr double kWorthFollowing = 2e-3;  // of the best mode's mass: a mode that becomes a track

/// A track and a mode of the belief at the same place.
bool is_near(const Pose2& a, const Pose2& b) {
  return distance(a.position(), b.position()) < 0.8 && std::abs((a.theta - b.theta).degrees()) < 20.0;
}

}  // namespace

Localizer::Localizer(std::shared_ptr<const KnownMap> map, const LocalizerParams& params,
                     std::unique_ptr<PoseBelief> belief, bool rounds_repeat, std::uint64_t seed)
    : map_{std::move(map)},
      params_{params},
      belief_{std::move(belief)},
      cadence_{params, rounds_repeat},
      verdict_{params.verdict},
      refiner_{params.refiner},
      tracks_{params.tracks, params.motion, params.sensor.max_range, map_->caster},
      rng_{Rng{seed}.stream("localize")} {
  start_unknown();
}

void Localizer::start_unknown() {
  belief_->start_unknown();
  cadence_.restart();
  started_ = false;
  phase_ = 0;
  verdict_.reset();
  refiner_.reset();
  tracks_.forget();
  summarise_now();
}

void Localizer::start_at(std::span<const BeliefMode> modes, const Pose2& odom_from_robot, Time time) {
  odom_from_robot_ = odom_from_robot;
  belief_->set_out(odom_from_robot);
  belief_->believe(modes, kElsewhere, rng_);
  cadence_.restart_at(time);
  started_ = true;
  verdict_.assume_localized();
  refiner_.reset();
  tracks_.start_at(modes, odom_from_robot);
  summarise_now();
}

void Localizer::take_fix(const PoseFix& fix) {
  constexpr double kSureFix = 0.005;  // P(wrong) of one that a lost robot sets out from
  if (!started_) return;
  if (!fixes_) {
    fixes_ = std::make_shared<FixEvidence>();
    sensors_.add(fixes_);
  }
  fixes_->take(fix);
  if (verdict_.keeps_its_place() || fix.p_wrong > kSureFix) return;
  const auto best = map_from_robot(fix.odom_from_robot);
  if (best && is_near(*best, fix.map_from_robot) && verdict_.share() > kTrustedShare) return;
  const BeliefMode mode{fix.map_from_robot, fix.covariance, 1.0};
  start_at(std::span{&mode, 1}, fix.odom_from_robot, fix.time);
}

std::optional<double> Localizer::witness() const {
  constexpr double kNear = 0.5, kNearTurn = 12.0, kTelling = 0.01;  // [m], [deg], P(wrong)
  if (!fixes_ || summary_.modes.empty()) return std::nullopt;
  const auto fix = fixes_->at(cadence_.last_update(), odom_from_robot_);
  if (!fix || fix->p_wrong > kTelling) return std::nullopt;
  const Pose2& best = summary_.modes.front().map_from_robot;
  const bool agrees = distance(best.position(), fix->map_from_robot.position()) < kNear &&
                      std::abs((best.theta - fix->map_from_robot.theta).degrees()) < kNearTurn;
  return agrees ? fix->p_wrong : 1.0 + fix->p_wrong;
}

void Localizer::uproot() {
  constexpr double kProbably = 0.5;  // of the mass: the scans may err, as where a crowd closes in at once
  if (!started_ || params_.reckons_dead) return;
  verdict_.uproot();
  refiner_.reset();
  cadence_.come_elsewhere();
  is_uprooted_ = true;
  if (summary_.modes.empty()) return;
  belief_->believe(summary_.modes, kProbably, rng_);
  summarise_now();
}

Localizer::Step Localizer::observe(const sensor_models::RangeSweep& seen, const Pose2& odom_from_robot, Time time) {
  if (params_.reckons_dead && verdict_.localized()) return {};
  if (is_torn(odom_from_robot)) start_unknown();
  if (seen.beams.empty()) return {};
  const sensor_models::RangeSweep sweep = params_.cuts_at_reach ? within_reach(seen, params_.sensor.max_range) : seen;
  Update update = due(sweep, odom_from_robot, time);
  if (update.weight <= 0.0) return {};
  predict(update, odom_from_robot, time);
  choose_beams(update);
  reweigh(update);
  summarise(update);
  const auto fits = fit(update);
  judge(update);
  return {true, update.choice.used.size(), update.choice.filtered, update.weight, fits};
}

bool Localizer::is_torn(const Pose2& odom_from_robot) const {
  // Farther than the map reaches nobody has driven: such odometry says nothing of where the robot is now.
  return started_ && !(distance(odom_from_robot_.position(), odom_from_robot.position()) <= map_->widest);
}

Localizer::Update Localizer::due(const sensor_models::RangeSweep& sweep, const Pose2& odom_from_robot, Time time) {
  const Motion motion = started_ ? Motion{inverse(odom_from_robot_) * odom_from_robot} : Motion{};
  Update update{.sweep = sweep,
                .motion = motion,
                .predicted = started_ ? map_from_robot(odom_from_robot) : std::nullopt,
                .weight = started_ ? cadence_.weight(motion, time) : 1.0,
                .views = cadence_.views(motion)};
  if (update.predicted && update.views <= 1.0) glance_at(sweep, *update.predicted);
  // Someone may have carried the robot: then this is not the same view again, and nothing to wait for.
  if (update.weight < 1.0 && verdict_.keeps_its_place() && cadence_.waited(time) >= kSurpriseWaits &&
      verdict_.startled())
    update.weight = 1.0;
  if (is_uprooted_) update.weight = 1.0;
  return update;
}

void Localizer::predict(const Update& update, const Pose2& odom_from_robot, Time time) {
  if (!started_) belief_->set_out(odom_from_robot);
  started_ = true;
  odom_from_robot_ = odom_from_robot;
  belief_->predict(update.motion, odom_from_robot, verdict_.keeps_its_place());
  cadence_.begin(update.motion, odom_from_robot.position(), time);
}

void Localizer::choose_beams(Update& update) {
  update.seen = belief_->in_frame(update.sweep);
  update.on_persons = params_.on_persons(update.sweep, verdict_.keeps_its_place());
  likely_ = belief_->likely();
  update.choice = chosen_beams(likely_, map_->table, map_->space.headings(), map_->model, update.seen,
                               params_.beam_choice(update.on_persons, verdict_.keeps_its_place()), ++phase_, rng_);
}

void Localizer::reweigh(Update& update) {
  if (verdict_.keeps_its_place() && update.predicted)
    update.focus = params_.focus(*update.predicted, update.motion.before_from_after);
  const SensorEvidence evidence{.seen = update.seen,
                                .beams = update.choice.used,
                                .likely = likely_,
                                .others = sensors_,
                                .time = cadence_.last_update(),
                                .odom_from_robot = odom_from_robot_,
                                .weight = update.weight,
                                .views = update.views,
                                .sector_nats = params_.sector_nats(update.on_persons),
                                .keeps_its_place = verdict_.keeps_its_place(),
                                .in_doubt = verdict_.contradicted() || verdict_.startled() || is_uprooted_,
                                .focus = update.focus};
  const auto [weight, work] = belief_->reweigh(evidence, rng_);
  update.weight = weight;
  cadence_.pay(work);
}

void Localizer::summarise(const Update& update) {
  summarise_now();
  compare_tracks(update);
  if (!summary_.modes.empty()) refine(update);
}

void Localizer::summarise_now() {
  likely_ = belief_->likely();
  summary_ = belief_->summarise();
}

void Localizer::compare_tracks(const Update& update) {
  const bool is_startled = verdict_.startled() || is_uprooted_;
  const bool is_view = tracks_.is_due(odom_from_robot_, is_startled);
  if (is_view) {
    const auto on_persons = params_.on_persons(update.sweep, false);
    const auto best = summary_.modes.empty() ? std::nullopt : std::optional{summary_.modes.front().map_from_robot};
    tracks_.add_view(on_persons.empty() ? update.sweep : without(update.sweep, on_persons), odom_from_robot_,
                     is_startled, best);
    std::vector<Pose2> modes;
    for (const BeliefMode& mode : summary_.modes)
      if (mode.mass >= kWorthFollowing * summary_.modes.front().mass) modes.push_back(mode.map_from_robot);
    tracks_.take_in(modes);
    const bool in_doubt = verdict_.contradicted() || verdict_.p_lost() > kDoubtful;
    if (tracks_.is_search_due(verdict_.keeps_its_place(), in_doubt)) tracks_.search(map_->places);
  }
  is_uprooted_ = false;
  tracks_.hear(sensors_, update.weight, odom_from_robot_);
  const auto modes = belief_lacks();
  if (!modes) return;
  belief_->believe(*modes, params_.teleport_probability, rng_);
  summarise_now();
}

double Localizer::share_of_best() const {
  if (summary_.modes.empty()) return 0.0;
  double share = 0.0;
  for (const Tracks::Place& place : tracks_.places(odom_from_robot_))
    share += is_near(place.map_from_robot, summary_.modes.front().map_from_robot) ? place.share : 0.0;
  return share;
}

std::optional<std::vector<BeliefMode>> Localizer::belief_lacks() const {
  constexpr double kTooLittle = 0.5;     // share of the place that the robot keeps: another is the likelier
  constexpr double kWorthHaving = 0.07;  // share of a place that the belief must not lack
  constexpr double kLacks = 0.3;         // of a place's share: less mass is too little
  constexpr double kConcentrated = 0.8;  // mass of the modes, or share of the best place: before, belief is the wiser
  constexpr double kLeast = 0.01;        // share of a mode
  constexpr double kDoubt = 0.25;        // mass by which a place counts that the belief has ruled out
  if (summary_.modes.empty() || (verdict_.keeps_its_place() && share_of_best() >= kTooLittle)) return std::nullopt;
  const auto places = tracks_.places(odom_from_robot_);
  if (places.empty()) return std::nullopt;
  double in_modes = 0.0;
  for (const BeliefMode& mode : summary_.modes) in_modes += mode.mass;
  if (in_modes < kConcentrated && places.front().share < kConcentrated) return std::nullopt;
  bool is_lacking = false;
  double sum = 0.0;
  std::vector<BeliefMode> modes;
  for (const Tracks::Place& place : places) {
    if (place.share < kLeast) break;
    BeliefMode found{place.map_from_robot, {0.01, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0, 0.001}, 0.0};
    double mass = 0.0;
    for (const BeliefMode& mode : summary_.modes) {
      if (!is_near(mode.map_from_robot, place.map_from_robot)) continue;
      if (mass == 0.0) found = mode;
      mass += mode.mass;
    }
    is_lacking = is_lacking || (place.share >= kWorthHaving && mass < kLacks * place.share);
    modes.push_back(found);
    modes.back().mass = place.share * std::max(mass, kDoubt);
    sum += modes.back().mass;
  }
  for (BeliefMode& mode : modes) mode.mass /= sum;
  return is_lacking ? std::optional{modes} : std::nullopt;
}

void Localizer::refine(const Update& update) {
  belief_->resample(summary_.modes.front().map_from_robot, rng_);
  const motion_models::MotionNoise noise = motion_models::motion_noise(params_.motion, update.motion.before_from_after);
  const Pose2 refined =
      refiner_.refine(summary_.modes.front(), update.sweep, update.motion.before_from_after, noise.position_variance,
                      noise.heading_variance, map_->caster, params_.sensor.max_range);
  summary_.modes.front().map_from_robot = refined;
  const auto share = refiner_.found_share();
  if (!update.focus || !share) return;
  belief_->gather(refined, *update.focus, *share);
  summarise_now();
  if (!summary_.modes.empty()) summary_.modes.front().map_from_robot = refined;
}

std::optional<double> Localizer::fit(const Update& update) const {
  if (summary_.modes.empty() || update.choice.used.empty()) return std::nullopt;
  const StateSpace& space = map_->space;
  const Pose2 map_from_frame = belief_->map_from_frame(summary_.modes.front().map_from_robot);
  const std::int32_t place = space.place_at(space.frame().cell_at(map_from_frame.position()));
  if (place == StateSpace::kNoPlace) return std::nullopt;
  const double turns = map_from_frame.theta.radians() / space.heading_step() + space.headings();
  const auto heading = static_cast<std::size_t>(std::lround(turns)) % static_cast<std::size_t>(space.headings());
  const RangeTable::Row row = map_->table.row(static_cast<std::size_t>(place));
  double sum = 0.0;
  for (const sensor_models::BinnedBeam& beam : update.choice.used) {
    const int bin = bin_of(update.seen.beams[beam.beam], map_->model);
    sum += static_cast<double>(map_->model.log_probabilities(bin)[row[heading + beam.direction]]);
  }
  return sum / static_cast<double>(update.choice.used.size());
}

void Localizer::judge(Update& update) {
  // After a long way odometry foretells too little, so the readings are compared with the updated belief.
  if (update.views > 1.0 && !likely_.empty()) {
    const ExpectedRanges expected{likely_, map_->table, map_->space.headings(), false};
    update.choice.readings =
        agreement_of_all(expected, map_->model, update.seen, params_.filter_sureness, map_->space.headings());
  }
  const Evidence evidence{.weight = update.weight,
                          .views = update.views,
                          .share = share_of_best(),
                          .way = update.motion.way,
                          .turn = update.motion.turn,
                          .readings = update.choice.readings,
                          .witness = witness()};
  verdict_.add(with_best_mode(evidence, summary_, update.predicted));
  if (verdict_.collapsed()) {
    const bool has_changed = belief_->flood();
    verdict_.reset();
    refiner_.reset();
    if (has_changed) summarise_now();
  }
  if (const auto now = map_from_robot(odom_from_robot_)) glance_at(update.sweep, *now);
}

void Localizer::glance_at(const sensor_models::RangeSweep& sweep, const Pose2& map_from_robot) {
  verdict_.look(glance(map_->caster, sweep, map_from_robot, params_.sensor.max_range));
}

std::vector<sensor_models::BeamOrigin> Localizer::origins(const sensor_models::RangeSweep& sweep, const Pose2& odom_now,
                                                          double max_range, const PersonFilterParams& params) const {
  if (!verdict_.localized()) return beam_origins(caster(), {}, sweep, {}, max_range, params);
  std::vector<BeliefMode> modes = summary_.modes;
  const Pose2 before_from_now = inverse(odom_from_robot_) * odom_now;
  for (BeliefMode& mode : modes) mode.map_from_robot = mode.map_from_robot * before_from_now;
  std::vector<float> gains;
  if (params.filter == "entropy") gains = entropy_gains(sweep, odom_now);
  return beam_origins(caster(), modes, within_reach(sweep, max_range), gains, max_range, params);
}

std::vector<float> Localizer::entropy_gains(const sensor_models::RangeSweep& sweep, const Pose2& odom_now) const {
  if (likely_.empty()) return {};
  const ExpectedRanges expected{likely_, map_->table, map_->space.headings(), true};
  return docent::localization::entropy_gains(
      expected, map_->model, sensor_models::seen_from(sweep, inverse(belief_->odom_from_frame()) * odom_now),
      map_->space.headings());
}

}  // namespace docent::localization
