#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"

namespace docent::collision_avoidance {

struct RangeLawParams {
  double noise = 0.08;            ///< [m] between a reading and what is expected, near by,
  double per_metre = 0.02;        ///< [m/m] and more with the distance: noise, and bearings between the samples
  double surely_within = 0.85;    ///< of the scanner's reach: what is expected farther may well give no answer
  int least = 24;                 ///< samples; fewer tell nothing
  double least_share = 0.65;      ///< of them must follow a law: the rest are people and places that come into view,
  double most_as_expected = 0.4;  ///< and at most so many be as they were expected
  double least_offset = 0.15;     ///< [m] a smaller one is noise, or a little error of the mount
  double most_offset = 2.0;       ///< [m] a greater one is another place
  double least_factor = 1.2;  ///< likewise, or its inverse: what lies 1 m away is wrong by the least offset and more
};

/// How readings depend on what was expected: reading = scale * expected + offset.
struct RangeLaw {
  int compared = 0;              ///< samples of which something was expected
  int as_expected = 0;           ///< of them
  int as_law = 0;                ///< of them, by the law
  int answered = 0;              ///< samples that met something, and were expected to
  int answered_as_expected = 0;  ///< of them
  double scale = 1.0;
  double offset = 0.0;  ///< [m]

  [[nodiscard]] bool is_as_expected(double share) const { return as_expected >= share * compared; }
  /// nullopt: fewer than `least` were compared.
  [[nodiscard]] std::optional<double> share_as_expected(int least) const {
    return compared >= least ? std::optional{static_cast<double>(as_expected) / compared} : std::nullopt;
  }
};

/// The greater one of the middle two; `values` change their order. @pre not empty. O(values)
[[nodiscard]] double median(std::vector<double>& values);

/// How many samples read `scale` times what was expected and `offset` [m] more.
/// @param expected  [samples of view] [m]; NaN: nothing is known
[[nodiscard]] int count_by_law(std::span<const float> expected, const SweepView& view, double scale, double offset,
                               const RangeLawParams& params = {});
/// How much of a sweep is as another one lets expect.
struct Agreement {
  int compared = 0;    ///< samples of which something is surely expected
  double share = 0.0;  ///< of them, as expected
};
/// @param now_from_then  from the sensor then to the sensor now @param expected  for use inside
/// O(samples).
[[nodiscard]] Agreement agreement_of(const SweepView& seen, const Pose2& now_from_then, const SweepView& now,
                                     std::vector<float>& expected, const RangeLawParams& params = {});
/// The scale alone, or the offset alone, that most samples follow; neither is looked for where so many are as expected
/// that it is no lie. O(samples).
[[nodiscard]] RangeLaw find_law(std::span<const float> expected, const SweepView& view,
                                const RangeLawParams& params = {});
/// True where most samples follow a law that is none of a scanner in order, and few are as they were expected.
[[nodiscard]] bool is_lie(const RangeLaw& law, const RangeLawParams& params = {});
/// "0.5 m too long", "2.0 times too long"
[[nodiscard]] std::string to_words(const RangeLaw& law);

}  // namespace docent::collision_avoidance
