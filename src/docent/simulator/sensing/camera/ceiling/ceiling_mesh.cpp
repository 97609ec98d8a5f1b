#include "docent/simulator/sensing/camera/ceiling/ceiling_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/simulator/sensing/camera/mesh/level_parts.h"

namespace docent::simulator {
namespace {

constexpr Look kRim{{0.55F, 0.55F, 0.53F}};
constexpr Look kWire{{0.10F, 0.10F, 0.10F}};
constexpr Look kHousing{{0.70F, 0.70F, 0.70F}};
constexpr double kWireThick = 0.004;  // [m] radius

Look look_of(const Ceiling& ceiling, std::size_t field) {
  return {ceiling.fields[field].color, Finish::ceiling, static_cast<std::int16_t>(field)};
}

void add_fields(Mesh& mesh, const Ceiling& ceiling, Point2 low, Point2 high) {
  const LevelParts parts = level_parts(low, high, ceiling.outlines);
  for (const LevelParts::Piece& piece : parts.pieces) {
    const auto field = static_cast<std::size_t>(piece.owner + 1);
    const double z = ceiling.fields[field].height;
    // Seen from below its front is clockwise.
    add_quad(mesh,
             {lifted(piece.corners[0], z), lifted(piece.corners[3], z), lifted(piece.corners[2], z),
              lifted(piece.corners[1], z)},
             look_of(ceiling, field));
  }
  for (const LevelParts::Border& border : parts.borders) {
    const CeilingField& left = ceiling.fields[static_cast<std::size_t>(border.left + 1)];
    const CeilingField& right = ceiling.fields[static_cast<std::size_t>(border.right + 1)];
    const double bottom = std::min(left.height, right.height), top = std::max(left.height, right.height);
    if (top - bottom < 1e-6) continue;
    const CeilingField& lower = left.height < right.height ? left : right;
    const bool is_glazed = left.covering == Covering::glazing || right.covering == Covering::glazing;
    const auto [a, b] = border.line;
    add_quad(mesh, {lifted(a, top), lifted(a, bottom), lifted(b, bottom), lifted(b, top)},
             is_glazed ? Look{{0.85F, 0.85F, 0.84F}} : Look{0.5F * kRim.color + 0.4F * lower.color});
  }
}

Polygon outline_of(const Lamp& lamp) {
  if (lamp.kind == LampKind::downlight) {
    constexpr int kCorners = 12;
    Polygon circle;
    for (int i = 0; i < kCorners; ++i)
      circle.push_back(lamp.pose * (0.5 * lamp.length * unit(Angle::radians(2.0 * std::numbers::pi * i / kCorners))));
    return circle;
  }
  const double l = 0.5 * lamp.length, w = 0.5 * lamp.width;
  return {lamp.pose * Point2{-l, -w}, lamp.pose * Point2{l, -w}, lamp.pose * Point2{l, w}, lamp.pose * Point2{-l, w}};
}

void add_lamp(Mesh& mesh, const Lamp& lamp, std::int16_t index) {
  const Look shining{{0.8F, 0.8F, 0.8F}, Finish::lamp, index};
  const auto at = [&](double x, double y, double z) { return lifted(lamp.pose * Point2{x, y}, z); };
  const double l = 0.5 * lamp.length, w = 0.5 * lamp.width, z = lamp.height;
  switch (lamp.kind) {
    case LampKind::troffer:
      add_prism(mesh, outline_of(lamp), z, lamp.ceiling, kHousing, kHousing);
      return add_quad(mesh, {at(-l, -w, z - 0.001), at(-l, w, z - 0.001), at(l, w, z - 0.001), at(l, -w, z - 0.001)},
                      shining);
    case LampKind::downlight: {
      Lamp ring = lamp;
      ring.length *= 1.25;
      add_level(mesh, outline_of(ring), z + 0.002, false, kHousing);
      return add_level(mesh, outline_of(lamp), z, false, shining);
    }
    case LampKind::tube:
      add_prism(mesh, outline_of(lamp), z + 0.002, z + 0.07, kHousing, kHousing);
      add_quad(mesh, {at(-l, -w, z), at(-l, w, z), at(l, w, z), at(l, -w, z)}, shining);
      for (const double x : {-0.7 * l, 0.7 * l})
        add_limb(mesh, at(x, 0.0, z + 0.07), at(x, 0.0, lamp.ceiling), kWireThick, kWireThick, kWire, 3);
      return;
    case LampKind::globe:
      add_ball(mesh, at(0.0, 0.0, z + l), l, 0.8 * l, shining, 12);
      return add_limb(mesh, at(0.0, 0.0, z + 1.7 * l), at(0.0, 0.0, lamp.ceiling), kWireThick, kWireThick, kWire, 3);
  }
}

void add_beam(Mesh& mesh, const Beam& beam) {
  const double length = distance(beam.axis.a, beam.axis.b);
  if (length <= 0.0) return;
  const Point2 along = (1.0 / length) * (beam.axis.b - beam.axis.a);
  const Point2 aside = 0.5 * beam.width * Point2{-along.y, along.x};
  add_prism(mesh, {beam.axis.a - aside, beam.axis.b - aside, beam.axis.b + aside, beam.axis.a + aside}, beam.bottom,
            beam.top, {beam.color}, {beam.color});
}

}  // namespace

void add_ceiling(Mesh& mesh, const Ceiling& ceiling, Point2 low, Point2 high) {
  if (ceiling.fields.empty()) return;
  add_fields(mesh, ceiling, low, high);
  for (const Beam& beam : ceiling.beams) add_beam(mesh, beam);
  for (std::size_t i = 0; i < ceiling.lamps.size(); ++i) add_lamp(mesh, ceiling.lamps[i], static_cast<std::int16_t>(i));
}

}  // namespace docent::simulator
