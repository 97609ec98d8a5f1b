#include "docent/planning/survey/surveyor_params.h"

namespace docent::planning {

Result<void> SurveyorParams::validate() const {
  if (!(least_sigma > 0.0 && least_sigma <= most_sigma)) return fail("0 < least_sigma <= most_sigma must hold");
  if (!(stray_floor >= 0.0)) return fail("stray_floor must be >= 0");
  if (!(sigma_heading > 0.0)) return fail("sigma_heading must be > 0");
  if (auto valid = keyframes.validate(); !valid) return fail("keyframes." + valid.error().message);
  if (auto valid = explorer.validate(); !valid) return fail("explorer." + valid.error().message);
  if (auto valid = drive.validate(); !valid) return fail("drive." + valid.error().message);
  if (auto valid = alignment.validate(); !valid) return fail("alignment." + valid.error().message);
  if (auto valid = mapping.validate(); !valid) return fail("mapping." + valid.error().message);
  if (auto valid = map.validate(); !valid) return fail("map." + valid.error().message);
  return {};
}

}  // namespace docent::planning
