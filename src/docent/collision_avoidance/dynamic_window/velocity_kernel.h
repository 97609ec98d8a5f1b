#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "docent/base/instruction_set.h"

namespace docent::collision_avoidance {

// The two inner loops of the dynamic window, in vectors of eight: the first contact on circular arcs, and the value of
// velocities. Run-time dispatch; all instruction sets give the same results, bit for bit.

/// A disc that the robot's centre must not enter, and what follows of it.
struct Contact {
  double x = 0.0, y = 0.0;  ///< [m] its centre, robot frame
  double reach = 0.0;       ///< [m] its radius, less than the centre's distance d
  double power = 0.0;       ///< [m2] (d^2 - reach^2) / 2
  double least = 0.0;       ///< [m] no way to it is shorter
};

/// One row of the dynamic window: velocities of one linear and many angular speeds.
struct VelocityRow {
  double linear = 0.0;  ///< [m/s]
  double time = 0.0;    ///< [s] the pose is predicted so far
  double goal_x = 0.0;  ///< [m] what is steered for, robot frame
  double goal_y = 0.0;  ///< [m]
  double heading_weight = 0.0;
  double progress_weight = 0.0;   ///< by the speed towards the goal [s/m]
  double clearance_weight = 0.0;  ///< by the free way, of which `enough_way` counts as all
  double enough_way = 0.0;        ///< [m] > 0
  double stopping = 0.0;          ///< [m] a free way shorter than this is refused
};
/// What the columns of the dynamic window share: one entry an angular speed, padded to a multiple of kLanes.
struct VelocityColumns {
  const double* half_cosine = nullptr;  ///< of half the turn until the predicted pose
  const double* half_sine = nullptr;
  const double* cosine = nullptr;  ///< of the whole turn
  const double* sine = nullptr;
  const double* change = nullptr;  ///< weighted change of the command
};

struct VelocityKernels {
  static constexpr std::size_t kLanes = 8;
  /// The ways [m] along kLanes arcs to the first of `contacts` that each meets, at most `horizon`.
  /// @param order  indices into contacts, `least` not falling
  void (*free_ways)(const Contact* contacts, std::span<const std::uint32_t> order, const double* curvatures,
                    double horizon, double* ways);
  /// Values of `count` velocities, a multiple of kLanes; -1 where the way is too short to stop in.
  /// @param ways  [m] free along each; `clearances` is what its clearance counts as
  void (*values)(const VelocityRow& row, const VelocityColumns& columns, const double* ways, const double* clearances,
                 std::size_t count, double* values);
};

/// @pre the processor has `set`
[[nodiscard]] const VelocityKernels& velocity_kernels(InstructionSet set);

}  // namespace docent::collision_avoidance
