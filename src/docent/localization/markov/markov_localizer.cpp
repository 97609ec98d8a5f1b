#include "docent/localization/markov/markov_localizer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <thread>
#include <utility>

#include "docent/base/check.h"
#include "docent/localization/belief/person_shapes.h"

namespace docent {

namespace {

constexpr double kLikelyFraction = 1e-3;   // of the peak: states that the filters ask
constexpr double kSurpriseWaits = 0.15;    // [s]
constexpr std::size_t kMostLikely = 6000;  // more, and the belief is too wide for filters
constexpr double kRadians = std::numbers::pi / 180.0;

/// All that a table depends on, beside the program: numbers to the last bit.
std::string table_key(const OccupancyGrid& map, const MarkovLocalizerParams& params) {
  const StateSpaceParams& states = params.states;
  std::array<char, 128> numbers{};
  std::snprintf(numbers.data(), numbers.size(), " %a %a %a %a %a", states.cell_size, states.heading_step,
                states.min_clearance, states.wall_depth, params.sensor.max_range);
  return map_hash(map) + numbers.data();
}

}  // namespace

RangeTable range_table_of(const OccupancyGrid& map, const MarkovLocalizerParams& params, const RangeTableCache& cache,
                          const StateSpace& space, const RayCaster& caster) {
  const ProximityModel model{params.sensor};
  const RangeTable::Building how{std::max(1U, std::thread::hardware_concurrency()), {}};
  if (cache.folder.empty()) return RangeTable::build(space, caster, model, how);
  const std::string key = table_key(map, params);
  const std::filesystem::path file = cache.file_of(key);
  RangeTable table = RangeTable::load_or_build(file, key, space, caster, model, how);
  cache.make_room(file);
  return table;
}

Result<void> MarkovLocalizerParams::validate() const {
  for (const auto& valid :
       {states.validate(), sensor.validate(), motion.validate(), verdict.validate(), refiner.validate()})
    if (!valid) return valid;
  if (!(beams >= 4 && beams <= 360)) return fail("beams must be 4..360");
  if (!(independent_beams > 0.0 && independent_beams <= beams))
    return fail("independent_beams must be > 0 and <= beams");
  if (!(independent_beams_far > 0.0 && independent_beams_far <= independent_beams))
    return fail("independent_beams_far must be > 0 and <= independent_beams");
  if (auto known = beam_filter_of(filter); !known) return tl::unexpected<Error>(known.error());
  if (!(filter_sureness > 0.5 && filter_sureness < 1.0)) return fail("filter_sureness must be 0.5..1");
  if (!(unfiltered_share >= 0.0 && unfiltered_share <= 1.0)) return fail("unfiltered_share must be 0..1");
  if (!(person_share >= 0.0 && person_share <= 1.0)) return fail("person_share must be 0..1");
  if (!(sea_threshold >= 0.0 && sea_threshold < 1.0)) return fail("sea_threshold must be 0..1");
  if (!(teleport_probability >= 0.0 && teleport_probability < 0.1)) return fail("teleport_probability must be 0..0.1");
  if (!(teleport_in_doubt >= 0.0 && teleport_in_doubt <= 0.5)) return fail("teleport_in_doubt must be 0..0.5");
  if (!(update_way > 0.0 && update_turn > 0.0)) return fail("update_way and update_turn must be > 0");
  if (!(creeping_period > 0.0 && standing_period > 0.0)) return fail("creeping_period and standing_period must be > 0");
  if (!(standing_weight >= 0.0 && standing_weight <= 1.0)) return fail("standing_weight must be 0..1");
  if (!(most_views >= 1.0 && most_views <= 10.0)) return fail("most_views must be 1..10");
  for (const double nats : {most_nats, most_nats_far})
    if (!(nats > 0.0 && nats <= 60.0)) return fail("most_nats and most_nats_far must be > 0 and <= 60");
  if (!(focus_radius > 0.0 && focus_turn > 0.0 && focus_deviations >= 0.0))
    return fail("focus_radius and focus_turn must be > 0 and focus_deviations >= 0");
  if (!(sectors >= 1 && sectors <= 60)) return fail("sectors must be 1..60");
  for (const double nats : {most_sector_nats, most_sector_nats_lost})
    if (!(nats > 0.0)) return fail("most_sector_nats and most_sector_nats_lost must be > 0");
  if (!(most_states_asked >= 0)) return fail("most_states_asked must be >= 0");
  if (!(work_per_second > 0.0)) return fail("work_per_second must be > 0");
  if (auto known = instruction_set_of(simd); !known) return tl::unexpected<Error>(known.error());
  return {};
}

double MarkovLocalizerParams::views(double way, double turn) const {
  const double updates = std::max(way / update_way, turn / (update_turn * kRadians));
  return std::clamp(0.5 * updates, 1.0, most_views);
}

Neighbourhood MarkovLocalizerParams::focus(const Pose2& predicted, const Pose2& before_from_after) const {
  const MotionNoise noise = motion_noise(motion, before_from_after);
  return {predicted, std::max(focus_radius, focus_deviations * std::sqrt(noise.position_variance)),
          std::max(focus_turn, focus_deviations * std::sqrt(noise.heading_variance))};
}

std::vector<std::uint8_t> MarkovLocalizerParams::on_persons(const RangeSweep& sweep, bool keeps_its_place) const {
  return keeps_its_place || person_share >= 1.0 ? std::vector<std::uint8_t>{} : on_person_shapes(sweep);
}

double MarkovLocalizerParams::sector_nats(std::span<const std::uint8_t> on_persons) const {
  constexpr double kMostlyPeople = 0.2;  // share of the beams that are left
  constexpr double kFewPeople = 0.4;
  if (!rivals || on_persons.empty()) return most_sector_nats;
  const auto left = static_cast<double>(std::count(on_persons.begin(), on_persons.end(), std::uint8_t{0}));
  const double share = left / static_cast<double>(on_persons.size());
  const double trust = std::clamp((share - kMostlyPeople) / (kFewPeople - kMostlyPeople), 0.0, 1.0);
  return most_sector_nats + trust * (most_sector_nats_lost - most_sector_nats);
}

BeamChoiceParams MarkovLocalizerParams::beam_choice(std::vector<std::uint8_t> on_persons, bool keeps_its_place) const {
  BeamChoiceParams choice;
  choice.filter = beam_filter_of(filter).value_or(BeamFilter::distance);
  choice.sureness = filter_sureness;
  choice.unfiltered_share = unfiltered_share;
  choice.most = static_cast<std::size_t>(beams);
  choice.keeps_its_place = keeps_its_place;
  choice.on_persons = std::move(on_persons);
  choice.person_share = person_share;
  return choice;
}

MarkovLocalizer::MarkovLocalizer(const OccupancyGrid& map, const MarkovLocalizerParams& params,
                                 const RangeTableCache& cache, std::uint64_t seed)
    : params_{params},
      caster_{peeled(map, params.states.wall_depth)},
      space_{map, caster_, params.states},
      table_{range_table_of(map, params, cache, space_, caster_)},
      model_{params.sensor, table_.frequency()},
      coarse_{space_, SummaryParams{}.rest_cell_size},
      belief_{space_, params.sea_threshold},
      verdict_{params.verdict},
      refiner_{params.refiner},
      rng_{Rng{seed}.stream("localize")},
      widest_{map.frame.resolution * std::hypot(map.frame.columns, map.frame.rows)} {
  belief_.use(instruction_set_of(params.simd).value_or(InstructionSet::plain));
  start_unknown();
}

void MarkovLocalizer::start_unknown() {
  belief_.make_uniform();
  started_ = false;
  likeliest_heading_ = {};
  phase_ = 0;
  last_work_ = turned_here_ = 0.0;
  verdict_.reset();
  refiner_.reset();
  rivals_.forget();
  summarise_now();
}

void MarkovLocalizer::start_at(std::span<const BeliefMode> modes, const Pose2& odom_from_robot, Time time) {
  odom_from_robot_ = odom_from_robot;
  odom_from_frame_ = {odom_from_robot.x, odom_from_robot.y, Angle{}};
  believe(modes, 1e-4);
  started_ = true;
  last_update_ = time;
  last_work_ = turned_here_ = 0.0;
  verdict_.assume_localized();
  refiner_.reset();
  rivals_.forget();
  summarise_now();
}

void MarkovLocalizer::believe(std::span<const BeliefMode> modes, double uniform_mass) {
  std::vector<BeliefMode> of_frame{modes.begin(), modes.end()};
  for (BeliefMode& mode : of_frame) mode.map_from_robot = mode.map_from_robot * inverse(frame_from_robot());
  belief_.make_modes(of_frame, uniform_mass);
}

void MarkovLocalizer::keep_rivals(const RangeSweep& sweep, const Pose2& before_from_after, double weight) {
  if (!params_.rivals || verdict_.keeps_its_place()) return rivals_.forget();
  const auto modes = rivals_.update(summary_, sweep, before_from_after, caster_, params_.sensor.max_range);
  rivals_.hear(summary_, sensors(), weight);
  if (!modes) return;
  believe(*modes, params_.teleport_probability);
  summarise_now();
}

void MarkovLocalizer::summarise_now() {
  likely_ = likely_states(belief_, kLikelyFraction, kMostLikely);
  summary_ = summarise(belief_, coarse_, frame_from_robot(), {});
  if (!summary_.modes.empty())
    likeliest_heading_ = summary_.modes.front().map_from_robot.theta - frame_from_robot().theta;
}

double MarkovLocalizer::due_weight(double way, double turn, Time time) const {
  const double waited = to_seconds(time - last_update_);
  if (waited * params_.work_per_second < last_work_) return 0.0;
  const double moved = std::max(way / params_.update_way, turn / (params_.update_turn * kRadians));
  const bool shows_news = way >= params_.update_way || !goes_round() || waited >= params_.creeping_period;
  if (moved >= 1.0) return shows_news ? 1.0 : 0.0;
  const bool stands = way < 0.005 && turn < 0.005;
  if (waited < (stands ? params_.standing_period : params_.creeping_period)) return 0.0;
  return std::max(moved, params_.standing_weight);
}

MarkovLocalizer::Step MarkovLocalizer::observe(const RangeSweep& sweep, const Pose2& odom_from_robot, Time time) {
  Step step;
  // Farther than the map reaches nobody has driven: odometry is torn, and says nothing of where the robot is now.
  if (started_ && !(distance(odom_from_robot_.position(), odom_from_robot.position()) <= widest_)) start_unknown();
  const Pose2 before_from_after = started_ ? inverse(odom_from_robot_) * odom_from_robot : Pose2{};
  const double way = norm(before_from_after.position());
  const double turn = std::abs(before_from_after.theta.radians());
  if (sweep.beams.empty()) return step;
  const std::optional<Pose2> predicted = started_ ? map_from_robot(odom_from_robot) : std::nullopt;
  step.weight = started_ ? due_weight(way, turn, time) : 1.0;
  const double views = params_.views(way, goes_round() ? 0.0 : turn);
  if (predicted && views <= 1.0) verdict_.look(glance(caster_, sweep, *predicted, params_.sensor.max_range));
  // Someone may have carried the robot: then this is not the same view again, and nothing to wait for.
  if (step.weight < 1.0 && verdict_.keeps_its_place() && to_seconds(time - last_update_) >= kSurpriseWaits &&
      verdict_.startled())
    step.weight = 1.0;
  if (step.weight <= 0.0) return step;

  odom_from_robot_ = odom_from_robot;
  if (!started_) odom_from_frame_ = {odom_from_robot.x, odom_from_robot.y, Angle{}};
  started_ = true;
  last_update_ = time;
  if (way > 0.0 || turn > 0.0) move(before_from_after);
  if (distance(odom_from_robot.position(), turns_at_) >= params_.update_way) {
    turns_at_ = odom_from_robot.position();
    turned_here_ = 0.0;
  }
  turned_here_ += turn;

  const RangeSweep seen = seen_from(sweep, frame_from_robot());
  const std::vector<std::uint8_t> on_persons = params_.on_persons(sweep, verdict_.keeps_its_place());
  BeamChoice choice = choose_beams(seen, on_persons);
  const double temper = step.weight * std::min(1.0, views * params_.independent_beams / params_.beams);
  std::vector<BeamCosts> costs(choice.used.size());
  double log_best_over_mean = 0.0;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const int bin = bin_of(seen.beams[choice.used[i].beam], model_);
    const auto log_probabilities = model_.log_probabilities(bin);
    const float best = *std::max_element(log_probabilities.begin(), log_probabilities.end());
    for (std::size_t o = 0; o < kExpectedRanges; ++o) {
      const double nats = temper * static_cast<double>(best - log_probabilities[o]);
      costs[i].costs[o] = static_cast<std::uint8_t>(std::min<long>(kMaxCost, std::lround(nats * kCostPerNat)));
    }
    costs[i].direction = choice.used[i].direction;
    log_best_over_mean += temper * (static_cast<double>(best) - model_.log_mean_probability(bin));
  }
  last_work_ = static_cast<double>(belief_.active_states()) * static_cast<double>(costs.size());
  EvidenceWeights weights;
  weights.most_nats = weights.far_most_nats = params_.most_nats * std::sqrt(views);
  weights.most_sector_nats = params_.sector_nats(on_persons) * temper;
  weights.sectors = static_cast<std::size_t>(params_.sectors);
  if (verdict_.keeps_its_place() && predicted) {
    weights.far_share = params_.independent_beams_far / params_.independent_beams;
    weights.far_most_nats = params_.most_nats_far * std::sqrt(views);
    weights.focus = params_.focus(*predicted * inverse(frame_from_robot()), before_from_after);
  }
  const PlaceCosts others = ask_sensors(step.weight);
  if (others) {
    log_best_over_mean += step.weight * sensors().mean_cost();
    last_work_ += kWorkOfOthers * static_cast<double>(belief_.active_states());
  }
  const bool in_doubt = verdict_.contradicted() || verdict_.startled();
  belief_.reweigh(table_, costs, log_best_over_mean, weights,
                  in_doubt ? params_.teleport_in_doubt : params_.teleport_probability, others);
  step.updated = true;
  step.beams_used = costs.size();
  step.beams_filtered = choice.filtered;

