#include "docent/collision_avoidance/expected_sweeps/range_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

namespace docent::collision_avoidance {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

}  // namespace

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

int count_by_law(std::span<const float> expected, const SweepView& view, double scale, double offset,
                 const RangeLawParams& params) {
  int count = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double should = scale * static_cast<double>(expected[i]) + offset;
    if (std::isnan(should) || std::isnan(view.ranges[i])) continue;
    const double tolerance = params.noise + params.per_metre * should;
    const bool may_be_beyond = should > params.surely_within * view.max_range;
    if (view.met(i) || view.nearest[i] < kNoAnswer) {
      const bool is_between =
          should >= static_cast<double>(view.nearest[i]) - tolerance &&
          (view.met(i) ? should <= static_cast<double>(view.farthest[i]) + tolerance
                       : may_be_beyond || should <= static_cast<double>(view.nearest[i]) + tolerance);
      if (is_between) ++count;
    } else if (may_be_beyond) {
      ++count;
    }
  }
  return count;
}

Agreement agreement_of(const SweepView& seen, const Pose2& now_from_then, const SweepView& now,
                       std::vector<float>& expected, const RangeLawParams& params) {
  expect(seen, now_from_then, now, expected);
  Agreement agreement;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] > params.surely_within * now.max_range) expected[i] = kNothing;
    if (!std::isnan(expected[i]) && !std::isnan(now.ranges[i])) ++agreement.compared;
  }
  if (agreement.compared > 0)
    agreement.share = static_cast<double>(count_by_law(expected, now, 1.0, 0.0, params)) / agreement.compared;
  return agreement;
}

RangeLaw find_law(std::span<const float> expected, const SweepView& view, const RangeLawParams& params) {
  RangeLaw law;
  std::vector<float> sure{expected.begin(), expected.end()};
  for (float& range : sure)
    if (static_cast<double>(range) > params.surely_within * view.max_range) range = kNothing;
  const auto is_answer = [&](std::size_t i) { return view.met(i) && sure[i] > 0.0F; };  // false for NaN
  for (std::size_t i = 0; i < sure.size(); ++i) {
    if (std::isnan(sure[i]) || std::isnan(view.ranges[i])) continue;
    ++law.compared;
    if (!is_answer(i)) continue;
    ++law.answered;
    const auto should = static_cast<double>(sure[i]);
    const double tolerance = params.noise + params.per_metre * should;
    const bool is_between = should >= static_cast<double>(view.nearest[i]) - tolerance &&
                            should <= static_cast<double>(view.farthest[i]) + tolerance;
    law.answered_as_expected += is_between ? 1 : 0;
  }
  law.as_expected = law.as_law = count_by_law(sure, view, 1.0, 0.0, params);
  const bool is_too_well_explained = law.as_expected > params.most_as_expected * law.compared;
  if (is_too_well_explained || law.answered < params.least / 2) return law;
  std::vector<double> offsets;
  std::vector<double> scales;
  for (std::size_t i = 0; i < sure.size(); ++i) {
    if (!is_answer(i)) continue;
    offsets.push_back(static_cast<double>(view.ranges[i]) - static_cast<double>(sure[i]));
    scales.push_back(static_cast<double>(view.ranges[i]) / static_cast<double>(sure[i]));
  }
  const double offset = median(offsets);
  const double scale = median(scales);
  if (const int count = count_by_law(sure, view, 1.0, offset, params); count > law.as_law) {
    law.as_law = count;
    law.offset = offset;
  }
  if (const int count = count_by_law(sure, view, scale, 0.0, params); count > law.as_law) {
    law.as_law = count;
    law.offset = 0.0;
    law.scale = scale;
  }
  return law;
}

bool is_lie(const RangeLaw& law, const RangeLawParams& params) {
  const bool is_off = std::abs(law.offset) >= params.least_offset || law.scale >= params.least_factor ||
                      law.scale <= 1.0 / params.least_factor;
  return is_off && std::abs(law.offset) <= params.most_offset && law.compared >= params.least &&
         law.as_law >= params.least_share * law.compared && law.as_expected <= params.most_as_expected * law.compared;
}

std::string to_words(const RangeLaw& law) {
  std::array<char, 64> text{};
  if (law.scale != 1.0) {
    const bool is_long = law.scale > 1.0;
    std::snprintf(text.data(), text.size(), "%.1f times too %s", is_long ? law.scale : 1.0 / law.scale,
                  is_long ? "long" : "short");
  } else {
    std::snprintf(text.data(), text.size(), "%.1f m too %s", std::abs(law.offset), law.offset > 0.0 ? "long" : "short");
  }
  return text.data();
}

}  // namespace docent::collision_avoidance
