#include "docent/simulator/pedestrians/track.h"

#include <algorithm>

namespace docent::simulator {

Point2 Track::at(double time) const {
  const double steps = (time - start) / kTrackStep;
  if (!(steps > 0.0)) return points.front();
  const auto before = static_cast<std::size_t>(std::min(steps, 1e9));
  if (before + 1 >= points.size()) return points.back();
  const double share = steps - static_cast<double>(before);
  return (1.0 - share) * points[before] + share * points[before + 1];
}

double Recording::mean_people() const {
  double seconds = 0.0;
  for (const Track& track : tracks) seconds += track.end() - track.start;
  return duration > 0.0 ? seconds / duration : 0.0;
}

double mean_people(std::span<const Recording> recordings) {
  double sum = 0.0;
  for (const Recording& recording : recordings) sum += recording.mean_people();
  return sum;
}

}  // namespace docent::simulator
