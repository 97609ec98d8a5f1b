#include "docent/collision_avoidance/plausibility/ring_check.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {
void RingEchoes::hear(int ring, std::size_t index, const SonarReading& reading, const Pose2& odom_from_base) {
  const auto [place, is_new] = places_.try_emplace({ring, index}, echoes_.size());
  if (is_new) echoes_.emplace_back();
  const bool is_echo = reading.range > 0.0 && reading.range < reading.max_range;
  echoes_[place->second] = {reading.stamp, odom_from_base * reading.base_from_sensor, reading.field_of_view,
                            is_echo ? reading.range : 0.0};
}

std::optional<RingCheck::Vote> RingCheck::vote_of(const RingEcho& echo, const SweepView& view) const {
  if (!(echo.range >= params_.least_range && echo.range <= params_.most_range)) return std::nullopt;
  if (std::abs(to_seconds(view.stamp - echo.stamp)) > params_.together) return std::nullopt;
  const Pose2 laser_from_ring = inverse(view.odom_from_sensor) * echo.odom_from_sensor;
  const Point2 at = laser_from_ring * Point2{echo.range, 0.0};
  const double range = norm(at);
  const long middle = view.sample_to(at);
  const auto samples = static_cast<long>(view.ranges.size());
  const auto narrow = static_cast<long>(std::ceil(0.5 * echo.field_of_view / view.bearing_step));
  const auto wide = static_cast<long>(std::ceil((0.5 * echo.field_of_view + params_.aside) / view.bearing_step));
  // At the rim of the laser's field what answered may lie outside.
  if (middle - narrow < 0 || middle + narrow >= samples) return std::nullopt;
  const double tolerance = params_.noise + params_.per_metre * range;
  Vote vote{view.stamp, std::atan2(at.y, at.x), range, 0.0, false, false};
  for (long i = std::max(0L, middle - wide); i <= std::min(samples - 1, middle + wide); ++i) {
    const auto sample = static_cast<std::size_t>(i);
    if (!view.met(sample)) continue;
    const auto reading = static_cast<double>(view.ranges[sample]);
    vote.agrees = vote.agrees || std::abs(reading - range) <= tolerance;
    const bool is_in_cone = i >= middle - narrow && i <= middle + narrow;
    vote.is_shorter = vote.is_shorter || (is_in_cone && reading < range - tolerance);
    if (is_in_cone && (vote.reading == 0.0 || reading < vote.reading)) vote.reading = reading;
  }
  if (vote.reading == 0.0) return std::nullopt;  // the laser says nothing there
  return vote;
}

std::vector<Point2> RingCheck::unanswered(const SweepView& view, std::span<const RingEcho> echoes) const {
  std::vector<Point2> places;
  const auto samples = static_cast<long>(view.ranges.size());
  for (const RingEcho& echo : echoes) {
    if (echo.range < params_.least_range || std::abs(to_seconds(view.stamp - echo.stamp)) > params_.together) continue;
    const Point2 at = inverse(view.odom_from_sensor) * echo.odom_from_sensor * Point2{echo.range, 0.0};
    const long middle = view.sample_to(at);
    const auto cone = static_cast<long>(std::ceil(0.5 * echo.field_of_view / view.bearing_step));
    if (norm(at) > params_.near || middle - cone < 0 || middle + cone >= samples) continue;
    const auto first = view.ranges.begin() + (middle - cone);
    if (std::all_of(first, first + 2 * cone + 1, [](float range) { return range == kNoAnswer; })) places.push_back(at);
  }
  return places;
}

bool RingCheck::follows(const Vote& vote, const RangeLaw& law) const {
  if (vote.agrees || vote.is_shorter) return false;
  const double tolerance = law.scale * (params_.noise + params_.per_metre * vote.range);
  return std::abs(vote.reading - law.scale * vote.range - law.offset) <= tolerance;
}

double RingCheck::span_of(const RangeLaw& law) const {
  double least = 10.0;
  double most = -10.0;
  for (const Vote& vote : votes_) {
    if (!follows(vote, law)) continue;
    least = std::min(least, vote.bearing);
    most = std::max(most, vote.bearing);
  }
  return most - least;
}

std::optional<RangeLaw> RingCheck::law() const {
  std::vector<double> offsets;
  std::vector<double> scales;
  RangeLaw best;
  for (const Vote& vote : votes_) {
    if (vote.reading == 0.0) continue;
    ++best.compared;
    best.as_expected += vote.agrees ? 1 : 0;
    if (vote.agrees || vote.is_shorter) continue;
    offsets.push_back(vote.reading - vote.range);
    scales.push_back(vote.reading / vote.range);
  }
  if (static_cast<int>(offsets.size()) < params_.least) return std::nullopt;
  RangeLaw by_offset = best;
  by_offset.offset = median(offsets);
  RangeLaw by_scale = best;
  by_scale.scale = median(scales);
  const auto count = [&](RangeLaw& law) {
    law.as_law = static_cast<int>(std::count_if(
        votes_.begin(), votes_.end(), [&](const Vote& vote) { return vote.reading > 0.0 && follows(vote, law); }));
  };
  count(by_offset);
  count(by_scale);
  const auto is_law = [&](const RangeLaw& law) {
    return (law.offset >= params_.least_offset || law.scale >= params_.least_factor) && law.as_law >= params_.least &&
           law.as_law >= params_.share * law.compared && law.as_expected <= params_.most_agree * law.compared &&
           span_of(law) >= params_.least_span;
  };
  // Where all things are about as far, both explain them.
  best = by_offset.as_law >= by_scale.as_law || !is_law(by_scale) ? by_offset : by_scale;
  if (!is_law(best)) return std::nullopt;
  return best;
}

bool RingCheck::contradicts(const RangeLaw& law, Time since) const {
  int compared = 0;
  int agree = 0;
  for (const Vote& vote : votes_) {
    if (vote.reading == 0.0 || vote.stamp < since) continue;
    const double tolerance = params_.noise + params_.per_metre * vote.range;
    if (std::abs(law.scale * vote.range + law.offset - vote.range) < params_.differs * tolerance) continue;
    ++compared;
    agree += vote.agrees ? 1 : 0;
  }
  return agree >= params_.least_agree && agree >= params_.agrees * compared;
}

RingCheck::Agreement RingCheck::agreement_of(const Votes& votes) {
  Agreement agreement;
  for (const Vote& vote : votes) {
    agreement.compared += vote.reading > 0.0 ? 1 : 0;
    agreement.agree += vote.agrees ? 1 : 0;
  }
  return agreement;
}

std::optional<double> RingCheck::agreement() const {
  const Agreement agreement = agreement_of(votes_);
  if (agreement.compared < params_.least_agree) return std::nullopt;
  return static_cast<double>(agreement.agree) / agreement.compared;
}

void RingCheck::collect(const SweepView& view, std::span<const RingEcho> echoes) {
  votes_.resize(echoes.size());
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    if (auto vote = vote_of(echoes[i], view)) votes_[i] = *vote;
    if (votes_[i].reading > 0.0 && view.stamp - votes_[i].stamp > seconds(params_.memory)) votes_[i] = {};
  }
}

RingCheck::Finding RingCheck::add(const SweepView& view, std::span<const RingEcho> echoes) {
  collect(view, echoes);
  Finding finding;
  finding.too_long = law();
  const std::optional<double> share = agreement();
  finding.in_order = share && *share >= params_.agrees;
  return finding;
}

}  // namespace docent::collision_avoidance
