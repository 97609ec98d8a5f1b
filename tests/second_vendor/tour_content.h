#pragma once

#include <cmath>
#include <cstdint>

// What the messages of a tour say, by their number: both sides know it, so that each can tell a wrong value from a
// right one. Plain numbers; each side puts them into its own messages.

namespace second_vendor {

inline constexpr int kBeams = 360;
inline constexpr int kMapWidth = 700;
inline constexpr int kMapHeight = 300;

/// [m] Every ninth beam comes back from nowhere (+infinity).
inline float range_of(std::uint32_t step, int beam) {
  const std::uint32_t mixed = (step * 2654435761U) ^ (static_cast<std::uint32_t>(beam) * 40503U);
  if (mixed % 9 == 0) return INFINITY;
  return 0.1F + static_cast<float>(mixed % 9999U) * 0.001F;
}
inline double odometry_x(std::uint32_t step) { return 0.025 * step; }
inline double odometry_yaw(std::uint32_t step) { return std::remainder(0.01 * step, 2.0 * M_PI); }
inline double speed_of(std::uint32_t step) { return 0.5 - 0.000013 * step; }
inline double turn_of(std::uint32_t step) { return -0.9 + 0.000029 * step; }
/// -1, 0 … 100.
inline std::int8_t map_cell(std::size_t cell) { return static_cast<std::int8_t>(static_cast<int>(cell % 102U) - 1); }

}  // namespace second_vendor
