#include "docent/localization/monte_carlo/monte_carlo_localizer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "docent/localization/belief/person_shapes.h"
#include "docent/localization/monte_carlo/particle_strata.h"
#include "docent/localization/monte_carlo/particle_summary.h"
#include "docent/localization/monte_carlo/particle_weights.h"

namespace docent {

namespace {

constexpr double kLikelyFraction = 1e-3;   // of the likeliest state: those that the filters ask
constexpr std::size_t kMostLikely = 6000;  // more, and the belief is too wide for filters
constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kSurpriseWaits = 0.15;  // [s]
constexpr double kSurprising = 0.5;      // of the evidence is missing: at every update poses are drawn
constexpr double kNewView = 0.1;         // of the usual likelihood: less is not the view that was there
constexpr double kUpdateSeconds = 0.25;  // what one update may take of the robot's time, if the work is paid

}  // namespace

Result<void> MonteCarloParams::validate() const {
  if (model != "beam" && model != "field") return fail("particles.model must be beam or field, not '" + model + "'");
  if (!(least >= 50 && least <= most)) return fail("particles.least must be >= 50 and <= most");
  if (!(most <= 10'000'000)) return fail("particles.most must be <= 10000000");
  if (!(reserve >= 0 && reserve <= most)) return fail("particles.reserve must be 0..most");
  for (const auto& valid : {kld.validate(), field.validate()})
    if (!valid) return fail("particles." + valid.error().message);
  if (!(shake_position >= 0.0 && shake_heading >= 0.0))
    return fail("particles.shake_position and shake_heading must be >= 0");
  if (!(resample_below > 0.0 && resample_below <= 1.0)) return fail("particles.resample_below must be > 0 and <= 1");
  if (!(deprived >= 0.0 && deprived <= 0.5)) return fail("particles.deprived must be 0..0.5");
  if (!(surprise_slow > 0.0 && surprise_slow < surprise_fast && surprise_fast <= 1.0))
    return fail("particles.surprise_slow must be > 0 and < surprise_fast, that <= 1");
  if (!(draw_every >= 1)) return fail("particles.draw_every must be >= 1");
  return {};
}

MonteCarloLocalizer::MonteCarloLocalizer(const OccupancyGrid& map, const MarkovLocalizerParams& shared,
                                         const MonteCarloParams& params, const RangeTableCache& cache,
                                         std::uint64_t seed)
    : shared_{shared},
      params_{params},
      caster_{peeled(map, shared.states.wall_depth)},
      space_{map, caster_, shared.states},
      table_{range_table_of(map, shared, cache, space_, caster_)},
      model_{shared.sensor, table_.frequency()},
      scores_{params.model == "field" ? SweepScores::Model::field : SweepScores::Model::beam,
              BeamScores{space_, table_, model_, shared.sensor.max_range},
              LikelihoodField{caster_, params.field, shared.sensor.max_range},
              space_.headings(),
              static_cast<std::size_t>(shared.sectors),
              shared.most_sector_nats,
              shared.sensor.max_range},
      instructions_{instruction_set_of(shared.simd).value_or(InstructionSet::plain)},
      verdict_{shared.verdict},
      refiner_{shared.refiner},
      rng_{Rng{seed}.stream("localize")},
      widest_{map.frame.resolution * std::hypot(map.frame.columns, map.frame.rows)},
      noise_{Rng{seed}.stream("particles")()} {
  const auto fields = field_kernels();  // as many as the processor has sets, in their order
  scores_.use_kernel(fields[std::min(fields.size() - 1, static_cast<std::size_t>(instructions_))].kernel);
  start_unknown();
}

void MonteCarloLocalizer::use_kernels(FieldKernel field, InstructionSet grid) {
  scores_.use_kernel(field);
  instructions_ = grid;
}

void MonteCarloLocalizer::start_unknown() {
  particles_.clear();
  started_ = false;
  last_work_ = 0.0;
  long_mean_ = short_mean_ = start_over_ = 0.0;
  phase_ = 0;
  undrawn_ = 0;
  verdict_.reset();
  refiner_.reset();
  rivals_.forget();
  summarise_now();
}

void MonteCarloLocalizer::believe(std::span<const BeliefMode> modes) {
  particles_.clear();
  const auto each = static_cast<std::size_t>(std::max(params_.least, params_.most / 20));
  double mass = 0.0;
  for (const BeliefMode& mode : modes) mass += mode.mass;
  for (const BeliefMode& mode : modes) {
    const std::size_t first = particles_.size();
    particles_.resize(first + each);
    const double deviation_x = std::sqrt(std::max(mode.covariance[0], 1e-4));
    const double deviation_y = std::sqrt(std::max(mode.covariance[4], 1e-4));
    const double deviation_theta = std::sqrt(std::max(mode.covariance[8], 1e-4));
    const Pose2& at = mode.map_from_robot;
    for (std::size_t i = first; i < particles_.size(); ++i) {
      const double x = rng_.normal(at.x, deviation_x);
      const double y = rng_.normal(at.y, deviation_y);
      const Angle theta = at.theta + Angle::radians(rng_.normal(0.0, deviation_theta));
      particles_.set(i, {x, y, theta}, static_cast<float>(mode.mass / mass / static_cast<double>(each)));
    }
  }
}

void MonteCarloLocalizer::keep_rivals(const RangeSweep& sweep, const Pose2& before_from_after, double weight) {
  if (!shared_.rivals || verdict_.keeps_its_place()) return rivals_.forget();
  const auto modes = rivals_.update(summary_, sweep, before_from_after, caster_, shared_.sensor.max_range);
  rivals_.hear(summary_, sensors(), weight);
  if (!modes) return;
  believe(*modes);
  summarise_now();
}

void MonteCarloLocalizer::start_at(std::span<const BeliefMode> modes, const Pose2& odom_from_robot, Time time) {
  believe(modes);
  odom_from_robot_ = odom_from_robot;
  started_ = true;
  last_update_ = time;
  last_work_ = 0.0;
  long_mean_ = short_mean_ = start_over_ = 0.0;
  verdict_.assume_localized();
  refiner_.reset();
  rivals_.forget();
  summarise_now();
}

void MonteCarloLocalizer::summarise_now() {
  if (particles_.size() == 0) {
    summary_ = summarise_unknown(space_, {});
    likely_.clear();
    return;
  }
  const auto bins = bins_of(particles_, space_);
  likely_ = likely_states(bins, space_, kLikelyFraction, kMostLikely);
  summary_ = summarise(bins, space_, {});
  summary_.active_states = particles_.size();
}

double MonteCarloLocalizer::due_weight(double way, double turn, Time time) const {
  const double waited = to_seconds(time - last_update_);
  if (waited * shared_.work_per_second < last_work_) return 0.0;
  const double moved = std::max(way / shared_.update_way, turn / (shared_.update_turn * kRadians));
  if (moved >= 1.0) return 1.0;
  const bool stands = way < 0.005 && turn < 0.005;
  if (waited < (stands ? shared_.standing_period : shared_.creeping_period)) return 0.0;
  return std::max(moved, shared_.standing_weight);
}

std::size_t MonteCarloLocalizer::most_particles() const {
  const double affordable = shared_.work_per_second * kUpdateSeconds / shared_.beams;
  return static_cast<std::size_t>(
      std::clamp(affordable, static_cast<double>(params_.least), static_cast<double>(params_.most)));
}

MonteCarloLocalizer::Step MonteCarloLocalizer::observe(const RangeSweep& sweep, const Pose2& odom_from_robot,
                                                       Time time) {
  Step step;
  // As in the grid: such odometry is torn.
  if (started_ && !(distance(odom_from_robot_.position(), odom_from_robot.position()) <= widest_)) start_unknown();
  const Pose2 before_from_after = started_ ? inverse(odom_from_robot_) * odom_from_robot : Pose2{};
  const double way = norm(before_from_after.position());
  const double turn = std::abs(before_from_after.theta.radians());
  if (sweep.beams.empty()) return step;
  const std::optional<Pose2> predicted = started_ ? map_from_robot(odom_from_robot) : std::nullopt;
  const double views = shared_.views(way, turn);
  if (predicted && views <= 1.0) verdict_.look(glance(caster_, sweep, *predicted, shared_.sensor.max_range));
  step.weight = started_ ? due_weight(way, turn, time) : 1.0;
  if (step.weight < 1.0 && verdict_.keeps_its_place() && to_seconds(time - last_update_) >= kSurpriseWaits &&
      verdict_.startled())
    step.weight = 1.0;
  if (step.weight <= 0.0) return step;

  odom_from_robot_ = odom_from_robot;
  started_ = true;
  last_update_ = time;
  const GridFrame& frame = space_.frame();
  const MapBox box{static_cast<float>(frame.origin.x), static_cast<float>(frame.origin.y),
                   static_cast<float>(frame.origin.x + frame.columns * frame.resolution),
                   static_cast<float>(frame.origin.y + frame.rows * frame.resolution)};
  move_particles(particles_, shared_.motion, before_from_after, {params_.shake_position, params_.shake_heading}, box,
                 noise_);

  const std::vector<std::uint8_t> on_persons = shared_.on_persons(sweep, verdict_.keeps_its_place());
  BeamChoice choice = choose_beams(sweep, on_persons);
  const double one_view = shared_.independent_beams / shared_.beams;
  const double full_temper = std::min(1.0, views * one_view);
  last_work_ = static_cast<double>(particles_.size()) * static_cast<double>(choice.used.size());
  others_ = ask_sensors(full_temper);
  if (others_.steps_per_nat > 0.0) last_work_ += kWorkOfOthers * static_cast<double>(particles_.size());
  double likelihood = 0.0;
  std::optional<Neighbourhood> focus;
  if (verdict_.keeps_its_place() && predicted) focus = shared_.focus(*predicted, before_from_after);
  if (particles_.size() > 0) {
    std::vector<std::uint32_t> costs;
    scores_.score(sweep, choice.used, particles_, costs);
    add_others(particles_, costs);
    // The same view again says little; another view, without motion, says that somebody carried the robot.
    const bool is_new = mean_likelihood(particles_, costs, full_temper / kScorePerNat) < kNewView * long_mean_;
    if (is_new) step.weight = 1.0;
    ParticleEvidence evidence;
    evidence.nats_per_cost = step.weight * full_temper / kScorePerNat;
    evidence.most_nats = shared_.most_nats * std::sqrt(views);
    if (focus) {  // as the grid: sharp where the robot is, slow between there and elsewhere
      evidence.focus = focus;
      evidence.far_share = shared_.independent_beams_far / shared_.independent_beams;
      evidence.far_most_nats = shared_.most_nats_far * std::sqrt(views);
    }
    likelihood = reweigh(particles_, costs, evidence);
    notice_surprise(likelihood, step.weight, full_temper / one_view);
  }
  draw_elsewhere(sweep, choice.used, step.weight * full_temper, likelihood);
  step.updated = true;
  step.beams_used = choice.used.size();
  step.beams_filtered = choice.filtered;

  summarise_now();
  keep_rivals(on_persons.empty() ? sweep : without(sweep, on_persons), before_from_after, step.weight);
  if (!summary_.modes.empty()) {
    const Strata strata{static_cast<std::size_t>(params_.least), most_particles(),
                        static_cast<std::size_t>(params_.reserve), params_.resample_below, params_.kld};
    resample_strata(particles_, summary_.modes.front().map_from_robot, strata, rng_, scratch_);
    const MotionNoise noise = motion_noise(shared_.motion, before_from_after);
    BeliefMode& best = summary_.modes.front();
    best.map_from_robot = refiner_.refine(best, sweep, before_from_after, noise.position_variance,
                                          noise.heading_variance, caster_, shared_.sensor.max_range);
    if (focus) gather(*focus);
  }
  step.fit = fit(sweep, choice.used);
  // After a long way odometry foretells too little: the belief of after the update is held against the readings.
  if (views > 1.0 && !likely_.empty()) {
    const ExpectedRanges expected{likely_, table_, space_.headings(), false};
    choice.readings = agreement_of_all(expected, model_, sweep, shared_.filter_sureness, space_.headings());
  }
  judge({.weight = step.weight, .views = views, .way = way, .turn = turn, .readings = choice.readings}, predicted);
  if (const auto now = map_from_robot(odom_from_robot))
    verdict_.look(glance(caster_, sweep, *now, shared_.sensor.max_range));
  return step;
}

void MonteCarloLocalizer::gather(const Neighbourhood& focus) {
  const auto share = refiner_.found_share();
  if (!share) return;
  const Pose2 found = summary_.modes.front().map_from_robot;
  docent::gather(particles_, {{found, focus.radius, focus.turn}, same_place(found), *share});
  summarise_now();
  if (!summary_.modes.empty()) summary_.modes.front().map_from_robot = found;
}

MonteCarloLocalizer::Others MonteCarloLocalizer::ask_sensors(double temper) {
  sensors().pass_over();
  if (sensors().none() || particles_.size() == 0) return {};
  std::vector<LikelyPose> likely;
  for (const LikelyState& state : likely_) {
    const Point2 at = space_.centre(static_cast<std::size_t>(state.place));
    const Angle heading = Angle::radians(state.heading * space_.heading_step());
    likely.push_back({{at.x, at.y, heading}, static_cast<double>(state.mass)});
  }
  if (!sensors().observe({last_update_, odom_from_robot_, likely})) return {};
  return {kScorePerNat / temper, {}};
}

void MonteCarloLocalizer::add_others(const ParticleSet& particles, std::vector<std::uint32_t>& costs) {
  if (others_.steps_per_nat == 0.0 || particles.size() == 0) return;
  std::vector<Pose2> poses;
  poses.reserve(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) poses.push_back(particles.pose(i));
  std::vector<float> nats(poses.size(), 0.0F);
  sensors().add_costs(poses, nats);
  // Relative to the best particle: a sensor that fits none must not look like a surprise of the lasers.
  if (!others_.least) others_.least = *std::min_element(nats.begin(), nats.end());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto above = static_cast<double>(std::max(0.0F, nats[i] - *others_.least));
    costs[i] += static_cast<std::uint32_t>(std::lround(above * others_.steps_per_nat));
  }
}

