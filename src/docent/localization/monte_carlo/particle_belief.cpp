#include "docent/localization/monte_carlo/particle_belief.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "docent/localization/markov/grid_belief.h"
#include "docent/localization/monte_carlo/particle_summary.h"
#include "docent/localization/particles/particle_motion.h"
#include "docent/localization/particles/particle_strata.h"
#include "docent/localization/particles/particle_weights.h"

namespace docent::localization {
namespace {

constexpr double kLikelyFraction = 1e-3;   // of the likeliest state: those that the filters ask
constexpr std::size_t kMostLikely = 6000;  // more, and the belief is too wide for filters
constexpr double kSurprising = 0.5;        // of the evidence is missing: at every update poses are drawn
constexpr double kNewView = 0.1;           // of the usual likelihood: less is not the view that was there
constexpr double kUpdateSeconds = 0.25;    // what one update may take of the robot's time, if the work is paid
constexpr double kStartsOver = 0.9;        // probability that all particles are wrong, when nothing else explains

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

ParticleBelief::ParticleBelief(std::shared_ptr<const KnownMap> map, const LocalizerParams& shared,
                               const MonteCarloParams& params, std::uint64_t seed)
    : map_{std::move(map)},
      shared_{shared},
      params_{params},
      scores_{params.model == "field" ? SweepScores::Model::field : SweepScores::Model::beam,
              BeamScores{map_->space, map_->table, map_->model, shared.sensor.max_range},
              LikelihoodField{map_->caster, params.field, shared.sensor.max_range},
              map_->space.headings(),
              static_cast<std::size_t>(shared.sectors),
              shared.most_sector_nats,
              shared.sensor.max_range},
      instructions_{instruction_set_of(shared.simd).value_or(InstructionSet::plain)},
      noise_{Rng{seed}.stream("particles")()} {
  const auto fields = field_kernels();  // as many as the processor has sets, in their order
  scores_.use_kernel(fields[std::min(fields.size() - 1, static_cast<std::size_t>(instructions_))].kernel);
}

void ParticleBelief::use_kernels(FieldKernel field, InstructionSet grid) {
  scores_.use_kernel(field);
  instructions_ = grid;
}

void ParticleBelief::start_unknown() {
  particles_.clear();
  undrawn_ = 0;
  long_mean_ = short_mean_ = start_over_ = 0.0;
}

void ParticleBelief::set_out(const Pose2& odom_from_robot) {
  odom_from_robot_ = odom_from_robot;
  long_mean_ = short_mean_ = start_over_ = 0.0;
}

void ParticleBelief::believe(std::span<const BeliefMode> modes, double /*elsewhere*/, Rng& rng) {
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
      const double x = rng.normal(at.x, deviation_x);
      const double y = rng.normal(at.y, deviation_y);
      const Angle theta = at.theta + Angle::radians(rng.normal(0.0, deviation_theta));
      particles_.set(i, {x, y, theta}, static_cast<float>(mode.mass / mass / static_cast<double>(each)));
    }
  }
}

std::size_t ParticleBelief::most_particles() const {
  const double affordable = shared_.work_per_second * kUpdateSeconds / shared_.beams;
  return static_cast<std::size_t>(
      std::clamp(affordable, static_cast<double>(params_.least), static_cast<double>(params_.most)));
}

void ParticleBelief::predict(const Motion& motion, const Pose2& odom_from_robot, bool /*keeps_its_place*/) {
  odom_from_robot_ = odom_from_robot;
  const GridFrame& frame = map_->space.frame();
  const MapBox box{static_cast<float>(frame.origin.x), static_cast<float>(frame.origin.y),
                   static_cast<float>(frame.origin.x + frame.columns * frame.resolution),
                   static_cast<float>(frame.origin.y + frame.rows * frame.resolution)};
  move_particles(particles_, shared_.motion, motion.before_from_after, {params_.shake_position, params_.shake_heading},
                 box, noise_);
}

PoseBelief::Reweighed ParticleBelief::reweigh(const SensorEvidence& evidence, Rng& rng) {
  Scoring scoring;
  const double one_view = shared_.independent_beams / shared_.beams;
  scoring.temper = std::min(1.0, evidence.views * one_view);
  scoring.weight = evidence.weight;
  scoring.work = static_cast<double>(particles_.size()) * static_cast<double>(evidence.beams.size());
  scoring.others = ask_sensors(evidence, scoring.temper);
  if (scoring.others.steps_per_nat > 0.0) scoring.work += kWorkOfOthers * static_cast<double>(particles_.size());
  if (particles_.size() > 0) {
    reweigh_particles(evidence, scoring);
    notice_surprise(scoring.likelihood, scoring.weight, scoring.temper / one_view);
  }
  draw_elsewhere(evidence, scoring, rng);
  return {scoring.weight, scoring.work};
}