  summarise_now();
  keep_rivals(on_persons.empty() ? sweep : without(sweep, on_persons), before_from_after, step.weight);
  if (!summary_.modes.empty()) {
    const MotionNoise noise = motion_noise(params_.motion, before_from_after);
    BeliefMode& best = summary_.modes.front();
    best.map_from_robot = refiner_.refine(best, sweep, before_from_after, noise.position_variance,
                                          noise.heading_variance, caster_, params_.sensor.max_range);
    if (weights.focus) gather(*weights.focus);
  }
  step.fit = fit(seen, choice.used);
  // After a long way odometry foretells too little: the belief of after the update is held against the readings.
  if (views > 1.0 && !likely_.empty()) {
    const ExpectedRanges expected{likely_, table_, space_.headings(), false};
    choice.readings = agreement_of_all(expected, model_, seen, params_.filter_sureness, space_.headings());
  }
  judge({.weight = step.weight, .views = views, .way = way, .turn = turn, .readings = choice.readings}, predicted);
  if (const auto now = map_from_robot(odom_from_robot))
    verdict_.look(glance(caster_, sweep, *now, params_.sensor.max_range));
  return step;
}

void MarkovLocalizer::gather(const Neighbourhood& focus) {
  const auto share = refiner_.found_share();
  if (!share) return;
  const Pose2 refined = summary_.modes.front().map_from_robot;
  const Pose2 found = refined * inverse(frame_from_robot());
  belief_.gather({{found, focus.radius, focus.turn}, same_place(found), *share});
  summarise_now();
  if (!summary_.modes.empty()) summary_.modes.front().map_from_robot = refined;
}