void MonteCarloLocalizer::notice_surprise(double likelihood, double weight, double views) {
  // As of a full update of one view.
  const double whole = std::exp(std::log(std::max(likelihood, 1e-30)) / (weight * views));
  if (long_mean_ == 0.0) long_mean_ = short_mean_ = whole;
  long_mean_ += weight * params_.surprise_slow * (whole - long_mean_);
  short_mean_ += weight * params_.surprise_fast * (whole - short_mean_);
}

std::vector<BeamCosts> MonteCarloLocalizer::grid_costs(const RangeSweep& sweep, std::span<const BinnedBeam> beams,
                                                       double temper) const {
  std::vector<BeamCosts> costs(beams.size());
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const auto log_probabilities = model_.log_probabilities(bin_of(sweep.beams[beams[i].beam], model_));
    const float best = *std::max_element(log_probabilities.begin(), log_probabilities.end());
    for (std::size_t o = 0; o < kExpectedRanges; ++o) {
      const double nats = temper * static_cast<double>(best - log_probabilities[o]);
      costs[i].costs[o] = static_cast<std::uint8_t>(std::min<long>(kMaxCost, std::lround(nats * kCostPerNat)));
    }
    costs[i].direction = beams[i].direction;
  }
  return costs;
}

void MonteCarloLocalizer::draw_elsewhere(const RangeSweep& sweep, std::span<const BinnedBeam> beams, double temper,
                                         double likelihood) {
  const bool knows = verdict_.keeps_its_place();
  const double surprise = long_mean_ > 0.0 ? std::max(0.0, 1.0 - short_mean_ / long_mean_) : 0.0;
  if (knows && start_over_ == 0.0 && surprise < kSurprising && ++undrawn_ < params_.draw_every) return;
  undrawn_ = 0;
  const bool is_first = particles_.size() == 0;
  double prior = knows ? std::max(shared_.teleport_probability, params_.deprived * surprise) : params_.deprived;
  if (start_over_ > 0.0) prior = start_over_;
  start_over_ = 0.0;
  const auto most = most_particles();
  const std::size_t some = std::max<std::size_t>(most / 8, 64);
  const std::size_t count = is_first ? most : knows ? std::min(some, particles_.size()) : some;

  // As many tiles of places as there is time for; others the next time.
  const double work = static_cast<double>(space_.states()) * static_cast<double>(beams.size());
  const double affordable = std::max(shared_.work_per_second * kUpdateSeconds, 1.0);
  const auto stride = is_first ? std::size_t{1} : static_cast<std::size_t>(std::ceil(std::max(1.0, work / affordable)));
  first_tile_ = (first_tile_ + 1) % stride;
  const auto cap = static_cast<std::uint16_t>(std::min(shared_.most_sector_nats * temper * kCostPerNat, 4000.0));
  ScanProposal proposal =
      draw_from_scan(space_, table_, grid_costs(sweep, beams, temper), static_cast<std::size_t>(shared_.sectors), cap,
                     count, {first_tile_, stride}, instructions_, rng_);
  last_work_ += work / static_cast<double>(stride);
  if (proposal.poses.size() == 0) return;

  // Importance weights: what was drawn by the table is weighed by the model in use.
  constexpr double kMostRatio = 20.0;
  std::vector<std::uint32_t> costs;
  scores_.score(sweep, beams, proposal.poses, costs);
  add_others(proposal.poses, costs);
  double sum = 0.0;
  for (std::size_t i = 0; i < proposal.poses.size(); ++i) {
    const double weight = std::exp(-temper / kScorePerNat * costs[i]);
    const double ratio = std::min(weight / static_cast<double>(proposal.likelihood[i]), kMostRatio);
    proposal.poses.weight[i] = static_cast<float>(ratio);
    sum += ratio;
  }
  if (!(sum > 0.0)) return;
  const double drawn = proposal.mean_likelihood * sum / static_cast<double>(proposal.poses.size());
  double share = 1.0;
  if (!is_first) {
    const double most_ratio = std::exp(knows ? shared_.most_nats_far : shared_.most_nats);
    const double ratio = likelihood > 0.0 ? std::min(drawn / likelihood, most_ratio) : most_ratio;
    share = prior * ratio / (1.0 - prior + prior * ratio);
  }
  for (float& weight : particles_.weight) weight *= static_cast<float>(1.0 - share);
  for (float& weight : proposal.poses.weight) weight *= static_cast<float>(share / sum);
  particles_.append(proposal.poses);
}

