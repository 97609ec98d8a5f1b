#include "docent/simulator/sensing/camera/figures.h"

#include <array>
#include <cmath>
#include <numbers>

#include "docent/base/random.h"

namespace docent::simulator {
namespace {

constexpr std::array<Rgb, 8> kClothes{{{0.55F, 0.08F, 0.08F},
                                       {0.07F, 0.16F, 0.45F},
                                       {0.10F, 0.33F, 0.14F},
                                       {0.70F, 0.55F, 0.10F},
                                       {0.62F, 0.62F, 0.60F},
                                       {0.34F, 0.12F, 0.38F},
                                       {0.05F, 0.35F, 0.38F},
                                       {0.72F, 0.32F, 0.12F}}};
constexpr std::array<Rgb, 4> kTrousers{
    {{0.04F, 0.05F, 0.09F}, {0.12F, 0.13F, 0.15F}, {0.18F, 0.12F, 0.07F}, {0.07F, 0.11F, 0.22F}}};
constexpr std::array<Rgb, 4> kSkins{
    {{0.68F, 0.42F, 0.30F}, {0.55F, 0.32F, 0.21F}, {0.30F, 0.15F, 0.09F}, {0.75F, 0.50F, 0.38F}}};
constexpr std::array<Rgb, 4> kHairs{
    {{0.03F, 0.02F, 0.015F}, {0.15F, 0.07F, 0.03F}, {0.45F, 0.30F, 0.10F}, {0.40F, 0.40F, 0.40F}}};

template <std::size_t N>
Rgb pick(const std::array<Rgb, N>& colors, Rng& rng) {
  return colors[static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(N) - 1))];
}

/// Points of a frame that stands on the floor: x ahead, y to the left, z up.
class Frame {
 public:
  explicit Frame(const Pose2& pose, double scale = 1.0) : pose_{pose}, scale_{scale} {}
  [[nodiscard]] Vec3 at(double x, double y, double z) const {
    return lifted(pose_ * Point2{scale_ * x, scale_ * y}, scale_ * z);
  }

 private:
  Pose2 pose_;
  double scale_;
};

}  // namespace

void add_figure(Mesh& mesh, const Figure& figure) {
  Rng rng = Rng{figure.id}.stream("clothes");
  const Look coat{pick(kClothes, rng)}, trousers{pick(kTrousers, rng)}, skin{pick(kSkins, rng)},
      hair{pick(kHairs, rng)};
  const double tall = figure.height / 1.7;  // all below is of a person of 1.7 m
  const Frame body{figure.pose, tall};
  const double swing = figure.walks ? 0.22 * std::sin(figure.stride) : 0.0;
  for (const double side : {-1.0, 1.0}) {
    add_limb(mesh, body.at(side * swing, 0.09 * side, 0.0), body.at(0.0, 0.08 * side, 0.82), 0.05 * tall, 0.085 * tall,
             trousers);
    add_ball(mesh, body.at(side * swing + 0.05, 0.09 * side, 0.04), 0.075 * tall, 0.04 * tall, {{0.02F, 0.02F, 0.02F}},
             8);
    add_limb(mesh, body.at(-0.8 * side * swing, 0.26 * side, 0.80), body.at(0.0, 0.2 * side, 1.38), 0.035 * tall,
             0.05 * tall, coat, 6);
    add_ball(mesh, body.at(-0.8 * side * swing, 0.26 * side, 0.77), 0.045 * tall, 0.05 * tall, skin, 6);
  }
  add_limb(mesh, body.at(0.0, 0.0, 0.78), body.at(0.0, 0.0, 1.40), 0.15 * tall, 0.19 * tall, coat, 10);
  add_ball(mesh, body.at(0.0, 0.0, 1.40), 0.19 * tall, 0.07 * tall, coat);
  add_limb(mesh, body.at(0.0, 0.0, 1.42), body.at(0.0, 0.0, 1.52), 0.05 * tall, 0.05 * tall, skin, 6);
  add_ball(mesh, body.at(0.01, 0.0, 1.58), 0.10 * tall, 0.125 * tall, skin);
  add_ball(mesh, body.at(-0.02, 0.0, 1.62), 0.108 * tall, 0.105 * tall, hair);
}

void add_robot(Mesh& mesh, const RobotFigure& robot) {
  constexpr Look kDrum{{0.42F, 0.03F, 0.03F}}, kDark{{0.03F, 0.03F, 0.035F}}, kMetal{{0.42F, 0.43F, 0.45F}},
      kWhite{{0.85F, 0.85F, 0.82F}}, kMouth{{0.60F, 0.03F, 0.04F}};
  const Frame body{robot.pose};
  const double r = robot.radius;
  const auto ring = [&](double from, double to, double radius, const Look& surface) {
    add_limb(mesh, body.at(0.0, 0.0, from), body.at(0.0, 0.0, to), radius, radius, surface, 20);
  };
  const auto cover = [&](double z, double radius, const Look& surface) {
    add_ball(mesh, body.at(0.0, 0.0, z), radius, 0.015, surface, 20);
  };
  ring(0.03, 0.34, r, kDrum);
  ring(0.34, 0.42, r, kDark);  // the scanners' slit
  ring(0.42, 0.66, r, kDrum);
  cover(0.66, r, kMetal);
  ring(0.66, 1.20, 0.09, kMetal);
  add_limb(mesh, body.at(0.12, 0.0, 0.86), body.at(0.18, 0.0, 1.12), 0.14, 0.14, kDark, 4);  // the screen
  const Pose2 neck = robot.pose * Pose2{0.0, 0.0, Angle::radians(robot.pan)};
  const double c = std::cos(robot.tilt), s = std::sin(robot.tilt);
  // Points of the head: it nods about its middle.
  const Frame plain{neck};
  const auto head = [&](double x, double y, double z) { return plain.at(c * x - s * z, y, 1.33 + s * x + c * z); };
  add_ball(mesh, head(0.0, 0.0, 0.0), 0.15, 0.15, kWhite, 16);
  const double brow = 0.02 * robot.valence;
  for (const double side : {-1.0, 1.0}) {
    add_ball(mesh, head(0.125, 0.06 * side, 0.05), 0.036, 0.036, {{0.95F, 0.95F, 0.95F}}, 10);
    add_ball(mesh, head(0.152, 0.058 * side, 0.05), 0.016, 0.016, kDark, 8);
    add_limb(mesh, head(0.135, 0.035 * side, 0.10 + brow), head(0.115, 0.095 * side, 0.10 - brow), 0.008, 0.008, kDark,
             6);
  }
  for (int i = -4; i < 4; ++i) {  // the mouth, a bow
    const auto at = [&](int k) {
      const double y = 0.016 * k;
      const double z = -0.065 + robot.valence * 0.028 * ((k * k) / 16.0 - 0.5);
      return head(std::sqrt(std::max(0.0, 0.155 * 0.155 - y * y - z * z)), y, z);
    };
    add_limb(mesh, at(i), at(i + 1), 0.009, 0.009, kMouth, 6);
  }
}

}  // namespace docent::simulator