PlaceCosts MarkovLocalizer::ask_sensors(double weight) {
  sensors().pass_over();
  if (sensors().none() || belief_.active_states() > static_cast<std::size_t>(params_.most_states_asked)) return {};
  const Pose2 robot = frame_from_robot();
  std::vector<LikelyPose> likely;
  for (const LikelyState& state : likely_) {
    const Point2 at = space_.centre(static_cast<std::size_t>(state.place));
    const Pose2 map_from_frame{at.x, at.y, Angle::radians(state.heading * space_.heading_step())};
    likely.push_back({map_from_frame * robot, static_cast<double>(state.mass)});
  }
  if (!sensors().observe({last_update_, odom_from_robot_, likely})) return {};
  std::vector<Pose2> offsets;  // from the middle of a place to the robot, for each heading
  for (int h = 0; h < space_.headings(); ++h)
    offsets.push_back(Pose2{0.0, 0.0, Angle::radians(h * space_.heading_step())} * robot);
  return [this, weight, offsets = std::move(offsets), poses = std::vector<Pose2>{}, nats = std::vector<float>{}](
             std::size_t place, std::span<std::uint16_t> costs) mutable {
    const Point2 at = space_.centre(place);
    poses = offsets;
    for (Pose2& pose : poses) pose.x += at.x, pose.y += at.y;
    nats.assign(poses.size(), 0.0F);
    sensors().add_costs(poses, nats);
    for (std::size_t h = 0; h < costs.size(); ++h) {
      const double cost = weight * static_cast<double>(nats[h]) * kCostPerNat + 0.5;
      costs[h] = static_cast<std::uint16_t>(std::min(65535.0, static_cast<double>(costs[h]) + std::floor(cost)));
    }
  };
}

