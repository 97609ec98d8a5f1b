#pragma once

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/interaction/head/head_control.h"

namespace docent::interaction {

/// How far brows and mouth of a face of servos go. A face with less writes less.
struct FaceParams {
  double angry_brow = 0.5;     ///< [rad] >= 0, by which the inner ends of the brows fall when angry
  double sad_brow = 0.4;       ///< [rad] >= 0, by which they rise when sad
  double mouth_bend = 0.5;     ///< [rad] >= 0, by which the corners of the mouth rise when happy, and fall when angry
  double mouth_opening = 0.3;  ///< [rad] >= 0, by which the mouth opens while it speaks
  double openings_a_second = 2.0;  ///< [1/s] > 0, <= 4: of ten commands a second more would look like a tremble
  template <class V>
  void visit(V& v) {
    v("angry_brow", angry_brow);
    v("sad_brow", sad_brow);
    v("mouth_bend", mouth_bend);
    v("mouth_opening", mouth_opening);
    v("openings_a_second", openings_a_second);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Where the joints of a face shall be [rad], at rest 0.
struct FaceJoints {
  double left_brow = 0.0;   ///< its inner end falls
  double right_brow = 0.0;  ///< likewise
  double mouth = 0.0;       ///< its corners rise
  double jaw = 0.0;         ///< it opens
};

/// What is shown, as joints. The mouth opens and shuts while the robot speaks, by the clock.
[[nodiscard]] FaceJoints face_joints(const HeadShown& shown, Time now, const FaceParams& params);

}  // namespace docent::interaction
