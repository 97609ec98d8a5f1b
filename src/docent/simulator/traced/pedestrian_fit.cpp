#include "docent/simulator/traced/pedestrian_fit.h"

#include <algorithm>
#include <cmath>

namespace docent::simulator {
namespace {

constexpr double kTurn = 10.0;  // [degrees] of the first search
constexpr double kShift = 1.0;  // [m]
constexpr std::size_t kRefined = 24;
constexpr int kRounds = 5;  // each with half the steps of the one before

struct Candidate {
  Pose2 world_from_centre;  ///< of a recording whose middle is the origin
  std::size_t kept = 0;
};

Point2 middle_of(const Recording& recording) {
  Point2 sum{};
  double count = 0.0;
  for (const Track& track : recording.tracks) {
    for (const Point2 point : track.points) sum = sum + point;
    count += static_cast<double>(track.points.size());
  }
  return (1.0 / std::max(count, 1.0)) * sum;
}

bool by_x(Point2 a, Point2 b) { return a.x < b.x; }
bool by_y(Point2 a, Point2 b) { return a.y < b.y; }

/// A rotation and a shift with the cosine and sine at hand.
class Motion {
 public:
  explicit Motion(const Pose2& pose) : shift_{pose.position()}, ahead_{unit(pose.theta)} {}
  Point2 operator()(Point2 p) const {
    return {shift_.x + ahead_.x * p.x - ahead_.y * p.y, shift_.y + ahead_.y * p.x + ahead_.x * p.y};
  }

 private:
  Point2 shift_;
  Point2 ahead_;
};

bool is_walkable(const Track& track, const Motion& motion, const WalkableFloor& floor) {
  // Ends and the middle first: where a track does not fit, they mostly tell.
  for (const std::size_t i : {track.points.size() - 1, track.points.size() / 2, std::size_t{0}}) {
    if (!floor.is_reachable(motion(track.points[i]))) return false;
  }
  for (std::size_t i = 1; i < track.points.size(); ++i) {
    if (!floor.is_clear(motion(track.points[i - 1]), motion(track.points[i]), kRecordedRadius)) return false;
  }
  return true;
}

/// How many tracks are on free floor; gives up, with 0, when they can be no more than `known`.
std::size_t count_kept(const Recording& centred, const Pose2& pose, const WalkableFloor& floor, std::size_t known) {
  const Motion motion{pose};
  std::size_t left = centred.tracks.size();
  std::size_t kept = 0;
  for (const Track& track : centred.tracks) {
    if (kept + left <= known) return 0;
    --left;
    if (is_walkable(track, motion, floor)) ++kept;
  }
  return kept;
}

std::vector<Candidate> search(const Recording& centred, const WalkableFloor& floor) {
  const auto [low, high] = floor.bounds();
  std::vector<Candidate> best;  // by how many they keep, the most first
  for (double turn = 0.0; turn < 360.0; turn += kTurn) {
    for (double y = low.y; y <= high.y; y += kShift) {
      for (double x = low.x; x <= high.x; x += kShift) {
        const std::size_t known = best.size() < kRefined ? 0 : best.back().kept;
        const Pose2 pose{x, y, Angle::degrees(turn)};
        const std::size_t kept = count_kept(centred, pose, floor, known);
        if (kept <= known) continue;
        const auto place = std::find_if(best.begin(), best.end(), [&](const Candidate& c) { return c.kept < kept; });
        best.insert(place, {pose, kept});
        if (best.size() > kRefined) best.pop_back();
      }
    }
  }
  return best;
}

Candidate refined(Candidate candidate, const Recording& centred, const WalkableFloor& floor) {
  double turn = 0.5 * kTurn;
  double shift = 0.5 * kShift;
  for (int round = 0; round < kRounds; ++round, turn *= 0.5, shift *= 0.5) {
    const Pose2 centre = candidate.world_from_centre;
    for (const int a : {-1, 0, 1}) {
      for (const int b : {-1, 0, 1}) {
        for (const int c : {-1, 0, 1}) {
          const Pose2 pose{centre.x + a * shift, centre.y + b * shift, centre.theta + Angle::degrees(c * turn)};
          const std::size_t kept = count_kept(centred, pose, floor, candidate.kept);
          if (kept > candidate.kept) candidate = {pose, kept};
        }
      }
    }
  }
  return candidate;
}

bool is_walked_on(const Polygon& polygon, const Track& track) {
  constexpr int kPieces = 6;  // of a step, each of a hand's breadth
  const auto [low_x, high_x] = std::minmax_element(polygon.begin(), polygon.end(), by_x);
  const auto [low_y, high_y] = std::minmax_element(polygon.begin(), polygon.end(), by_y);
  constexpr double kStride = 1.5;  // [m] of a step at most, and the disc
  for (std::size_t i = 1; i < track.points.size(); ++i) {
    const Point2 from = track.points[i - 1];
    if (from.x < low_x->x - kStride || from.x > high_x->x + kStride) continue;
    if (from.y < low_y->y - kStride || from.y > high_y->y + kStride) continue;
    for (int k = 0; k <= kPieces; ++k) {
      const Point2 point = from + (static_cast<double>(k) / kPieces) * (track.points[i] - from);
      if (distance(polygon, point) < kRecordedRadius) return true;
    }
  }
  return false;
}

}  // namespace

PedestrianFit fit_pedestrians(const Recording& recording, const WalkableFloor& floor) {
  const Point2 middle = middle_of(recording);
  Recording centred = recording;
  for (Track& track : centred.tracks) {
    for (Point2& point : track.points) point = point - middle;
  }
  Candidate best;
  for (const Candidate& candidate : search(centred, floor)) {
    const Candidate better = refined(candidate, centred, floor);
    if (better.kept > best.kept) best = better;
  }
  PedestrianFit fit;
  fit.world_from_recording = best.world_from_centre * Pose2{-middle.x, -middle.y, Angle{}};
  fit.recording.name = recording.name;
  fit.recording.duration = recording.duration;
  const Motion motion{best.world_from_centre};
  for (Track& track : centred.tracks) {
    if (!is_walkable(track, motion, floor)) continue;
    for (Point2& point : track.points) point = motion(point);
    fit.recording.tracks.push_back(std::move(track));
  }
  fit.dropped = recording.tracks.size() - fit.recording.tracks.size();
  return fit;
}

bool is_walked_on(const Polygon& polygon, std::span<const Recording> recordings) {
  return std::any_of(recordings.begin(), recordings.end(), [&](const Recording& recording) {
    return std::any_of(recording.tracks.begin(), recording.tracks.end(),
                       [&](const Track& track) { return is_walked_on(polygon, track); });
  });
}

}  // namespace docent::simulator
