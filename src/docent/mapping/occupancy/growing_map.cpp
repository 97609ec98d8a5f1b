#include "docent/mapping/occupancy/growing_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace docent::mapping {
namespace {

constexpr double kSpare = 8.0;     // [m] about what is known, so that the frame seldom grows
constexpr double kMoved = 0.03;    // [m] from where it was drawn, and
constexpr double kTurned = 0.003;  // [rad]: a moment is drawn anew

bool has_moved(const Pose2& a, const Pose2& b) {
  return distance(a.position(), b.position()) > kMoved || std::abs((a.theta - b.theta).radians()) > kTurned;
}

}  // namespace

GrowingMap::GrowingMap(const ScanMapperParams& params, double body_radius)
    : params_{params}, body_radius_{body_radius} {}

std::vector<PlacedSweep> GrowingMap::placed(std::span<const Pose2> map_from_base) const {
  std::vector<PlacedSweep> result;
  for (std::size_t i = 0; i < std::min(moments_.size(), map_from_base.size()); ++i) {
    for (const MountedSweep& mounted : moments_[i].sweeps)
      result.push_back({mounted.sweep, map_from_base[i] * mounted.base_from_sensor});
  }
  return result;
}

void GrowingMap::draw(Drawing& drawing, const Moment& moment) const {
  for (const MountedSweep& mounted : moment.sweeps)
    drawing.mapper.add({mounted.sweep, moment.map_from_base * mounted.base_from_sensor});
  drawing.mapper.stand(moment.map_from_base.position(), body_radius_);
  drawing.drawn_at.push_back(moment.map_from_base);
}

std::optional<GrowingMap::Drawing> GrowingMap::blank() const {
  std::vector<Pose2> poses;
  for (const Moment& moment : moments_) poses.push_back(moment.map_from_base);
  ScanMapperParams params = params_;
  params.border = kSpare;
  auto frame = ScanMapper::frame_of(placed(poses), params);
  if (!frame) return std::nullopt;
  return Drawing{ScanMapper{*frame, params_}, *frame, {}};
}

bool GrowingMap::is_in(const GridFrame& frame, const Moment& moment) const {
  for (const MountedSweep& mounted : moment.sweeps) {
    const Pose2 map_from_sensor = moment.map_from_base * mounted.base_from_sensor;
    for (const sensor_models::SweepBeam& beam : mounted.sweep.beams) {
      if (beam.no_return || beam.range > params_.reach) continue;
      if (!frame.holds(frame.cell_at(map_from_sensor * sensor_models::endpoint(beam)))) return false;
    }
  }
  return true;
}

void GrowingMap::add(std::vector<MountedSweep> sweeps, const Pose2& map_from_base) {
  moments_.push_back({std::move(sweeps), map_from_base});
  if (!in_use_) {
    in_use_ = blank();
    if (in_use_) draw(*in_use_, moments_.back());
    return;
  }
  draw(*in_use_, moments_.back());
  is_outgrown_ = is_outgrown_ || !is_in(in_use_->frame, moments_.back());
}

void GrowingMap::move(std::span<const Pose2> map_from_base) {
  for (std::size_t i = 0; i < std::min(moments_.size(), map_from_base.size()); ++i)
    moments_[i].map_from_base = map_from_base[i];
}

bool GrowingMap::work(std::size_t most_moments) {
  if (!in_use_) return moments_.empty();
  if (!next_) {
    bool is_old = is_outgrown_;
    for (std::size_t i = 0; i < in_use_->drawn_at.size() && !is_old; ++i)
      is_old = has_moved(in_use_->drawn_at[i], moments_[i].map_from_base);
    if (!is_old) return true;
    next_ = blank();
    is_outgrown_ = false;
  }
  if (!next_) return false;
  for (std::size_t n = 0; n < most_moments && next_->drawn_at.size() < moments_.size(); ++n)
    draw(*next_, moments_[next_->drawn_at.size()]);
  if (next_->drawn_at.size() < moments_.size()) return false;
  in_use_ = std::exchange(next_, std::nullopt);
  return true;
}

OccupancyGrid GrowingMap::map() const { return in_use_ ? in_use_->mapper.map() : OccupancyGrid{}; }

}  // namespace docent::mapping
