#include "docent/simulator/sensing/camera/things/litter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/base/random.h"

namespace docent::simulator {
namespace {

constexpr int kSides = 16;

struct Foot {
  Point2 middle;
  double radius = 0.0;  ///< [m] mean of its corners
};
Foot foot_of(const Polygon& polygon) {
  Foot foot;
  for (const Point2 corner : polygon) foot.middle = foot.middle + corner;
  foot.middle = (1.0 / static_cast<double>(polygon.size())) * foot.middle;
  for (const Point2 corner : polygon)
    foot.radius += distance(corner, foot.middle) / static_cast<double>(polygon.size());
  return foot;
}

Polygon ring(const Foot& foot, double radius) {
  Polygon circle;
  for (int i = 0; i < kSides; ++i)
    circle.push_back(foot.middle + radius * unit(Angle::radians(2.0 * std::numbers::pi * i / kSides)));
  return circle;
}

void add_tube(Mesh& mesh, const Foot& foot, double from, double to, double first, double last, const Look& look) {
  add_limb(mesh, lifted(foot.middle, from), lifted(foot.middle, to), first, last, look, kSides);
}

void add_can(Mesh& mesh, const Foot& foot, const Solid& solid, Rng rng) {
  constexpr std::array<Rgb, 5> kColors{{{0.70F, 0.04F, 0.05F},
                                        {0.05F, 0.12F, 0.55F},
                                        {0.05F, 0.42F, 0.12F},
                                        {0.85F, 0.45F, 0.03F},
                                        {0.60F, 0.62F, 0.65F}}};
  constexpr Look kMetal{{0.62F, 0.63F, 0.65F}};
  const Rgb color = kColors[static_cast<std::size_t>(rng.integer(0, 4))];
  const double r = foot.radius, h = solid.top - solid.bottom, z = solid.bottom;
  add_tube(mesh, foot, z, z + 0.06 * h, 0.8 * r, r, kMetal);
  add_tube(mesh, foot, z + 0.06 * h, z + 0.40 * h, r, r, {color});
  add_tube(mesh, foot, z + 0.40 * h, z + 0.58 * h, r, r, {{0.88F, 0.88F, 0.86F}});
  add_tube(mesh, foot, z + 0.58 * h, z + 0.90 * h, r, r, {color});
  add_tube(mesh, foot, z + 0.90 * h, z + h, r, 0.82 * r, kMetal);
  add_level(mesh, ring(foot, 0.82 * r), z + h, true, kMetal);
}

/// A ball with dents and flat faces.
void add_wad(Mesh& mesh, const Foot& foot, const Solid& solid, Rng rng) {
  Mesh ball;
  const double half = 0.5 * (solid.top - solid.bottom);
  const Vec3 middle = lifted(foot.middle, solid.bottom + half);
  add_ball(ball, middle, foot.radius, half, {}, 10);
  const std::uint64_t seed = rng();
  const auto dented = [&](Vec3 corner) {
    // By its place, so that corners that meet stay together.
    const Vec3 off = corner - middle;
    const auto part = [](float x) { return std::to_string(std::lround(1e4F * x)); };
    const std::uint64_t bits = hash_of(part(off.x) + "," + part(off.y) + "," + part(off.z), seed);
    return middle + (0.72F + 0.28F * static_cast<float>(bits % 1000U) / 1000.0F) * off;
  };
  for (const auto& corners : ball.triangles) {
    const Vec3 a = dented(ball.points[corners[0]]), b = dented(ball.points[corners[1]]),
               c = dented(ball.points[corners[2]]);
    const auto tone = static_cast<float>(0.74 + 0.14 * rng.uniform());
    add_quad(mesh, {a, b, c, c}, {{tone, tone, 0.97F * tone}});
  }
}

void add_bin(Mesh& mesh, const Foot& foot, const Solid& solid, Rng rng) {
  constexpr std::array<Rgb, 4> kColors{
      {{0.05F, 0.06F, 0.07F}, {0.30F, 0.32F, 0.34F}, {0.04F, 0.18F, 0.40F}, {0.05F, 0.28F, 0.10F}}};
  const Rgb color = kColors[static_cast<std::size_t>(rng.integer(0, 3))];
  const double r = foot.radius, z = solid.bottom, top = solid.top;
  add_tube(mesh, foot, z, top, 0.8 * r, r, {color});
  add_tube(mesh, foot, z + 0.02, top, 0.76 * r, 0.96 * r, {0.6F * color});
  add_tube(mesh, foot, top, top, r, 0.96 * r, {0.8F * color});
  add_level(mesh, ring(foot, 0.78 * r), z + 0.02, true, {0.3F * color});
}

}  // namespace

void add_litter(Mesh& mesh, const Solid& solid) {
  const Foot foot = foot_of(solid.polygon);
  const Rng rng = Rng{hash_of(solid.id)}.stream("litter");
  switch (solid.form) {
    case SolidForm::can:
      return add_can(mesh, foot, solid, rng);
    case SolidForm::wad:
      return add_wad(mesh, foot, solid, rng);
    case SolidForm::bin:
      return add_bin(mesh, foot, solid, rng);
    case SolidForm::prism:
      return;
  }
}

}  // namespace docent::simulator
