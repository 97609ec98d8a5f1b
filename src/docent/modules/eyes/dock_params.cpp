#include "docent/modules/eyes/dock_params.h"

#include <cmath>

namespace docent::modules {

Result<void> DockParams::validate() const {
  constexpr double kSteepest = 45.0, kMostTag = 586.0, kHighest = 3.0;  // [deg]; of the family; [m]
  if (auto valid = place.validate(); !valid) return valid;
  if (!(std::abs(place.tilt) < kSteepest)) return fail("place.tilt must be -45..45: it looks ahead");
  if (!(tag.id >= 0 && tag.id <= kMostTag)) return fail("tag.id must be 0..586");
  if (!(tag.side > 0.0 && tag.height > 0.0 && tag.height < kHighest))
    return fail("tag.side must be > 0, tag.height above 0 and below 3");
  if (!(contact > 0.0)) return fail("contact must be > 0");
  if (!(std::abs(beside) <= 1.0)) return fail("beside must be -1..1");
  if (!(held_m > 0.0 && held_s > 0.0 && try_s > 0.0)) return fail("held_m, held_s and try_s must be > 0");
  if (auto valid = line().validate(); !valid) return valid;
  return approach().validate();
}

vision::DockLineParams DockParams::line() const {
  vision::DockLineParams params;
  params.tag = tag.id;
  params.side = tag.side;
  params.height = tag.height;
  return params;
}

planning::DockApproachParams DockParams::approach() const {
  planning::DockApproachParams params;
  params.contact = contact;
  return params;
}

Pose2 DockParams::charger_from_tag() const { return {contact, beside, Angle::degrees(180.0)}; }

}  // namespace docent::modules
