#include "docent/task_control/golex/executive_params.h"

namespace docent::task_control {
namespace {

bool is_positive(double value) { return value > 0.0; }

}  // namespace

Result<void> ExecutiveParams::validate() const {
  if (auto valid = ladder.validate(); !valid) return fail("executive." + valid.error().message);
  if (auto valid = approach.validate(); !valid) return fail("executive." + valid.error().message);
  if (auto valid = docking.validate(); !valid) return fail("executive." + valid.error().message);
  if (!is_positive(max_drive_s)) return fail("executive.max_drive_s must be > 0");
  if (!is_positive(charger_tolerance)) return fail("executive.charger_tolerance must be > 0");
  if (!(no_drive_s >= 0.0)) return fail("executive.no_drive_s must be >= 0");
  if (!is_positive(offer_s)) return fail("executive.offer_s must be > 0");
  if (!is_positive(resend_s)) return fail("executive.resend_s must be > 0");
  if (!is_positive(checkpoint_age_s)) return fail("executive.checkpoint_age_s must be > 0");
  return {};
}

}  // namespace docent::task_control
