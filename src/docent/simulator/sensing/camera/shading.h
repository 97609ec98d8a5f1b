#pragma once

#include <vector>

#include "docent/pictures/image.h"
#include "docent/simulator/sensing/camera/ceiling/ceiling_light.h"
#include "docent/simulator/sensing/camera/traced_scene.h"

namespace docent::simulator {

/// What light comes from a place that was met.
class Shading {
 public:
  /// All must outlive it. @param pixel_angle  [rad] across a pixel
  Shading(const TracedScene& scene, const Ceiling& ceiling, const std::vector<pictures::Image>& posters,
          const CeilingLight::Field& light, float pixel_angle)
      : scene_{scene}, ceiling_{ceiling}, posters_{posters}, light_{light}, pixel_angle_{pixel_angle} {}

  /// Light of all directions, more from above; the lamps'; and a little along the view, so that forms show.
  /// @param ray  of length 1
  [[nodiscard]] Rgb shade(Vec3 eye, Vec3 ray, const TracedScene::Sight& sight) const;
  /// The share of light that the place throws back, whatever light there is.
  [[nodiscard]] Rgb color_at(const TracedScene::Sight& sight, Vec3 at) const;

 private:
  [[nodiscard]] Rgb ceiling_at(const Look& look, Vec3 at, float footprint) const;
  [[nodiscard]] Rgb lamp_at(const Look& look, const TracedScene::Sight& sight, Vec3 at) const;
  [[nodiscard]] Rgb poster_at(const Look& look, const TracedScene::Sight& sight) const;

  const TracedScene& scene_;
  const Ceiling& ceiling_;
  const std::vector<pictures::Image>& posters_;
  const CeilingLight::Field& light_;
  float pixel_angle_;
};

}  // namespace docent::simulator
