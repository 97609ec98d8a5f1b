#include "docent/messages/scanners/own_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "docent/geometry/convex.h"

namespace docent {
namespace {

constexpr std::size_t kSweepsLearned = 10;  // it learns from
constexpr std::size_t kDirections = 720;    // of a turn
constexpr double kMetShare = 0.8;           // of the beams of a direction, that end on the body
constexpr double kBodyNoise = 0.03;         // [m] by which a reading of the body may lie outside of it, but
constexpr double kRim = 0.01;               // [m] what is learned lies inside: the robot may begin beside a wall
constexpr double kBodySpread = 0.10;        // [m] of the readings of one beam: what moves is not the body
constexpr double kSamePart = 0.08;          // [m] from a part of the body: the same part
constexpr double kApart = 0.02;             // [m] nearer parts are one
constexpr double kMostShare = 0.25;         // of the beams
constexpr std::size_t kForgotten = 100;     // sweeps on end that do not meet a part
constexpr double kAlone = 0.1;              // [m], and
constexpr double kAloneShare = 0.05;        // of the range: nearer than what is seen beside

}  // namespace

void take_out_grazing(std::span<float> ranges, const std::vector<bool>& grazes) {
  const std::size_t beams = ranges.size();
  // The first clear reading from a beam on, to one side; infinity: there is none.
  const auto beside = [&](std::size_t beam, std::size_t step) {
    for (std::size_t k = 1; k < beams; ++k) {
      const std::size_t at = (beam + k * step) % beams;
      if (!grazes[at] && ranges[at] > 0.0F) return ranges[at];
    }
    return std::numeric_limits<float>::infinity();
  };
  for (std::size_t beam = 0; beam < beams; ++beam) {
    if (!grazes[beam] || std::isnan(ranges[beam])) continue;
    const float nearest = std::min(beside(beam, 1), beside(beam, beams - 1));
    const auto range = static_cast<double>(ranges[beam]);
    if (range < static_cast<double>(nearest) - kAlone - kAloneShare * range)
      ranges[beam] = std::numeric_limits<float>::quiet_NaN();
  }
}

bool OwnBody::is_inside(double range, Angle bearing, double more) const {
  const Point2 in_base = base_from_sensor_ * (range * unit(bearing));
  return norm(in_base) < radius_ + more && (outline_.empty() || holds_inside(outline_, in_base));
}

void OwnBody::take_out(std::span<float> ranges, double first_bearing, double bearing_step, double min_range) {
  taken_out_.clear();
  if (!(radius_ > 0.0)) return;
  if (sweeps_ < kSweepsLearned) return learn(ranges, first_bearing, bearing_step, min_range);
  if (parts_.empty()) return;
  for (Part& part : parts_) ++part.missed;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double range = static_cast<double>(ranges[i]);
    const Angle bearing = Angle::radians(first_bearing + static_cast<double>(i) * bearing_step);
    if (!(range >= min_range) || !is_inside(range, bearing, kBodyNoise)) continue;
    const Point2 end = range * unit(bearing);
    for (Part& part : parts_) {
      if (distance(part.in_sensor, end) > kSamePart) continue;
      part.missed = 0;
      ranges[i] = std::numeric_limits<float>::quiet_NaN();
      taken_out_.resize(ranges.size());
      taken_out_[i] = true;
    }
  }
  std::erase_if(parts_, [](const Part& part) { return part.missed > kForgotten; });
}

void OwnBody::learn(std::span<const float> ranges, double first_bearing, double bearing_step, double min_range) {
  // By direction and not by number: spinners have some beams more or less in each sweep.
  if (directions_.empty()) directions_.resize(kDirections);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const float range = ranges[i];
    const Angle bearing = Angle::radians(first_bearing + static_cast<double>(i) * bearing_step);
    Part& part = directions_[static_cast<std::size_t>((bearing.degrees() + 180.0) / 360.0 * kDirections) % kDirections];
    ++part.beams;
    if (!(static_cast<double>(range) >= min_range) || !is_inside(static_cast<double>(range), bearing, -kRim)) continue;
    part.least = part.met == 0 ? range : std::min(part.least, range);
    part.most = std::max(part.most, range);
    part.in_sensor = part.in_sensor + static_cast<double>(range) * unit(bearing);
    ++part.met;
  }
  if (++sweeps_ == kSweepsLearned) conclude();
}

void OwnBody::conclude() {
  std::size_t seen = 0, on_body = 0;
  for (Part part : directions_) {
    seen += part.beams > 0 ? 1 : 0;
    if (part.met == 0 || static_cast<double>(part.met) < kMetShare * static_cast<double>(part.beams)) continue;
    if (static_cast<double>(part.most - part.least) > kBodySpread) continue;
    ++on_body;
    part.in_sensor = (1.0 / static_cast<double>(part.met)) * part.in_sensor;
    if (parts_.empty() || distance(parts_.back().in_sensor, part.in_sensor) > kApart) parts_.push_back(part);
  }
  is_too_much_ = static_cast<double>(on_body) > kMostShare * static_cast<double>(seen);
  if (is_too_much_) parts_.clear();
  directions_.clear();
  directions_.shrink_to_fit();
}

std::string OwnBody::where() const {
  constexpr double kTogether = 8.0;  // [deg] nearer ones are told as one
  std::vector<double> bearings;
  for (const Part& part : parts_) {
    const Point2 in_base = base_from_sensor_ * part.in_sensor;
    bearings.push_back((direction({}, in_base)).degrees());
  }
  std::sort(bearings.begin(), bearings.end());
  std::string text;
  for (std::size_t begin = 0; begin < bearings.size();) {
    std::size_t end = begin + 1;
    while (end < bearings.size() && bearings[end] - bearings[end - 1] < kTogether) ++end;
    text += (text.empty() ? "" : ", ") + std::to_string(std::lround(bearings[begin])) + ".." +
            std::to_string(std::lround(bearings[end - 1]));
    begin = end;
  }
  return text;
}

}  // namespace docent
