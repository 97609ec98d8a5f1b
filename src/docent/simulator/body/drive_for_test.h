#pragma once

#include <cmath>

#include "docent/simulator/body/body.h"

// For the tests of this folder.

namespace docent::simulator {

inline constexpr double kStep = 0.01;  // [s]

/// A base without errors.
inline BodyParams perfect() {
  BodyParams params;
  params.latency_spread = params.scale_error = params.wheel_error = params.base_error = 0.0;
  params.travel_noise = params.turn_noise = params.slip = 0.0;
  return params;
}

/// Commands at 20 Hz; `command` may say nothing.
template <class F>
Time drive(Body& body, Time from, double duration, F&& command) {
  Time now = from;
  for (int i = 0; i < static_cast<int>(std::lround(duration / kStep)); ++i) {
    if (i % 5 == 0) command(now);
    now = now + seconds(kStep);
    body.step(now, kStep, true);
  }
  return now;
}

}  // namespace docent::simulator