std::optional<double> MonteCarloLocalizer::fit(const RangeSweep& sweep, std::span<const BinnedBeam> beams) const {
  if (summary_.modes.empty() || beams.empty()) return std::nullopt;
  const Pose2& best = summary_.modes.front().map_from_robot;
  const std::int32_t place = space_.place_at(space_.frame().cell_at(best.position()));
  if (place == StateSpace::kNoPlace) return std::nullopt;
  const auto headings = static_cast<std::size_t>(space_.headings());
  const double turns = best.theta.radians() / space_.heading_step() + space_.headings();
  const auto heading = static_cast<std::size_t>(std::lround(turns)) % headings;
  const RangeTable::Row row = table_.row(static_cast<std::size_t>(place));
  double sum = 0.0;
  for (const BinnedBeam& beam : beams) {
    const std::size_t expected = row[(heading + beam.direction) % headings];
    sum += static_cast<double>(model_.log_probabilities(bin_of(sweep.beams[beam.beam], model_))[expected]);
  }
  return sum / static_cast<double>(beams.size());
}

BeamChoice MonteCarloLocalizer::choose_beams(const RangeSweep& sweep, std::vector<std::uint8_t> on_persons) {
  likely_ = particles_.size() > 0 ? likely_states(bins_of(particles_, space_), space_, kLikelyFraction, kMostLikely)
                                  : std::vector<LikelyState>{};
  const BeamChoiceParams params = shared_.beam_choice(std::move(on_persons), verdict_.keeps_its_place());
  return chosen_beams(likely_, table_, space_.headings(), model_, sweep, params, ++phase_, rng_);
}

