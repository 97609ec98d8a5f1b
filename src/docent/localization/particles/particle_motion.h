#pragma once

#include "docent/localization/particles/noise_streams.h"
#include "docent/localization/particles/particle_set.h"
#include "docent/motion_models/odometry_model.h"

namespace docent::localization {

/// The least that particles are shaken at every step, so that copies of one particle part again.
struct Shake {
  double position = 0.01;  ///< [m] standard deviation along each axis
  double heading = 0.2;    ///< [deg]
};

/// Draws every particle's next pose, p(s' | s, a) of [Minerva2000] eq. 4: the odometry increment with the errors of
/// the motion model; with its slip probability, scaled by the motion, with much larger ones. Particles stay inside the
/// box. O(particles), the same for a seed on every instruction set.
struct MapBox {
  float left = 0, bottom = 0, right = 0, top = 0;  ///< [m]
};
void move_particles(ParticleSet& particles, const motion_models::OdometryModelParams& params,
                    const Pose2& before_from_after, const Shake& shake, const MapBox& box, NoiseStreams& noise);

}  // namespace docent::localization
