#pragma once

#include <cstddef>

#include "docent/base/random.h"
#include "docent/localization/particles/particle_set.h"

/// Particles for tests and benchmarks.
namespace docent::localization::testing {

/// `count` particles anywhere in the box 0..width x 0..height, with weights between 0 and 1 that do not sum to 1.
inline ParticleSet any_particles(Rng& rng, std::size_t count, double width, double height) {
  ParticleSet particles;
  particles.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = rng.uniform(0.0, width);
    const double y = rng.uniform(0.0, height);
    const Angle heading = Angle::degrees(rng.uniform(-180.0, 180.0));
    particles.set(i, {x, y, heading}, static_cast<float>(rng.uniform()));
  }
  return particles;
}

}  // namespace docent::localization::testing
