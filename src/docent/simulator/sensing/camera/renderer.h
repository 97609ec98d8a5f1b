#pragma once

#include <memory>

#include "docent/pictures/image.h"
#include "docent/simulator/sensing/camera/furnishing.h"
#include "docent/simulator/sensing/camera/optics/raw_picture.h"
#include "docent/simulator/sensing/camera/optics/ray_table.h"
#include "docent/simulator/sensing/camera/optics/viewpoint.h"

namespace docent::simulator {

/// A pinhole that looks along a direction, level.
struct Lens {
  Vec3 eye;                    ///< [m], world
  double pan = 0.0;            ///< [rad] from the world's x axis, to the left
  double tilt = 0.0;           ///< [rad] upwards
  double field_of_view = 1.2;  ///< [rad] across
  int width = 320;             ///< [pixels]
  int height = 240;            ///< [pixels]
};

/// Draws what a camera sees: the nearest surface along a ray through each pixel, by Embree; the surface's colour in the
/// light of the ceiling's lamps, with shadows on the floor, and four rays where an edge runs through a pixel. The same
/// scene gives the same pixels; Embree's arithmetic is bound to SSE2, so it does on every CPU. One thread.
class Renderer {
 public:
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// What stands still from now on. O(n log n) in its triangles.
  void set_furnishing(Furnishing furnishing);
  /// What moves, as it is now: people and the robot. O(n log n), fast.
  void set_figures(Mesh figures);
  /// For people to look at. O(pixels log(triangles)).
  [[nodiscard]] pictures::Image draw(const Lens& lens, const Lighting& lighting = {}) const;
  /// The light on the sensor of a camera. O(pixels log(triangles)).
  [[nodiscard]] RawPicture expose(const Viewpoint& viewpoint, const RayTable& lens,
                                  const Lighting& lighting = {}) const;
  /// What a depth camera meets. @param baseline  [m] of its projector, to its right
  [[nodiscard]] RawDepth probe(const Viewpoint& viewpoint, const RayTable& lens, double baseline) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace docent::simulator
