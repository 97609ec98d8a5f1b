#pragma once

#include <span>

#include "docent/geometry/polygon.h"
#include "docent/simulator/crowd/walkable_floor.h"
#include "docent/simulator/pedestrians/track.h"

namespace docent::simulator {

/// Where in a building a recording may have been made.
struct PedestrianFit {
  Pose2 world_from_recording;
  Recording recording;      ///< in the world's frame: the tracks that lie on free floor all the way
  std::size_t dropped = 0;  ///< tracks that would walk through walls
};

/// The rigid motion (a turn and a shift, no scaling) of the recording with the most tracks on floor that is reachable
/// and clear for a disc of kRecordedRadius, and its tracks moved by it. Found over turns of 10 degrees and shifts of a
/// metre, then by ever smaller ones round the best of these; deterministic.
/// No track that fits: an empty recording. O(motions * tracks), as most motions are given up after the first points of
/// some tracks.
[[nodiscard]] PedestrianFit fit_pedestrians(const Recording& recording, const WalkableFloor& floor);

/// True when one of them comes so near to the polygon that their discs touch it. O(points near it).
[[nodiscard]] bool is_walked_on(const Polygon& polygon, std::span<const Recording> recordings);

}  // namespace docent::simulator
