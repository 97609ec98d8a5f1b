#include "docent/localization/markov/grid_belief.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "docent/base/instruction_set.h"

namespace docent::localization {
namespace {

constexpr double kLikelyFraction = 1e-3;   // of the peak: states that the filters ask
constexpr std::size_t kMostLikely = 6000;  // more, and the belief is too wide for filters
constexpr double kFlooded = 0.9;           // of the mass

/// How far the sums over beams of a scan may reach.
EvidenceWeights weights_of(const SensorEvidence& evidence, const LocalizerParams& params, double temper) {
  EvidenceWeights weights;
  weights.most_nats = weights.far_most_nats = params.most_nats * std::sqrt(evidence.views);
  weights.most_sector_nats = evidence.sector_nats * temper;
  weights.sectors = static_cast<std::size_t>(params.sectors);
  if (evidence.focus) {
    weights.far_share = params.independent_beams_far / params.independent_beams;
    weights.far_most_nats = params.most_nats_far * std::sqrt(evidence.views);
    weights.focus = evidence.focus;
  }
  return weights;
}

}  // namespace

ScanCosts scan_costs(const sensor_models::RangeSweep& seen, std::span<const sensor_models::BinnedBeam> beams,
                     const sensor_models::ProximityModel& model, double temper) {
  ScanCosts scan{std::vector<BeamCosts>(beams.size()), 0.0};
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const int bin = bin_of(seen.beams[beams[i].beam], model);
    const auto log_probabilities = model.log_probabilities(bin);
    const float best = *std::max_element(log_probabilities.begin(), log_probabilities.end());
    for (std::size_t o = 0; o < sensor_models::kExpectedRanges; ++o) {
      const double nats = temper * static_cast<double>(best - log_probabilities[o]);
      scan.beams[i].costs[o] = static_cast<std::uint8_t>(std::min<long>(kMaxCost, std::lround(nats * kCostPerNat)));
    }
    scan.beams[i].direction = beams[i].direction;
    scan.log_best_over_mean += temper * (static_cast<double>(best) - model.log_mean_probability(bin));
  }
  return scan;
}

GridBelief::GridBelief(std::shared_ptr<const KnownMap> map, const LocalizerParams& params)
    : map_{std::move(map)},
      params_{params},
      coarse_{map_->space, SummaryParams{}.rest_cell_size},
      belief_{map_->space, params.sea_threshold} {
  belief_.use(instruction_set_of(params.simd).value_or(InstructionSet::plain));
}

void GridBelief::start_unknown() {
  belief_.make_uniform();
  likeliest_heading_ = {};
}

void GridBelief::set_out(const Pose2& odom_from_robot) {
  odom_from_robot_ = odom_from_robot;
  odom_from_frame_ = {odom_from_robot.x, odom_from_robot.y, Angle{}};
}

void GridBelief::believe(std::span<const BeliefMode> modes, double elsewhere, Rng& /*rng*/) {
  std::vector<BeliefMode> of_frame{modes.begin(), modes.end()};
  for (BeliefMode& mode : of_frame) mode.map_from_robot = map_from_frame(mode.map_from_robot);
  belief_.make_modes(of_frame, elsewhere);
}

Point2 GridBelief::follow(bool keeps_its_place) {
  const double cell = map_->space.frame().resolution;
  const Point2 ahead = frame_from_robot().position();  // how far the robot has left the frame behind
  // In whole cells as the likeliest heading sees them: then its states are not smeared over their neighbours. Others
  // are, so that the frame follows in longer steps as long as they count.
  const double patience = keeps_its_place ? 0.6 * cell : 2.0 * cell;
  if (norm(ahead) <= patience) return {};
  const Pose2 turned{0.0, 0.0, likeliest_heading_};
  const Point2 in_map = turned * ahead;
  const Point2 whole{cell * std::round(in_map.x / cell), cell * std::round(in_map.y / cell)};
  const Point2 shift = inverse(turned) * whole;
  odom_from_frame_ = {odom_from_frame_.x + shift.x, odom_from_frame_.y + shift.y, Angle{}};
  return shift;
}

void GridBelief::predict(const Motion& motion, const Pose2& odom_from_robot, bool keeps_its_place) {
  odom_from_robot_ = odom_from_robot;
  if (!(motion.way > 0.0 || motion.turn > 0.0)) return;
  const Point2 shift = follow(keeps_its_place);
  const OdometryStep step{motion_models::motion_noise(params_.motion, motion.before_from_after), motion.way,
                          motion.turn};
  belief_.move(motion_kernel(map_->space, params_.motion, shift, step));
}

