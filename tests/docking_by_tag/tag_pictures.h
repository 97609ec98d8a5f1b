#pragma once

#include <Eigen/Core>
#include <vector>

#include "docent/base/random.h"
#include "docent/vision/marks/dock_line.h"

namespace docent::docking_by_tag {

/// A camera as it truly is: other than the robot believes.
struct TrueCamera {
  double focal = 600.0, centre_x = 320.0, centre_y = 240.0;
  double radial = 0.0, radial4 = 0.0;        ///< of r² and r⁴, on the way to the picture
  double pan = 0.0, down = 0.0, roll = 0.0;  ///< [rad]
  double x = 0.2, y = 0.0, z = 0.45;         ///< [m] base
  double blur = 0.8;                         ///< [pixels] standard deviation
  double noise = 4.0;                        ///< [grey levels]
};

/// Pictures of tag `id` on its white paper, on a grey wall: each pixel the mean of rays cast at the tag's plane, with
/// blur over the way that the camera goes while it is exposed. The estimator shares none of this.
class TagPictures {
 public:
  TagPictures(int id, double side, double height);

  /// @param tag_from_base  the tag's middle on the floor, x out of it
  /// @param turn  [rad] by which the base turns while exposed
  [[nodiscard]] vision::GreyPicture picture(const TrueCamera& camera, const Pose2& tag_from_base, double turn,
                                            Rng& rng) const;

 private:
  [[nodiscard]] double shade_at(double right, double up) const;
  double side_, height_;
  int cells_ = 0;                    ///< of a side of the picture of the tag, paper included
  int border_cells_ = 0;             ///< of a side of the black square
  std::vector<unsigned char> code_;  ///< [cells * cells] from the top left
};

}  // namespace docent::docking_by_tag
