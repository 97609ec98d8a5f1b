#include "docent/localization/markov/beam_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent {

std::vector<LikelyState> likely_states(const PositionBelief& belief, double fraction, std::size_t limit) {
  std::vector<LikelyState> states;
  const auto least = static_cast<float>(fraction * static_cast<double>(belief.peak()));
  double total = 0.0;
  for (std::size_t i = 0; i < belief.kept_places().size(); ++i) {
    if (belief.row_peak(i) < least) continue;
    const auto row = belief.row(i);
    for (std::size_t h = 0; h < row.size(); ++h) {
      if (row[h] < least) continue;
      if (states.size() == limit) return {};
      states.push_back({belief.kept_places()[i], static_cast<std::int32_t>(h), row[h]});
      total += static_cast<double>(row[h]);
    }
  }
  for (LikelyState& state : states) state.mass = static_cast<float>(static_cast<double>(state.mass) / total);
  return states;
}

ExpectedRanges::ExpectedRanges(std::span<const LikelyState> states, const RangeTable& table, int directions,
                               bool for_entropy) {
  const auto count = static_cast<std::size_t>(directions);
  mass_.assign(count * kExpectedRanges, 0.0F);
  if (for_entropy) log_mass_.assign(count * kExpectedRanges, 0.0F);
  for (const LikelyState& state : states) {
    const RangeTable::Row row = table.row(static_cast<std::size_t>(state.place));
    const auto heading = static_cast<std::size_t>(state.heading);
    if (!for_entropy) {
      for (std::size_t d = 0; d < count; ++d) mass_[d * kExpectedRanges + row[heading + d]] += state.mass;
      continue;
    }
    const float log_part = state.mass * std::log(state.mass);
    entropy_ -= static_cast<double>(log_part);
    for (std::size_t d = 0; d < count; ++d) {
      const std::size_t i = d * kExpectedRanges + row[heading + d];
      mass_[i] += state.mass;
      log_mass_[i] += log_part;
    }
  }
}

double ExpectedRanges::shorter(int direction, std::span<const float> shorter_probabilities) const {
  const auto mass = of(mass_, direction);
  double sum = 0.0;
  for (std::size_t o = 0; o < kExpectedRanges; ++o) sum += static_cast<double>(mass[o] * shorter_probabilities[o]);
  return sum;
}

double ExpectedRanges::entropy_gain(int direction, std::span<const float> log_probabilities) const {
  // With r(o) = P(d | o) and Z = sum r p: H(L | s) = ln Z - 1/Z sum r p (ln r + ln p), and p enters only through its
  // sums over states that expect the same range.
  const auto mass = of(mass_, direction);
  const auto log_mass = of(log_mass_, direction);
  double z = 0.0;
  double sum = 0.0;
  for (std::size_t o = 0; o < kExpectedRanges; ++o) {
    if (mass[o] <= 0.0F) continue;
    const double log_r = static_cast<double>(log_probabilities[o]);
    const double r = std::exp(log_r);
    z += r * static_cast<double>(mass[o]);
    sum += r * (static_cast<double>(log_mass[o]) + log_r * static_cast<double>(mass[o]));
  }
  return entropy_ - (std::log(z) - sum / z);
}

Result<BeamFilter> beam_filter_of(const std::string& name) {
  if (name == "none") return BeamFilter::none;
  if (name == "entropy") return BeamFilter::entropy;
  if (name == "distance") return BeamFilter::distance;
  if (name == "novelty") return BeamFilter::novelty;
  return fail("filter must be none, entropy, distance or novelty, not '" + name + "'");
}

bool rejects(BeamFilter filter, const ExpectedRanges& expected, const ProximityModel& model, int direction,
             int measured, double sureness) {
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

std::vector<float> entropy_gains(const ExpectedRanges& expected, const ProximityModel& model, const RangeSweep& seen,
                                 int headings) {
  std::vector<float> gains(seen.beams.size(), 0.0F);
  const double step = 2.0 * std::numbers::pi / headings;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const SweepBeam& beam = seen.beams[i];
    if (beam.no_return) continue;
    const int direction = (static_cast<int>(std::lround(beam.bearing / step)) + headings) % headings;
    // ExpectedRanges counts as [Markov1998] does, before minus after.
    gains[i] = static_cast<float>(-expected.entropy_gain(direction, model.log_probabilities(model.bin(beam.range))));
  }
  return gains;
}

Agreement agreement(const ExpectedRanges& expected, const ProximityModel& model, int direction, int measured,
                    double sureness) {
  Agreement result;
  if (measured == kNoReturn) return result;
  const auto masses = expected.masses(direction);
  const auto shorter = model.shorter_probabilities(measured);
  // P_m of this range and all behind it is P_short of the range before.
  const auto not_longer = model.shorter_probabilities(std::max(measured - 1, 0));
  for (std::size_t o = 0; o < kUnknownRange; ++o) {
    const double mass = static_cast<double>(masses[o]);
    if (static_cast<double>(shorter[o]) > sureness) {
      result.shorter += mass;
    } else if (measured > 0 && static_cast<double>(not_longer[o]) < 1.0 - sureness) {
      result.longer += mass;
    } else {
      result.agrees += mass;
    }
  }
  return result;
}

namespace {

/// Those of the beams that ended on what is shaped like a person, see BeamChoiceParams::on_persons.
std::vector<BinnedBeam> persons_taken_out(std::vector<BinnedBeam>& beams, std::span<const std::uint8_t> on_persons) {
  if (on_persons.empty()) return {};
  const auto first =
      std::stable_partition(beams.begin(), beams.end(), [&](const BinnedBeam& b) { return on_persons[b.beam] == 0; });
  std::vector<BinnedBeam> persons{first, beams.end()};
  beams.erase(first, beams.end());
  return persons;
}

}  // namespace

BeamChoice chosen_beams(std::span<const LikelyState> likely, const RangeTable& table, int directions,
                        const ProximityModel& model, const RangeSweep& sweep, const BeamChoiceParams& params,
                        std::size_t phase, Rng& rng) {
  constexpr std::size_t kFewest = 10;  // others: with fewer there is still something to recover by
  BeamChoice choice;
  std::vector<BinnedBeam> beams = binned(sweep, directions);
  const auto persons = persons_taken_out(beams, params.on_persons);
  if (likely.empty()) {
    choice.used = beams;
  } else {
    const ExpectedRanges expected{likely, table, directions, asks_entropy(params.filter)};
    std::vector<bool> is_rejected;
    for (const BinnedBeam& beam : beams) {
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
  for (const BinnedBeam& beam : persons)
    if (rng.chance(person_share)) choice.used.push_back(beam);
  choice.used = thinned(choice.used, params.most, phase);
  std::sort(choice.used.begin(), choice.used.end(),
            [](const BinnedBeam& a, const BinnedBeam& b) { return a.direction < b.direction; });
  return choice;
}

Agreement agreement_of_all(const ExpectedRanges& expected, const ProximityModel& model, const RangeSweep& sweep,
                           double sureness, int directions) {
  Agreement sum;
  for (const BinnedBeam& beam : binned(sweep, directions)) {
    sum += agreement(expected, model, beam.direction, bin_of(sweep.beams[beam.beam], model), sureness);
  }
  return sum;
}

}  // namespace docent
