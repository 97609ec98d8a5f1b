#include "docent/localization/pose_watch/pose_watch.h"

#include <cmath>
#include <span>
#include <utility>

#include "docent/localization/belief/belief_summary.h"

namespace docent::localization {

PoseWatch::PoseWatch(std::unique_ptr<Localizer> localizer, const std::vector<Pose2>& base_from_laser,
                     CheckpointKeeper checkpoints, const PoseWatchParams& params, Time now)
    : localizer_{std::move(localizer)},
      params_{params},
      sweeps_{base_from_laser},
      rounds_{base_from_laser.size()},
      odometry_{params.base},
      checkpoints_{std::move(checkpoints)} {
  if (const auto before = checkpoints_.restore(now))
    localizer_->start_at(before->modes, before->odom_from_robot, before->time);
}

void PoseWatch::move(Time stamp, const Pose2& raw_from_base) {
  odometry_.add(stamp, raw_from_base);
  if (checkpoints_.is_contradicted_by(odometry_.latest())) localizer_->start_unknown();
}

bool PoseWatch::is_look_due(Time now) const {
  if (!rounds_.is_whole() || odometry_.empty()) return false;
  return !awaits_odometry() || now - rounds_.whole_since() >= kOdometryPatience;
}

bool PoseWatch::awaits_odometry() const {
  return rounds_.is_whole() && (odometry_.empty() || odometry_.latest_time() < sweeps_.newest());
}

/// The lasers were where they were; so the base is not where it was thought to be, by what this one has of the belief.
void PoseWatch::mount(std::size_t laser, const Pose2& base_from_laser) {
  constexpr double kMatters = 0.02;      // [m] and
  constexpr double kMattersTurn = 0.01;  // [rad]: less lies within the belief
  const Pose2 before = sweeps_.mount(laser, base_from_laser);
  const Pose2 moved = before * inverse(base_from_laser);
  if (norm(moved.position()) < kMatters && std::abs(moved.theta.radians()) < kMattersTurn) return;
  const bool has_place = is_localized() || verdict().keeps_its_place();  // one laser after the other is found elsewhere
  if (!has_place || localizer_->summary().modes.empty()) return localizer_->start_unknown();
  const double share = 1.0 / static_cast<double>(sweeps_.lasers());
  const Pose2 part{share * moved.x, share * moved.y, Angle::radians(share * moved.theta.radians())};
  const double rest = 1.0 - share;  // of it may be the belief's, too
  const double square = rest * rest * dot(moved.position(), moved.position());
  BeliefMode mode = best_mode();
  mode.map_from_robot = mode.map_from_robot * part;
  mode.covariance[0] += square;
  mode.covariance[4] += square;
  mode.covariance[8] += rest * rest * moved.theta.radians() * moved.theta.radians();
  localizer_->start_at(std::span{&mode, 1}, localizer_->odom_from_robot(), belief_told_);
}

std::optional<PoseWatch::Look> PoseWatch::look(Time now) {
  auto joined = sweeps_.join(odometry_);
  if (joined || !sweeps_.has_new()) rounds_.close(now);
  if (!joined) return std::nullopt;
  Look look{{joined->stamp, joined->odom_from_base}, std::move(joined->sweep)};
  const Localizer::Step step = localizer_->observe(look.sweep, look.moment.odom_from_base, look.moment.stamp);
  if (step.updated) last_update_ = step;
  const bool has_jumped = odometry_.take_jump(look.moment.stamp);
  look.is_belief_due = step.updated || has_jumped || now - belief_told_ >= kBeliefEvery;
  look.is_pose_due = step.updated && is_localized();
  if (look.is_pose_due) {
    const Pose2 raw_from_robot = odometry_.in_raw(localizer_->odom_from_robot(), look.moment.stamp);
    checkpoints_.keep(look.moment.stamp, raw_from_robot, localizer_->summary().modes, now);
  }
  return look;
}

std::optional<PoseWatch::Moment> PoseWatch::start_where_told(const BeliefMode& mode, Time stamp) {
  if (odometry_.empty()) return std::nullopt;
  checkpoints_.forget_restored();
  Moment moment{odometry_.latest_time(), odometry_.latest()};
  if (const auto then = odometry_.at(stamp)) moment = {stamp, *then};
  localizer_->start_at(std::span{&mode, 1}, moment.odom_from_base, moment.stamp);
  return moment;
}

void PoseWatch::take_fix(PoseFix fix) {
  const auto then = odometry_.at(fix.time);
  if (!then) return;
  fix.odom_from_robot = *then;
  localizer_->take_fix(fix);
}

BeliefSummary PoseWatch::tell_belief(const Moment& moment, Time now) {
  belief_told_ = now;
  return carried_on(localizer_->summary(), inverse(localizer_->odom_from_robot()) * moment.odom_from_base);
}

Pose2 PoseWatch::map_from_raw(const Moment& moment) const {
  return *localizer_->map_from_robot({}) * odometry_.odom_from_raw(moment.stamp);
}

PoseWatch::Beams PoseWatch::beams(const Look& look) const {
  Beams result;
  result.origins = localizer_->origins(look.sweep, look.moment.odom_from_base, params_.max_range, params_.people);
  for (std::size_t i = 0; i < look.sweep.beams.size(); ++i) {
    const sensor_models::SweepBeam& beam = look.sweep.beams[i];
    if (result.origins[i] != sensor_models::BeamOrigin::not_map || beam.range > params_.person_range) continue;
    result.ends.push_back(sensor_models::endpoint(beam));
  }
  return result;
}

}  // namespace docent::localization
