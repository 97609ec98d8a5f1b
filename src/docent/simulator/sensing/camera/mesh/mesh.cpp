#include "docent/simulator/sensing/camera/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace docent::simulator {
namespace {

constexpr Vec3 kUp{0.0F, 0.0F, 1.0F};

std::uint32_t add_corner(Mesh& mesh, Vec3 point, Vec3 normal, std::array<float, 2> place = {}) {
  mesh.points.push_back(point);
  mesh.normals.push_back(normal);
  mesh.places.push_back(place);
  return static_cast<std::uint32_t>(mesh.points.size() - 1);
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, const Look& surface) {
  mesh.triangles.push_back({a, b, c});
  mesh.surfaces.push_back(surface);
}

bool is_inside(Point2 p, Point2 a, Point2 b, Point2 c) {
  return cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
}

/// Indices of corners, three a triangle, by cutting off ears. @pre counter-clockwise
std::vector<std::array<std::size_t, 3>> triangulated(const Polygon& polygon) {
  std::vector<std::size_t> rest(polygon.size());
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = i;
  std::vector<std::array<std::size_t, 3>> triangles;
  const auto is_ear = [&](std::size_t i) {
    const std::size_t before = rest[(i + rest.size() - 1) % rest.size()];
    const std::size_t after = rest[(i + 1) % rest.size()];
    const Point2 a = polygon[before], b = polygon[rest[i]], c = polygon[after];
    if (cross(b - a, c - b) <= 0.0) return false;
    return std::none_of(rest.begin(), rest.end(), [&](std::size_t other) {
      return other != before && other != rest[i] && other != after && is_inside(polygon[other], a, b, c);
    });
  };
  while (rest.size() > 3) {
    std::size_t ear = 0;
    while (ear < rest.size() && !is_ear(ear)) ++ear;
    if (ear == rest.size()) ear = 0;  // crossed outlines: cut anywhere
    triangles.push_back({rest[(ear + rest.size() - 1) % rest.size()], rest[ear], rest[(ear + 1) % rest.size()]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  if (rest.size() == 3) triangles.push_back({rest[0], rest[1], rest[2]});
  return triangles;
}

Polygon counter_clockwise(Polygon polygon) {
  if (signed_area(polygon) < 0.0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

}  // namespace

void Mesh::clear() {
  points.clear();
  normals.clear();
  places.clear();
  triangles.clear();
  surfaces.clear();
}

void add_quad(Mesh& mesh, const std::array<Vec3, 4>& corners, const Look& surface) {
  const Vec3 normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
  constexpr std::array<std::array<float, 2>, 4> kPlaces{{{0.0F, 0.0F}, {0.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, 0.0F}}};
  std::array<std::uint32_t, 4> at{};
  for (std::size_t i = 0; i < 4; ++i) at[i] = add_corner(mesh, corners[i], normal, kPlaces[i]);
  add_triangle(mesh, at[0], at[1], at[2], surface);
  add_triangle(mesh, at[0], at[2], at[3], surface);
}

void add_level(Mesh& mesh, const Polygon& polygon, double z, bool faces_up, const Look& surface) {
  if (polygon.size() < 3) return;
  const Polygon outline = counter_clockwise(polygon);
  const Vec3 normal = faces_up ? kUp : -1.0F * kUp;
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (const Point2 corner : outline) add_corner(mesh, lifted(corner, z), normal);
  for (const auto& triangle : triangulated(outline))
    add_triangle(mesh, first + static_cast<std::uint32_t>(triangle[0]), first + static_cast<std::uint32_t>(triangle[1]),
                 first + static_cast<std::uint32_t>(triangle[2]), surface);
}

void add_prism(Mesh& mesh, const Polygon& polygon, double bottom, double top, const Look& side, const Look& cover) {
  const Polygon outline = counter_clockwise(polygon);
  for (const auto& [a, b] : sides(outline))
    add_quad(mesh, {lifted(a, top), lifted(a, bottom), lifted(b, bottom), lifted(b, top)}, side);
  add_level(mesh, outline, top, true, cover);
  constexpr double kOnFloor = 0.01;  // [m]
  if (bottom > kOnFloor) add_level(mesh, outline, bottom, false, side);
}

void add_limb(Mesh& mesh, Vec3 from, Vec3 to, double first, double last, const Look& surface, int sides) {
  const Vec3 axis = normalized(to - from);
  const Vec3 other = std::abs(axis.x) < 0.9F ? Vec3{1.0F, 0.0F, 0.0F} : Vec3{0.0F, 1.0F, 0.0F};
  const Vec3 u = normalized(cross(axis, other));
  const Vec3 v = cross(axis, u);
  const auto begin = static_cast<std::uint32_t>(mesh.points.size());
  for (int i = 0; i <= sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    const Vec3 out = static_cast<float>(std::cos(angle)) * u + static_cast<float>(std::sin(angle)) * v;
    add_corner(mesh, from + static_cast<float>(first) * out, out);
    add_corner(mesh, to + static_cast<float>(last) * out, out);
  }
  for (int i = 0; i < sides; ++i) {
    const std::uint32_t at = begin + 2U * static_cast<std::uint32_t>(i);
    add_triangle(mesh, at, at + 2, at + 1, surface);
    add_triangle(mesh, at + 1, at + 2, at + 3, surface);
  }
}

void add_ball(Mesh& mesh, Vec3 centre, double across, double upright, const Look& surface, int sides) {
  const int rows = sides / 2;
  const auto begin = static_cast<std::uint32_t>(mesh.points.size());
  for (int row = 0; row <= rows; ++row) {
    const double latitude = std::numbers::pi * row / rows;
    for (int i = 0; i <= sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      const Vec3 out{static_cast<float>(std::sin(latitude) * std::cos(angle)),
                     static_cast<float>(std::sin(latitude) * std::sin(angle)), static_cast<float>(std::cos(latitude))};
      const auto a = static_cast<float>(across);
      const auto h = static_cast<float>(upright);
      add_corner(mesh, centre + Vec3{a * out.x, a * out.y, h * out.z}, normalized({out.x / a, out.y / a, out.z / h}));
    }
  }
  const auto width = static_cast<std::uint32_t>(sides) + 1U;
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row)
    for (std::uint32_t i = 0; i + 1 < width; ++i) {
      const std::uint32_t at = begin + row * width + i;
      add_triangle(mesh, at, at + width, at + 1, surface);
      add_triangle(mesh, at + 1, at + width, at + width + 1, surface);
    }
}

}  // namespace docent::simulator