PoseBelief::Reweighed GridBelief::reweigh(const SensorEvidence& evidence, Rng& /*rng*/) {
  const double temper = evidence.weight * std::min(1.0, evidence.views * params_.independent_beams / params_.beams);
  ScanCosts scan = scan_costs(evidence.seen, evidence.beams, map_->model, temper);
  Reweighed result{evidence.weight,
                   static_cast<double>(belief_.active_states()) * static_cast<double>(scan.beams.size())};
  EvidenceWeights weights = weights_of(evidence, params_, temper);
  if (weights.focus) weights.focus->about = map_from_frame(weights.focus->about);
  const PlaceCosts others = ask_sensors(evidence);
  if (others) {
    scan.log_best_over_mean += evidence.weight * evidence.others.mean_cost();
    result.work += kWorkOfOthers * static_cast<double>(belief_.active_states());
  }
  belief_.reweigh(map_->table, scan.beams, scan.log_best_over_mean, weights,
                  evidence.in_doubt ? params_.teleport_in_doubt : params_.teleport_probability, others);
  return result;
}

PlaceCosts GridBelief::ask_sensors(const SensorEvidence& evidence) const {
  ObservationModels& sensors = evidence.others;
  sensors.pass_over();
  if (sensors.none() || belief_.active_states() > static_cast<std::size_t>(params_.most_states_asked)) return {};
  const StateSpace& space = map_->space;
  const Pose2 robot = frame_from_robot();
  std::vector<LikelyPose> likely;
  for (const LikelyState& state : evidence.likely) {
    const Point2 at = space.centre(static_cast<std::size_t>(state.place));
    const Pose2 map_from_frame{at.x, at.y, Angle::radians(state.heading * space.heading_step())};
    likely.push_back({map_from_frame * robot, static_cast<double>(state.mass)});
  }
  if (!sensors.observe({evidence.time, evidence.odom_from_robot, likely})) return {};
  std::vector<Pose2> offsets;  // from the middle of a place to the robot, for each heading
  for (int h = 0; h < space.headings(); ++h)
    offsets.push_back(Pose2{0.0, 0.0, Angle::radians(h * space.heading_step())} * robot);
  return [&space, &sensors, weight = evidence.weight, offsets = std::move(offsets), poses = std::vector<Pose2>{},
          nats = std::vector<float>{}](std::size_t place, std::span<std::uint16_t> costs) mutable {
    const Point2 at = space.centre(place);
    poses = offsets;
    for (Pose2& pose : poses) pose.x += at.x, pose.y += at.y;
    nats.assign(poses.size(), 0.0F);
    sensors.add_costs(poses, nats);
    for (std::size_t h = 0; h < costs.size(); ++h) {
      const double cost = weight * static_cast<double>(nats[h]) * kCostPerNat + 0.5;
      costs[h] = static_cast<std::uint16_t>(std::min(65535.0, static_cast<double>(costs[h]) + std::floor(cost)));
    }
  };
}

void GridBelief::gather(const Pose2& found, const Neighbourhood& focus, double share) {
  const Pose2 of_frame = map_from_frame(found);
  belief_.gather({{of_frame, focus.radius, focus.turn}, same_place(of_frame), share});
}

bool GridBelief::flood() {
  belief_.flood(kFlooded);
  return true;
}

BeliefSummary GridBelief::summarise() {
  BeliefSummary summary = docent::localization::summarise(belief_, coarse_, frame_from_robot(), {});
  if (!summary.modes.empty())
    likeliest_heading_ = summary.modes.front().map_from_robot.theta - frame_from_robot().theta;
  return summary;
}

std::vector<LikelyState> GridBelief::likely() const { return likely_states(belief_, kLikelyFraction, kMostLikely); }

PositionDensity GridBelief::density() const {
  const StateSpace& space = map_->space;
  PositionDensity density{space.frame(), std::vector<float>(space.frame().size(), 0.0F)};
  for (std::size_t i = 0; i < belief_.kept_places().size(); ++i) {
    float sum = 0.0F;
    for (const float value : belief_.row(i)) sum += value;
    density.mass[space.frame().index(space.cell(static_cast<std::size_t>(belief_.kept_places()[i])))] = sum;
  }
  return density;
}

}  // namespace docent::localization
