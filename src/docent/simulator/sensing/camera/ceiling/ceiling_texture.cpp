#include "docent/simulator/sensing/camera/ceiling/ceiling_texture.h"

#include <algorithm>
#include <cmath>

namespace docent::simulator {
namespace {

constexpr float kBar = 0.024F;  // [m] across the bars that hold panels

/// Mixes three numbers into one that looks like chance (the finalizer of splitmix64).
std::uint64_t mixed(std::uint64_t seed, std::int64_t a, std::int64_t b) {
  std::uint64_t x = seed + 0x9E3779B97F4A7C15ULL * static_cast<std::uint64_t>(a) +
                    0xD1B54A32D192ED03ULL * static_cast<std::uint64_t>(b);
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}
/// 0..1 of some of its bits: `which` 0..3.
float part_of(std::uint64_t bits, unsigned which) {
  return static_cast<float>((bits >> (16U * which)) & 0xFFFFU) / 65536.0F;
}

float floored(float x) {
  const auto whole = static_cast<float>(static_cast<int>(x));
  return whole > x ? whole - 1.0F : whole;
}

/// Smooth noise 0..1 that changes over `scale` [m].
float noise(std::uint64_t seed, float x, float y, float scale) {
  const float u = x / scale, v = y / scale;
  const float i = floored(u), k = floored(v);
  const auto smooth = [](float t) { return t * t * (3.0F - 2.0F * t); };
  const float s = smooth(u - i), t = smooth(v - k);
  const auto at = [&](int a, int b) {
    return part_of(mixed(seed, static_cast<std::int64_t>(i) + a, static_cast<std::int64_t>(k) + b), 0);
  };
  return (1.0F - t) * ((1.0F - s) * at(0, 0) + s * at(1, 0)) + t * ((1.0F - s) * at(0, 1) + s * at(1, 1));
}

/// Share of a pixel of `footprint` at distance `away` from a line's middle that a line of `width` covers.
float coverage(float away, float width, float footprint) {
  const float from = std::max(away - 0.5F * footprint, -0.5F * width);
  const float to = std::min(away + 0.5F * footprint, 0.5F * width);
  return std::clamp((to - from) / std::max(footprint, 1e-4F), 0.0F, 1.0F);
}

/// A place in a grid of rectangles.
struct Place {
  std::int64_t column, row;
  float x, y;  ///< [m] from the panel's corner
  float edge;  ///< [m] to the nearest side
};
Place place_in(const CeilingField& field, Point2 in_grid) {
  const auto length = static_cast<float>(field.length), width = static_cast<float>(field.width);
  const auto gx = static_cast<float>(in_grid.x), gy = static_cast<float>(in_grid.y);
  const float column = floored(gx / length), row = floored(gy / width);
  const float x = gx - column * length, y = gy - row * width;
  return {static_cast<std::int64_t>(column), static_cast<std::int64_t>(row), x, y,
          std::min(std::min(x, length - x), std::min(y, width - y))};
}

/// Lines of `width` every `step` [m], as a share 0..1; their mean where they are too fine to see.
float lines(float x, float step, float width, float footprint) {
  if (footprint > 0.5F * step) return width / step;
  const float at = x - floored(x / step) * step;
  return std::min(1.0F, coverage(at - 0.5F * step, width, footprint));
}

Rgb missing_panel(const Place& p, std::uint64_t fate) {
  // A look at what is above: a pipe in the dark.
  const float c = part_of(fate, 1) - 0.5F;
  const float pipe = std::abs(p.x * (0.5F + c) + p.y * (0.5F - c) - 0.3F);
  return pipe < 0.04F ? Rgb{0.30F, 0.28F, 0.25F} : Rgb{0.025F, 0.025F, 0.03F};
}

Rgb stained_panel(const Rgb& color, const Place& p, const CeilingField& field, std::uint64_t fate) {
  const float x = p.x - part_of(fate, 1) * static_cast<float>(field.length);
  const float y = p.y - part_of(fate, 2) * static_cast<float>(field.width);
  const float radius = 0.10F + 0.22F * part_of(fate, 3);
  const float wobble = 0.5F + noise(fate, p.x, p.y, 0.12F);
  const float share = std::sqrt(x * x + y * y) / (radius * wobble);
  if (share > 1.0F) return color;
  const Rgb brown{0.78F, 0.62F, 0.40F};  // darkest at its rim, as water leaves it
  return color * (share > 0.8F ? 0.75F * brown : 0.95F * brown);
}

Rgb vented_panel(const Rgb& color, const Place& p, const CeilingField& field, std::uint64_t fate, float footprint) {
  if (p.edge < 0.06F) return color;
  const bool is_square = part_of(fate, 1) < 0.5F && field.length < 2.0 * field.width;
  const float dark = is_square ? lines(p.edge, 0.07F, 0.03F, footprint) : lines(p.y, 0.05F, 0.025F, footprint);
  return (1.0F - 0.85F * dark) * color;
}

Rgb dotted_panel(const Rgb& color, const Place& p, const CeilingField& field, std::uint64_t fate) {
  const float x = p.x - (0.25F + 0.5F * part_of(fate, 1)) * static_cast<float>(field.length);
  const float y = p.y - (0.25F + 0.5F * part_of(fate, 2)) * static_cast<float>(field.width);
  const float away = std::sqrt(x * x + y * y), radius = 0.045F + 0.06F * part_of(fate, 3);
  if (away > radius) return color;
  return away > 0.6F * radius ? Rgb{0.35F, 0.35F, 0.36F} : Rgb{0.9F, 0.9F, 0.9F};
}

Rgb panel(const CeilingField& field, const Place& p, Point2 in_grid, float footprint) {
  const std::uint64_t fate = mixed(field.seed, p.column, p.row);
  const auto gx = static_cast<float>(in_grid.x), gy = static_cast<float>(in_grid.y);
  Rgb color = (0.96F + 0.08F * part_of(fate >> 7U, 2)) * field.color;
  color = (0.94F + 0.12F * noise(field.seed, gx, gy, 1.7F)) * color;
  if (footprint < 0.05F) color = (0.97F + 0.06F * noise(field.seed + 1, gx, gy, 0.06F)) * color;
  const float lot = part_of(fate, 0);
  if (lot < 0.012F) return missing_panel(p, fate);
  if (lot < 0.09F) return stained_panel(color, p, field, fate);
  if (lot < 0.145F) return vented_panel(color, p, field, fate, footprint);
  if (lot < 0.22F) return dotted_panel(color, p, field, fate);
  return color;
}

Rgb plaster(const CeilingField& field, Point2 in_grid, float footprint) {
  const auto x = static_cast<float>(in_grid.x), y = static_cast<float>(in_grid.y);
  const float broad = noise(field.seed, x, y, 1.3F), middle = noise(field.seed + 1, x, y, 0.37F);
  float tone = 0.88F + 0.14F * broad + 0.10F * middle;
  if (footprint < 0.06F) tone += 0.05F * (noise(field.seed + 2, x, y, 0.07F) - 0.5F);
  Rgb color = tone * field.color;
  const float patch = noise(field.seed + 3, x, y, 0.8F);
  if (patch > 0.82F) color = color * Rgb{0.85F, 0.78F, 0.66F};  // damp
  const float crack = std::abs(noise(field.seed + 4, x, y, 1.9F) - 0.5F);
  return crack < 0.007F ? 0.7F * color : color;
}

Rgb roof(const CeilingField& field, Point2 in_grid, float footprint) {
  constexpr float kPlank = 0.24F, kLong = 3.1F;
  const auto x = static_cast<float>(in_grid.x), y = static_cast<float>(in_grid.y);
  const float row = floored(y / kPlank);
  const float shift = kLong * part_of(mixed(field.seed, static_cast<std::int64_t>(row), 17), 0);
  const float column = floored((x + shift) / kLong);
  const std::uint64_t fate = mixed(field.seed + 5, static_cast<std::int64_t>(column), static_cast<std::int64_t>(row));
  const float edge = std::min(y - row * kPlank, (row + 1.0F) * kPlank - y);
  const float joint = coverage(edge, 0.015F, footprint);
  const float grain = footprint < 0.1F ? 0.94F + 0.12F * noise(fate, 0.25F * x, y, 0.05F) : 1.0F;
  return ((0.72F + 0.45F * part_of(fate, 1)) * grain * (1.0F - 0.6F * joint)) * field.color;
}

Rgb glazing(const CeilingField& field, const Place& p, float footprint) {
  const std::uint64_t fate = mixed(field.seed, p.column, p.row);
  const float bar = coverage(p.edge, 0.05F, footprint);
  const float clean = 1.1F + 0.7F * part_of(fate, 0);
  return (1.0F - bar) * clean * field.color + bar * Rgb{0.12F, 0.13F, 0.14F};
}

}  // namespace

Rgb color_at(const CeilingField& field, Point2 in_world, float footprint) {
  const Point2 in_grid = field.to_grid(in_world);
  switch (field.covering) {
    case Covering::plain:
      return field.color;
    case Covering::plaster:
      return plaster(field, in_grid, footprint);
    case Covering::roof:
      return roof(field, in_grid, footprint);
    case Covering::glazing:
      return glazing(field, place_in(field, in_grid), footprint);
    case Covering::periodic:
    case Covering::panels:
      break;
  }
  const Place p = place_in(field, in_grid);
  const Rgb flat = field.covering == Covering::periodic ? field.color : panel(field, p, in_grid, footprint);
  const float bar = coverage(p.edge, kBar, footprint);
  return (1.0F - bar) * flat + bar * (0.72F * field.color);
}

Rgb color_at(const Lamp& lamp, std::array<float, 2> place, float share, float ambient) {
  float louvre = 1.0F;
  if (lamp.kind == LampKind::troffer) {  // fins every 10 cm or so, and a rim
    const float x = place[0] * static_cast<float>(lamp.length), y = place[1] * static_cast<float>(lamp.width);
    const float edge =
        std::min(std::min(x, static_cast<float>(lamp.length) - x), std::min(y, static_cast<float>(lamp.width) - y));
    const auto near_fin = [](float s) { return std::abs(s / 0.1F - floored(s / 0.1F) - 0.5F) > 0.43F; };
    louvre = edge < 0.025F ? 0.25F : near_fin(x) || near_fin(y) ? 0.55F : 1.0F;
  }
  return (louvre * (0.55F * ambient + share * lamp.radiance)) * lamp.tint;
}

}  // namespace docent::simulator
