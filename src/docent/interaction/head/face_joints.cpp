#include "docent/interaction/head/face_joints.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::interaction {

Result<void> FaceParams::validate() const {
  constexpr double kMost = std::numbers::pi / 2.0;
  for (const double reach : {angry_brow, sad_brow, mouth_bend, mouth_opening})
    if (!(reach >= 0.0 && reach <= kMost)) return fail("face: a joint must go 0..1.57 rad");
  if (!(openings_a_second > 0.0 && openings_a_second <= 4.0))
    return fail("face.openings_a_second must be > 0 and <= 4");
  return {};
}

FaceJoints face_joints(const HeadShown& shown, Time now, const FaceParams& params) {
  FaceJoints joints;
  const bool is_sad = shown.mood == Mood::sad;
  // A sad face is no half angry one: its brows rise, though its valence lies on the way there.
  const double brow = is_sad ? -params.sad_brow : params.angry_brow * std::max(0.0, -shown.valence);
  joints.left_brow = brow;
  joints.right_brow = brow;
  joints.mouth = params.mouth_bend * shown.valence;
  if (shown.is_speaking) {
    const double seconds_in_turn = std::fmod(to_seconds(now - Time{}), 1.0 / params.openings_a_second);
    joints.jaw = params.mouth_opening * std::sin(std::numbers::pi * params.openings_a_second * seconds_in_turn);
  }
  return joints;
}

}  // namespace docent::interaction