void MonteCarloLocalizer::judge(const Evidence& evidence, const std::optional<Pose2>& predicted) {
  verdict_.add(with_best_mode(evidence, summary_, predicted));
  if (!verdict_.collapsed()) return;
  start_over_ = 0.9;
  verdict_.reset();
  refiner_.reset();
  rivals_.forget();
}

PositionDensity MonteCarloLocalizer::density() const {
  PositionDensity density{space_.frame(), std::vector<float>(space_.frame().size(), 0.0F)};
  if (particles_.size() == 0) {
    for (std::size_t place = 0; place < space_.places(); ++place)
      density.mass[space_.frame().index(space_.cell(place))] = 1.0F / static_cast<float>(space_.places());
  }
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const CellIndex cell = space_.frame().cell_at(particles_.pose(i).position());
    if (space_.frame().holds(cell)) density.mass[space_.frame().index(cell)] += particles_.weight[i];
  }
  return density;
}

std::vector<float> MonteCarloLocalizer::entropy_gains(const RangeSweep& sweep, const Pose2& odom_now) const {
  if (likely_.empty()) return {};
  const ExpectedRanges expected{likely_, table_, space_.headings(), true};
  return docent::entropy_gains(expected, model_, seen_from(sweep, inverse(odom_from_robot_) * odom_now),
                               space_.headings());
}

}  // namespace docent
