#include "docent/planning/navigator/navigator_params.h"

namespace docent::planning {

Result<void> NavigatorParams::validate() const {
  if (!(goal_tolerance >= 0.0)) return fail("goal_tolerance must be >= 0");
  if (auto valid = route.validate(); !valid) return valid;
  if (auto valid = tell_apart.validate(); !valid) return valid;
  if (auto valid = coastal.validate(); !valid) return fail("coastal." + valid.error().message);
  return pursuit.validate();
}

}  // namespace docent::planning
