#include "docent/localization/localizer/localizer_params.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "docent/base/instruction_set.h"
#include "docent/localization/beam_choice/person_shapes.h"

namespace docent::localization {
Result<void> LocalizerParams::validate() const {
  for (const auto& valid : {states.validate(), sensor.validate(), motion.validate(), verdict.validate(),
                            refiner.validate(), tracks.validate()})
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

double LocalizerParams::views(double way, double turn) const {
  const double updates = std::max(way / update_way, turn / (update_turn * kDegree));
  return std::clamp(0.5 * updates, 1.0, most_views);
}

Neighbourhood LocalizerParams::focus(const Pose2& predicted, const Pose2& before_from_after) const {
  const motion_models::MotionNoise noise = motion_models::motion_noise(motion, before_from_after);
  return {predicted, std::max(focus_radius, focus_deviations * std::sqrt(noise.position_variance)),
          std::max(focus_turn, focus_deviations * std::sqrt(noise.heading_variance))};
}

std::vector<std::uint8_t> LocalizerParams::on_persons(const sensor_models::RangeSweep& sweep,
                                                      bool keeps_its_place) const {
  return keeps_its_place || person_share >= 1.0 ? std::vector<std::uint8_t>{} : on_person_shapes(sweep);
}

double LocalizerParams::sector_nats(std::span<const std::uint8_t> on_persons) const {
  constexpr double kMostlyPeople = 0.2;  // share of the beams that are left
  constexpr double kFewPeople = 0.4;
  if (!exact_walls || on_persons.empty()) return most_sector_nats;
  const auto left = static_cast<double>(std::count(on_persons.begin(), on_persons.end(), std::uint8_t{0}));
  const double share = left / static_cast<double>(on_persons.size());
  const double trust = std::clamp((share - kMostlyPeople) / (kFewPeople - kMostlyPeople), 0.0, 1.0);
  return most_sector_nats + trust * (most_sector_nats_lost - most_sector_nats);
}

BeamChoiceParams LocalizerParams::beam_choice(std::vector<std::uint8_t> on_persons, bool keeps_its_place) const {
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

}  // namespace docent::localization