void ParticleBelief::reweigh_particles(const SensorEvidence& evidence, Scoring& scoring) {
  std::vector<std::uint32_t> costs;
  scores_.score(evidence.seen, evidence.beams, particles_, costs);
  add_others(evidence.others, scoring.others, particles_, costs);
  // The same view again says little; another view, without motion, says that somebody carried the robot.
  const bool is_new = mean_likelihood(particles_, costs, scoring.temper / kScorePerNat) < kNewView * long_mean_;
  if (is_new) scoring.weight = 1.0;
  ParticleEvidence of_particles;
  of_particles.nats_per_cost = scoring.weight * scoring.temper / kScorePerNat;
  of_particles.most_nats = shared_.most_nats * std::sqrt(evidence.views);
  if (evidence.focus) {  // as the grid: sharp where the robot is, slow between there and elsewhere
    of_particles.focus = evidence.focus;
    of_particles.far_share = shared_.independent_beams_far / shared_.independent_beams;
    of_particles.far_most_nats = shared_.most_nats_far * std::sqrt(evidence.views);
  }
  scoring.likelihood = docent::localization::reweigh(particles_, costs, of_particles);
}

void ParticleBelief::resample(const Pose2& likeliest, Rng& rng) {
  const Strata strata{static_cast<std::size_t>(params_.least), most_particles(),
                      static_cast<std::size_t>(params_.reserve), params_.resample_below, params_.kld};
  resample_strata(particles_, likeliest, strata, rng, scratch_);
}

void ParticleBelief::gather(const Pose2& found, const Neighbourhood& focus, double share) {
  docent::localization::gather(particles_, {{found, focus.radius, focus.turn}, same_place(found), share});
}

bool ParticleBelief::flood() {
  start_over_ = kStartsOver;
  return false;
}

ParticleBelief::Others ParticleBelief::ask_sensors(const SensorEvidence& evidence, double temper) const {
  evidence.others.pass_over();
  if (evidence.others.none() || particles_.size() == 0) return {};
  const StateSpace& space = map_->space;
  std::vector<LikelyPose> likely;
  for (const LikelyState& state : evidence.likely) {
    const Point2 at = space.centre(static_cast<std::size_t>(state.place));
    const Angle heading = Angle::radians(state.heading * space.heading_step());
    likely.push_back({{at.x, at.y, heading}, static_cast<double>(state.mass)});
  }
  if (!evidence.others.observe({evidence.time, evidence.odom_from_robot, likely})) return {};
  return {kScorePerNat / temper, {}};
}

void ParticleBelief::add_others(ObservationModels& sensors, Others& others, const ParticleSet& particles,
                                std::vector<std::uint32_t>& costs) const {
  if (others.steps_per_nat == 0.0 || particles.size() == 0) return;
  std::vector<Pose2> poses;
  poses.reserve(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) poses.push_back(particles.pose(i));
  std::vector<float> nats(poses.size(), 0.0F);
  sensors.add_costs(poses, nats);
  // Relative to the best particle: a sensor that fits none must not look like a surprise of the lasers.
  if (!others.least) others.least = *std::min_element(nats.begin(), nats.end());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto above = static_cast<double>(std::max(0.0F, nats[i] - *others.least));
    costs[i] += static_cast<std::uint32_t>(std::lround(above * others.steps_per_nat));
  }
}

void ParticleBelief::notice_surprise(double likelihood, double weight, double views) {
  // As of a full update of one view.
  const double whole = std::exp(std::log(std::max(likelihood, 1e-30)) / (weight * views));
  if (long_mean_ == 0.0) long_mean_ = short_mean_ = whole;
  long_mean_ += weight * params_.surprise_slow * (whole - long_mean_);
  short_mean_ += weight * params_.surprise_fast * (whole - short_mean_);
}

std::size_t ParticleBelief::draws(bool knows, double surprise) {
  if (knows && start_over_ == 0.0 && surprise < kSurprising && ++undrawn_ < params_.draw_every) return 0;
  undrawn_ = 0;
  const auto most = most_particles();
  if (particles_.size() == 0) return most;
  const std::size_t some = std::max<std::size_t>(most / 8, 64);
  return knows ? std::min(some, particles_.size()) : some;
}

