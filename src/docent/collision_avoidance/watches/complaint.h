#pragma once

#include <optional>
#include <string>

#include "docent/collision_avoidance/watches/freshness.h"

namespace docent {

/// What a watch has to say against going on as if all were well.
struct Complaint {
  double max_speed = 0.0;  ///< [m/s] that is still safe; 0: the robot stands
  std::string reason;      ///< for a person
};

/// [m/s] with a sensor that tells only half of what it should.
inline constexpr double kCrippledSpeed = 0.25;

/// The more cautious of two.
[[nodiscard]] std::optional<Complaint> worse(std::optional<Complaint> a, std::optional<Complaint> b);

/// Stands when nothing came for max(`patience`, 2.5 periods) [s] (safety rule 1) or what comes is older than that by
/// its stamp; creeps when it is late by more than kLate.
/// @param name  of what it gives, e.g. "sweep of the front laser"
[[nodiscard]] std::optional<Complaint> complaint_of(const Freshness& freshness, Time now, const std::string& name,
                                                    double patience = 0.5);
inline constexpr double kLate = 0.2;  ///< [s]

}  // namespace docent