std::optional<double> MarkovLocalizer::fit(const RangeSweep& seen, std::span<const BinnedBeam> beams) const {
  if (summary_.modes.empty() || beams.empty()) return std::nullopt;
  const Pose2 map_from_frame = summary_.modes.front().map_from_robot * inverse(frame_from_robot());
  const std::int32_t place = space_.place_at(space_.frame().cell_at(map_from_frame.position()));
  if (place == StateSpace::kNoPlace) return std::nullopt;
  const auto headings = static_cast<std::size_t>(space_.headings());
  const double turns = map_from_frame.theta.radians() / space_.heading_step() + space_.headings();
  const auto heading = static_cast<std::size_t>(std::lround(turns)) % headings;
  const RangeTable::Row row = table_.row(static_cast<std::size_t>(place));
  double sum = 0.0;
  for (const BinnedBeam& beam : beams) {
    const std::size_t expected = row[heading + beam.direction];
    sum += static_cast<double>(model_.log_probabilities(bin_of(seen.beams[beam.beam], model_))[expected]);
  }
  return sum / static_cast<double>(beams.size());
}

void MarkovLocalizer::move(const Pose2& before_from_after) {
  const double cell = space_.frame().resolution;
  const Point2 ahead = frame_from_robot().position();  // how far the robot has left the frame behind
  // In whole cells as the likeliest heading sees them: then its states are not smeared over their neighbours. Others
  // are, so that the frame follows in longer steps as long as they count.
  const double patience = verdict_.keeps_its_place() ? 0.6 * cell : 2.0 * cell;
  Point2 shift{};
  if (norm(ahead) > patience) {
    const Pose2 turned{0.0, 0.0, likeliest_heading_};
    const Point2 in_map = turned * ahead;
    const Point2 whole{cell * std::round(in_map.x / cell), cell * std::round(in_map.y / cell)};
    shift = inverse(turned) * whole;
    odom_from_frame_ = {odom_from_frame_.x + shift.x, odom_from_frame_.y + shift.y, Angle{}};
  }
  const OdometryStep step{motion_noise(params_.motion, before_from_after), norm(before_from_after.position()),
                          std::abs(before_from_after.theta.radians())};
  belief_.move(motion_kernel(space_, params_.motion, shift, step));
}

