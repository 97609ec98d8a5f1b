#pragma once

#include <optional>
#include <string>

#include "docent/collision_avoidance/watches/freshness.h"

namespace docent::collision_avoidance {

/// What a watch has to say against going on as if all were well.
struct Complaint {
  double max_speed = 0.0;  ///< [m/s] that is still safe; 0: the robot stands
  std::string reason;      ///< for a person
};

/// What all watches judge by.
struct ComplaintParams {
  double crippled_speed = 0.25;  ///< [m/s] with a sensor that tells only half of what it should
  double patience = 0.5;         ///< [s] without news, at least, before the robot stands (safety rule 1)
  double late = 0.2;             ///< [s] by which what comes may be late
};

/// The more cautious of two.
[[nodiscard]] std::optional<Complaint> worse(std::optional<Complaint> a, std::optional<Complaint> b);

/// Stands when nothing came for the patience or some periods, whichever is longer, or what comes is older than that by
/// its stamp; creeps when it is late.
/// @param name  of what it gives, e.g. "sweep of the front laser"
[[nodiscard]] std::optional<Complaint> complaint_of(const Freshness& freshness, Time now, const std::string& name,
                                                    const ComplaintParams& params = {});

}  // namespace docent::collision_avoidance
