#include "docent/localization/particles/particle_motion.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace docent::localization {

namespace {

constexpr std::size_t kBlock = 256;
constexpr float kSlipPosition = 0.10F;                                             // [m]
constexpr float kSlipTurn = 8.0F * static_cast<float>(std::numbers::pi) / 180.0F;  // [rad]

struct Deviations {
  float position, heading;
};

/// Plain, so that the compiler makes vectors of it: no branch, no call.
void move_block(ParticleSet& particles, std::size_t first, std::size_t count, const std::array<float, 4>& step,
                const Deviations& usual, const Deviations& slipping, float slip, const MapBox& box,
                const std::array<std::array<float, kBlock>, 4>& noise) {
  const auto [ahead, aside, turn_cos, turn_sin] = step;
  float* const x = particles.x.data() + first;
  float* const y = particles.y.data() + first;
  float* const hx = particles.heading_x.data() + first;
  float* const hy = particles.heading_y.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const bool slips = noise[3][i] < slip;
    const float position = slips ? slipping.position : usual.position;
    const float dx = ahead + noise[0][i] * position;
    const float dy = aside + noise[1][i] * position;
    // The turn whose half has the tangent t: nearly 2 t for small turns, and exactly a turn for all.
    const float t = 0.5F * noise[2][i] * (slips ? slipping.heading : usual.heading);
    const float inverse = 1.0F / (1.0F + t * t);
    const float noise_cos = (1.0F - t * t) * inverse;
    const float noise_sin = 2.0F * t * inverse;
    const float c = turn_cos * noise_cos - turn_sin * noise_sin;
    const float s = turn_sin * noise_cos + turn_cos * noise_sin;
    const float nx = x[i] + hx[i] * dx - hy[i] * dy;
    const float ny = y[i] + hy[i] * dx + hx[i] * dy;
    const float mx = hx[i] * c - hy[i] * s;
    const float my = hy[i] * c + hx[i] * s;
    const float shrink = 1.5F - 0.5F * (mx * mx + my * my);  // one step of Newton back to length 1
    x[i] = std::min(std::max(nx, box.left), box.right);
    y[i] = std::min(std::max(ny, box.bottom), box.top);
    hx[i] = mx * shrink;
    hy[i] = my * shrink;
  }
}

}  // namespace

void move_particles(ParticleSet& particles, const motion_models::OdometryModelParams& params,
                    const Pose2& before_from_after, const Shake& shake, const MapBox& box, NoiseStreams& noise) {
  const motion_models::MotionNoise error = motion_models::motion_noise(params, before_from_after);
  const double shake_turn = shake.heading * std::numbers::pi / 180.0;
  const Deviations usual{static_cast<float>(std::sqrt(error.position_variance + shake.position * shake.position)),
                         static_cast<float>(std::sqrt(error.heading_variance + shake_turn * shake_turn))};
  const Deviations slipping{usual.position + kSlipPosition, usual.heading + kSlipTurn};
  // A robot that stands does not slip.
  const double way = norm(before_from_after.position());
  const double turn = std::abs(before_from_after.theta.radians());
  const auto slip = static_cast<float>(params.slip_probability * std::min(1.0, way / 0.25 + turn / 0.5));
  const Point2 turned = unit(before_from_after.theta);
  const std::array<float, 4> step{static_cast<float>(before_from_after.x), static_cast<float>(before_from_after.y),
                                  static_cast<float>(turned.x), static_cast<float>(turned.y)};
  std::array<std::array<float, kBlock>, 4> draws{};
  for (std::size_t first = 0; first < particles.padded_size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, particles.padded_size() - first);
    for (std::size_t k = 0; k < 3; ++k) noise.fill_normal(std::span{draws[k]}.first(count));
    noise.fill_uniform(std::span{draws[3]}.first(count));
    move_block(particles, first, count, step, usual, slipping, slip, box, draws);
  }
}

}  // namespace docent::localization
