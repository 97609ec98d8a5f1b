#include "docent/localization/beam_choice/beam_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::localization {

Result<BeamFilter> beam_filter_of(const std::string& name) {
  if (name == "none") return BeamFilter::none;
  if (name == "entropy") return BeamFilter::entropy;
  if (name == "distance") return BeamFilter::distance;
  if (name == "novelty") return BeamFilter::novelty;
  return fail("filter must be none, entropy, distance or novelty, not '" + name + "'");
}

bool rejects(BeamFilter filter, const ExpectedRanges& expected, const sensor_models::ProximityModel& model,
             int direction, int measured, double sureness) {
  constexpr double kMayBeShort = 0.5;  // more likely too short than not
  const auto shorter = [&] { return expected.shorter(direction, model.shorter_probabilities(measured)); };
  const auto confuses = [&] { return expected.entropy_gain(direction, model.log_probabilities(measured)) < 0.0; };
  switch (filter) {
    case BeamFilter::none:
      return false;
    case BeamFilter::entropy:
      return confuses();
    case BeamFilter::distance:
      return shorter() > sureness;
    case BeamFilter::novelty:
      return shorter() > kMayBeShort && confuses();
  }
  return false;
}

namespace {

/// Those of the beams that ended on what is shaped like a person, see BeamChoiceParams::on_persons.
std::vector<sensor_models::BinnedBeam> persons_taken_out(std::vector<sensor_models::BinnedBeam>& beams,
                                                         std::span<const std::uint8_t> on_persons) {
  if (on_persons.empty()) return {};
  const auto first = std::stable_partition(beams.begin(), beams.end(),
                                           [&](const sensor_models::BinnedBeam& b) { return on_persons[b.beam] == 0; });
  std::vector<sensor_models::BinnedBeam> persons{first, beams.end()};
  beams.erase(first, beams.end());
  return persons;
}

}  // namespace

BeamChoice chosen_beams(std::span<const LikelyState> likely, const RangeTable& table, int directions,
                        const sensor_models::ProximityModel& model, const sensor_models::RangeSweep& sweep,
                        const BeamChoiceParams& params, std::size_t phase, Rng& rng) {
  constexpr std::size_t kFewest = 10;  // others: with fewer there is still something to recover by
  BeamChoice choice;
  std::vector<sensor_models::BinnedBeam> beams = sensor_models::binned(sweep, directions);
  const auto persons = persons_taken_out(beams, params.on_persons);
  if (likely.empty()) {
    choice.used = beams;
  } else {
    const ExpectedRanges expected{likely, table, directions, asks_entropy(params.filter)};
    std::vector<bool> is_rejected;
    for (const sensor_models::BinnedBeam& beam : beams) {
      const int bin = bin_of(sweep.beams[beam.beam], model);
      choice.readings += agreement(expected, model, beam.direction, bin, params.sureness);
      is_rejected.push_back(rejects(params.filter, expected, model, beam.direction, bin, params.sureness));
      choice.filtered += is_rejected.back() ? 1 : 0;
    }
    const std::size_t others = std::max(beams.size() - choice.filtered, kFewest);
    double share = params.unfiltered_share;
    if (params.keeps_its_place && choice.filtered > others)
      share *= static_cast<double>(others) / static_cast<double>(choice.filtered);
    for (std::size_t i = 0; i < beams.size(); ++i)
      if (!is_rejected[i] || rng.chance(share)) choice.used.push_back(beams[i]);
  }
  const double person_share =
      params.person_share *
      std::min(1.0, static_cast<double>(beams.size()) / static_cast<double>(std::max<std::size_t>(persons.size(), 1)));
  choice.filtered += persons.size();
  for (const sensor_models::BinnedBeam& beam : persons)
    if (rng.chance(person_share)) choice.used.push_back(beam);
  choice.used = sensor_models::thinned(choice.used, params.most, phase);
  std::sort(
      choice.used.begin(), choice.used.end(),
      [](const sensor_models::BinnedBeam& a, const sensor_models::BinnedBeam& b) { return a.direction < b.direction; });
  return choice;
}

}  // namespace docent::localization
