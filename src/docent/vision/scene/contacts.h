#pragma once

#include <optional>
#include <vector>

#include "docent/geometry/polygon.h"
#include "docent/vision/scene/floor_mask.h"

namespace docent::vision {

struct ContactParams {
  double pixels = 4.0;  ///< [pixels] > 0 standard deviation of where the floor ends in the picture
  double tilt = 0.3;    ///< [deg] >= 0 of the camera's tilt
  double doubt = -1.0;  ///< log-odds of floor that a site above its end must be below: in shade the floor ends in doubt
  int beyond = 4;       ///< [sites] >= 1 above the end that are asked for that
  int gap = 2;          ///< [sites] >= 1: so much that is no floor ends it
  double apart = 0.25;  ///< [m] > 0: neighbours that are farther apart are not of one line
  double bend = 0.06;   ///< [m] > 0 that a place may lie off its line
  int least = 8;        ///< [sites] >= 2 of a line across the picture: shorter ones are as often noise
  [[nodiscard]] Result<void> validate() const;
};

/// Where the floor ends at something that stands on it, in one column of a picture.
struct Contact {
  int column = 0, row = 0;      ///< [sites] the last one of floor
  Point2 place;                 ///< [m] base
  double distance = 0.0;        ///< [m] on the floor from below the camera
  double distance_sigma = 0.0;  ///< [m] standard deviation: (d² + h²) / h times that of the angle
  double across_sigma = 0.0;    ///< [m] of the place, across the ray
};

/// Where the ray through a place of the picture meets the floor. nullopt: not below the horizon.
[[nodiscard]] std::optional<Point2> floor_at(const DepthCamera& camera, double column, double row);

/// For each column the end of the nearest floor: the ray through it meets the floor's plane there. Columns in which the
/// floor goes on to the picture's top, or to where none is looked for, or ends in doubt, have none. O(sites)
/// @param reach  [m] along the axis, of the mask
[[nodiscard]] std::vector<Contact> contacts_of(const FloorMask& mask, const DepthCamera& camera, double reach,
                                               const ContactParams& params = {});

/// Contacts that stand in one line on the floor.
struct ContactLine {
  Segment line;               ///< [m] base, from the left of the picture to the right
  double across_sigma = 0.0;  ///< [m] standard deviation of its middle across it; what all share is not averaged
  double angle_sigma = 0.0;   ///< [rad] of its direction
  int first = 0, last = 0;    ///< contacts of it, both included
};

/// Lines through neighbouring contacts, cut where they bend, each the best by least squares. O(contacts²)
[[nodiscard]] std::vector<ContactLine> lines_through(const std::vector<Contact>& contacts,
                                                     const ContactParams& params = {});

}  // namespace docent::vision
