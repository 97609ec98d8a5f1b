#include "docent/messages/scanners/own_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "docent/geometry/convex.h"

namespace docent {
namespace {

constexpr std::size_t kSweepsLearned = 10;  // it learns from
constexpr std::size_t kFewestMet = 8;       // of them, in which a beam ends on the body
constexpr double kBodyNoise = 0.03;         // [m] by which a reading of the body may lie outside of it, but
constexpr double kRim = 0.01;               // [m] what is learned lies inside: the robot may begin beside a wall
constexpr double kBodySpread = 0.10;        // [m] of the readings of one beam: what moves is not the body
constexpr double kSamePart = 0.08;          // [m] from a part of the body: the same part
constexpr double kMostShare = 0.25;         // of the beams
constexpr std::size_t kForgotten = 100;     // sweeps on end that do not meet a part

}  // namespace

bool OwnBody::is_inside(double range, Angle bearing, double more) const {
  const Point2 in_base = base_from_sensor_ * (range * unit(bearing));
  return norm(in_base) < radius_ + more && (outline_.empty() || holds_inside(outline_, in_base));
}

void OwnBody::take_out(std::span<float> ranges, double first_bearing, double bearing_step, double min_range) {
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
    }
  }
  std::erase_if(parts_, [](const Part& part) { return part.missed > kForgotten; });
}

void OwnBody::learn(std::span<const float> ranges, double first_bearing, double bearing_step, double min_range) {
  if (beams_.size() != ranges.size()) {
    beams_.assign(ranges.size(), {});
    sweeps_ = 0;
  }
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const float range = ranges[i];
    const Angle bearing = Angle::radians(first_bearing + static_cast<double>(i) * bearing_step);
    if (!(static_cast<double>(range) >= min_range) || !is_inside(static_cast<double>(range), bearing, -kRim)) continue;
    Part& beam = beams_[i];
    beam.least = beam.met == 0 ? range : std::min(beam.least, range);
    beam.most = std::max(beam.most, range);
    beam.sum += static_cast<double>(range);
    ++beam.met;
  }
  if (++sweeps_ == kSweepsLearned) conclude(first_bearing, bearing_step);
}

void OwnBody::conclude(double first_bearing, double bearing_step) {
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    Part part = beams_[i];
    if (part.met < kFewestMet || static_cast<double>(part.most - part.least) > kBodySpread) continue;
    const Angle bearing = Angle::radians(first_bearing + static_cast<double>(i) * bearing_step);
    part.in_sensor = (part.sum / static_cast<double>(part.met)) * unit(bearing);
    parts_.push_back(part);
  }
  is_too_much_ = static_cast<double>(parts_.size()) > kMostShare * static_cast<double>(beams_.size());
  if (is_too_much_) parts_.clear();
  beams_.clear();
  beams_.shrink_to_fit();
}

std::string OwnBody::where() const {
  constexpr double kApart = 8.0;  // [deg] nearer ones are told as one
  std::vector<double> bearings;
  for (const Part& part : parts_) {
    const Point2 in_base = base_from_sensor_ * part.in_sensor;
    bearings.push_back((direction({}, in_base)).degrees());
  }
  std::sort(bearings.begin(), bearings.end());
  std::string text;
  for (std::size_t begin = 0; begin < bearings.size();) {
    std::size_t end = begin + 1;
    while (end < bearings.size() && bearings[end] - bearings[end - 1] < kApart) ++end;
    text += (text.empty() ? "" : ", ") + std::to_string(std::lround(bearings[begin])) + ".." +
            std::to_string(std::lround(bearings[end - 1]));
    begin = end;
  }
  return text;
}

}  // namespace docent