void ParticleBelief::draw_elsewhere(const SensorEvidence& evidence, Scoring& scoring, Rng& rng) {
  const bool knows = evidence.keeps_its_place;
  const double surprise = long_mean_ > 0.0 ? std::max(0.0, 1.0 - short_mean_ / long_mean_) : 0.0;
  const std::size_t count = draws(knows, surprise);
  if (count == 0) return;
  const bool is_first = particles_.size() == 0;
  double prior = knows ? std::max(shared_.teleport_probability, params_.deprived * surprise) : params_.deprived;
  if (start_over_ > 0.0) prior = start_over_;
  start_over_ = 0.0;

  // As many tiles of places as there is time for; others the next time.
  const StateSpace& space = map_->space;
  const double temper = scoring.weight * scoring.temper;
  const double work = static_cast<double>(space.states()) * static_cast<double>(evidence.beams.size());
  const double affordable = std::max(shared_.work_per_second * kUpdateSeconds, 1.0);
  const auto stride = is_first ? std::size_t{1} : static_cast<std::size_t>(std::ceil(std::max(1.0, work / affordable)));
  first_tile_ = (first_tile_ + 1) % stride;
  const auto cap = static_cast<std::uint16_t>(std::min(shared_.most_sector_nats * temper * kCostPerNat, 4000.0));
  ScanProposal proposal =
      draw_from_scan(space, map_->table, scan_costs(evidence.seen, evidence.beams, map_->model, temper).beams,
                     static_cast<std::size_t>(shared_.sectors), cap, count, {first_tile_, stride}, instructions_, rng);
  scoring.work += work / static_cast<double>(stride);
  if (proposal.poses.size() == 0) return;

  const double sum = weigh(proposal, evidence, scoring);
  if (!(sum > 0.0)) return;
  const double drawn = proposal.mean_likelihood * sum / static_cast<double>(proposal.poses.size());
  double share = 1.0;
  if (!is_first) {
    const double most_ratio = std::exp(knows ? shared_.most_nats_far : shared_.most_nats);
    const double ratio = scoring.likelihood > 0.0 ? std::min(drawn / scoring.likelihood, most_ratio) : most_ratio;
    share = prior * ratio / (1.0 - prior + prior * ratio);
  }
  for (float& weight : particles_.weight) weight *= static_cast<float>(1.0 - share);
  for (float& weight : proposal.poses.weight) weight *= static_cast<float>(share / sum);
  particles_.append(proposal.poses);
}

double ParticleBelief::weigh(ScanProposal& proposal, const SensorEvidence& evidence, Scoring& scoring) {
  constexpr double kMostRatio = 20.0;
  const double temper = scoring.weight * scoring.temper;
  std::vector<std::uint32_t> costs;
  scores_.score(evidence.seen, evidence.beams, proposal.poses, costs);
  add_others(evidence.others, scoring.others, proposal.poses, costs);
  double sum = 0.0;
  for (std::size_t i = 0; i < proposal.poses.size(); ++i) {
    const double weight = std::exp(-temper / kScorePerNat * costs[i]);
    const double ratio = std::min(weight / static_cast<double>(proposal.likelihood[i]), kMostRatio);
    proposal.poses.weight[i] = static_cast<float>(ratio);
    sum += ratio;
  }
  return sum;
}

BeliefSummary ParticleBelief::summarise() {
  if (particles_.size() == 0) return summarise_unknown(map_->space, {});
  BeliefSummary summary = docent::localization::summarise(bins_of(particles_, map_->space), map_->space, {});
  summary.active_states = particles_.size();
  return summary;
}

std::vector<LikelyState> ParticleBelief::likely() const {
  if (particles_.size() == 0) return {};
  return likely_states(bins_of(particles_, map_->space), map_->space, kLikelyFraction, kMostLikely);
}

PositionDensity ParticleBelief::density() const {
  PositionDensity density{map_->space.frame(), std::vector<float>(map_->space.frame().size(), 0.0F)};
  if (particles_.size() == 0) {
    for (std::size_t place = 0; place < map_->space.places(); ++place)
      density.mass[map_->space.frame().index(map_->space.cell(place))] =
          1.0F / static_cast<float>(map_->space.places());
  }
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const CellIndex cell = map_->space.frame().cell_at(particles_.pose(i).position());
    if (map_->space.frame().holds(cell)) density.mass[map_->space.frame().index(cell)] += particles_.weight[i];
  }
  return density;
}

}  // namespace docent::localization