BeamChoice MarkovLocalizer::choose_beams(const RangeSweep& seen, std::vector<std::uint8_t> on_persons) {
  likely_ = likely_states(belief_, kLikelyFraction, kMostLikely);
  const BeamChoiceParams params = params_.beam_choice(std::move(on_persons), verdict_.keeps_its_place());
  return chosen_beams(likely_, table_, space_.headings(), model_, seen, params, ++phase_, rng_);
}

void MarkovLocalizer::judge(const Evidence& evidence, const std::optional<Pose2>& predicted) {
  verdict_.add(with_best_mode(evidence, summary_, predicted));
  if (!verdict_.collapsed()) return;
  belief_.flood(0.9);
  verdict_.reset();
  refiner_.reset();
  rivals_.forget();
  summarise_now();
}

PositionDensity MarkovLocalizer::density() const {
  PositionDensity density{space_.frame(), std::vector<float>(space_.frame().size(), 0.0F)};
  for (std::size_t i = 0; i < belief_.kept_places().size(); ++i) {
    float sum = 0.0F;
    for (const float value : belief_.row(i)) sum += value;
    density.mass[space_.frame().index(space_.cell(static_cast<std::size_t>(belief_.kept_places()[i])))] = sum;
  }
  return density;
}

std::vector<float> MarkovLocalizer::entropy_gains(const RangeSweep& sweep, const Pose2& odom_now) const {
  if (likely_.empty()) return {};
  const ExpectedRanges expected{likely_, table_, space_.headings(), true};
  return docent::entropy_gains(expected, model_, seen_from(sweep, inverse(odom_from_frame_) * odom_now),
                               space_.headings());
}

}  // namespace docent
