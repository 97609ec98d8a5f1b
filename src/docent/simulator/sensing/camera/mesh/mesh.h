#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "docent/geometry/polygon.h"

namespace docent::simulator {

struct Vec3 {
  float x = 0.0F, y = 0.0F, z = 0.0F;
  friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(float s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
};
[[nodiscard]] inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Upwards where there is no direction.
[[nodiscard]] inline Vec3 normalized(Vec3 a) {
  const float square = dot(a, a);
  return square > 0.0F ? (1.0F / std::sqrt(square)) * a : Vec3{0.0F, 0.0F, 1.0F};
}
[[nodiscard]] inline Vec3 lifted(Point2 point, double z) {
  return {static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(z)};
}

/// Linear light, 0..1 a channel.
struct Rgb {
  float red = 0.0F, green = 0.0F, blue = 0.0F;
  friend Rgb operator*(float s, Rgb a) { return {s * a.red, s * a.green, s * a.blue}; }
  friend Rgb operator*(Rgb a, Rgb b) { return {a.red * b.red, a.green * b.green, a.blue * b.blue}; }
  friend Rgb operator+(Rgb a, Rgb b) { return {a.red + b.red, a.green + b.green, a.blue + b.blue}; }
};

enum class Finish : std::uint8_t {
  plain,    ///< its colour
  tiles,    ///< a floor
  wall,     ///< with a skirting board
  ceiling,  ///< a field of the ceiling
  lamp,     ///< of the ceiling; its place is 0..1 along and across it
  poster,   ///< a picture
};

/// What a triangle looks like.
struct Look {
  Rgb color;
  Finish finish = Finish::plain;
  std::int16_t part = -1;  ///< index in the scene's posters, the ceiling's fields or its lamps
};

/// Triangles with a normal and a place in their poster at each corner.
struct Mesh {
  std::vector<Vec3> points;                             ///< [corners] [m], world
  std::vector<Vec3> normals;                            ///< [corners]
  std::vector<std::array<float, 2>> places;             ///< [corners] 0..1 from the poster's upper left
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< [triangles] corners
  std::vector<Look> surfaces;                           ///< [triangles]
  void clear();
};

/// A flat piece with four corners in order, counter-clockwise as seen from its front; the first is the poster's upper
/// left, the second its lower left.
void add_quad(Mesh& mesh, const std::array<Vec3, 4>& corners, const Look& surface);
/// A level polygon, which may be concave. O(corners^3).
void add_level(Mesh& mesh, const Polygon& polygon, double z, bool faces_up, const Look& surface);
/// A prism over a polygon; its underside only where that is higher than the floor.
void add_prism(Mesh& mesh, const Polygon& polygon, double bottom, double top, const Look& side, const Look& cover);
/// A round limb from `from` to `to`, thick `first` and `last` [m] at its ends, without caps.
void add_limb(Mesh& mesh, Vec3 from, Vec3 to, double first, double last, const Look& surface, int sides = 8);
/// An ellipsoid that stands upright. @param radii  [m] along x and y, and along z
void add_ball(Mesh& mesh, Vec3 centre, double across, double upright, const Look& surface, int sides = 10);

}  // namespace docent::simulator
