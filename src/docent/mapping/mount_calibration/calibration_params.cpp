#include "docent/mapping/mount_calibration/calibration_params.h"

namespace docent::mapping {

Result<void> ScanFollowerParams::validate() const {
  if (!(step > 0.0 && first_way >= step && way >= first_way)) return fail("0 < step <= first_way <= way must hold");
  if (!(step_turn > 0.0 && turn >= step_turn)) return fail("0 < step_turn <= turn must hold");
  if (!(least_way > 0.0 && least_turn > 0.0)) return fail("least_way and least_turn must be > 0");
  if (!(longest > 0.0)) return fail("longest must be > 0 s");
  if (!(least_overlap >= 0.0 && least_overlap <= 1.0)) return fail("least_overlap must be in 0..1");
  if (!(most_residual > 0.0)) return fail("most_residual must be > 0 m");
  if (!(most_disagreement > 0.0)) return fail("most_disagreement must be > 0 degrees");
  if (most_points < 20) return fail("most_points must be >= 20");
  if (auto valid = points.validate(); !valid) return valid;
  return lines.validate();
}

Result<void> MountFitParams::validate() const {
  for (const double sigma : {way_noise, aside_noise, turn_noise, least_noise, least_turn_noise, heading_prior,
                             position_prior, delay_prior, way_prior, turn_prior, veer_prior, outlier})
    if (!(sigma > 0.0)) return fail("every noise, prior and outlier of a fit must be > 0");
  if (!(caution >= 1.0)) return fail("caution must be >= 1");
  if (piece < 1) return fail("piece must be > 0");
  if (pieces < 4) return fail("pieces must be >= 4");
  if (few_pairs < 0) return fail("few_pairs must be >= 0");
  if (iterations < 1) return fail("iterations must be > 0");
  return {};
}

Result<void> MountCalibratorParams::validate() const {
  if (auto valid = follower.validate(); !valid) return valid;
  if (auto valid = fit.validate(); !valid) return valid;
  if (pairs <= 10) return fail("pairs must be > 10");
  if (fewest_pairs < 1) return fail("fewest_pairs must be > 0");
  if (!(named_heading > 0.0)) return fail("named_heading must be > 0 degrees");
  if (!(named_position > 0.0)) return fail("named_position must be > 0 m");
  if (!(named_delay > 0.0)) return fail("named_delay must be > 0 s");
  if (!(named_scale > 0.0)) return fail("named_scale must be > 0");
  if (!(sigmas > 0.0)) return fail("sigmas must be > 0");
  if (!(known_heading > 0.0)) return fail("known_heading must be > 0 degrees");
  if (!(known_position > 0.0)) return fail("known_position must be > 0 m");
  if (!(settled_heading > 0.0 && settled_position > 0.0)) return fail("settled_heading and _position must be > 0");
  if (!(rest_way >= 0.0 && rest_turn >= 0.0)) return fail("rest_way and rest_turn must be >= 0");
  if (!(doubt_heading >= 0.0 && doubt_heading <= 45.0)) return fail("doubt_heading must be 0..45 degrees");
  if (!(doubt_position >= 0.0 && doubt_position <= 0.5)) return fail("doubt_position must be 0..0.5 m");
  if (!(unknown_way >= 0.0)) return fail("unknown_way must be >= 0 m");
  if (!(borne_out_way >= 0.0)) return fail("borne_out_way must be >= 0 m");
  if (borne_out_pairs < 1) return fail("borne_out_pairs must be > 0");
  if (!(unknown_speed > 0.0 && mirrored_speed > 0.0)) return fail("unknown_speed and mirrored_speed must be > 0 m/s");
  return {};
}

}  // namespace docent::mapping
