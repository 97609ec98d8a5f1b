#include "docent/simulator/sensing/camera/shading.h"

#include <algorithm>

#include "docent/simulator/sensing/camera/ceiling/ceiling_texture.h"

namespace docent::simulator {
namespace {

constexpr Rgb kNothing{0.30F, 0.33F, 0.36F};

/// std::floor for what lies in a museum; without SSE4.1 that is a call.
float below(float x) {
  const auto whole = static_cast<float>(static_cast<int>(x));
  return whole > x ? whole - 1.0F : whole;
}

float to_linear(std::uint8_t byte) {
  const float x = static_cast<float>(byte) / 255.0F;
  return x * x;
}

bool parted(float x, float step, float line) {
  const float parts = x * (1.0F / step);
  return parts - below(parts) < line * (1.0F / step);
}

Rgb tile_at(const Look& look, Vec3 at) {  // of 0.6 m, every other one a little darker
  if (parted(at.x, 0.6F, 0.012F) || parted(at.y, 0.6F, 0.012F)) return 0.72F * look.color;
  const bool dark = (static_cast<int>(below(at.x / 0.6F)) + static_cast<int>(below(at.y / 0.6F))) % 2 == 0;
  return (dark ? 0.92F : 1.0F) * look.color;
}

}  // namespace

Rgb Shading::shade(Vec3 eye, Vec3 ray, const TracedScene::Sight& sight) const {
  if (sight.layer == TracedScene::kNone) return kNothing;
  const Look& look = scene_.look_of(sight);
  const Vec3 at = eye + sight.away * ray;
  Vec3 normal = normalized(scene_.normal_of(sight));
  const Vec3 towards = -1.0F * ray;
  if (dot(normal, towards) < 0.0F) normal = -1.0F * normal;
  switch (look.finish) {
    case Finish::ceiling:
      return ceiling_at(look, at, sight.away * pixel_angle_ / std::max(0.15F, dot(normal, towards)));
    case Finish::lamp:
      return lamp_at(look, sight, at);
    case Finish::poster:
      return light_.share_at(at.x, at.y) * poster_at(look, sight);
    default:
      break;
  }
  const float around = 0.50F + 0.18F * normal.z;
  const float lamps = sight.in_shadow ? 0.0F : 0.42F * std::max(0.0F, dot(normal, kLampLight));
  const float along = 0.16F * std::max(0.0F, dot(normal, towards));
  return ((around + lamps + along) * light_.share_at(at.x, at.y)) * color_at(sight, at);
}

Rgb Shading::color_at(const TracedScene::Sight& sight, Vec3 at) const {
  if (sight.layer == TracedScene::kNone) return {};
  const Look& look = scene_.look_of(sight);
  switch (look.finish) {
    case Finish::tiles:
      return tile_at(look, at);
    case Finish::wall:  // a skirting board
      return at.z < 0.1F ? 0.4F * look.color : look.color;
    case Finish::poster:
      return poster_at(look, sight);
    case Finish::plain:
    case Finish::ceiling:
    case Finish::lamp:
      break;
  }
  return look.color;
}

Rgb Shading::ceiling_at(const Look& look, Vec3 at, float footprint) const {
  const CeilingField& field = ceiling_.fields[static_cast<std::size_t>(look.part)];
  const Rgb color = docent::simulator::color_at(field, {at.x, at.y}, footprint);
  const bool is_glazed = field.covering == Covering::glazing;
  return (is_glazed ? light_.lighting().daylight : light_.at(at.x, at.y)) * color;
}

Rgb Shading::lamp_at(const Look& look, const TracedScene::Sight& sight, Vec3 at) const {
  const Lamp& lamp = ceiling_.lamps[static_cast<std::size_t>(look.part)];
  return docent::simulator::color_at(lamp, scene_.place_of(sight), share_of(lamp, light_.lighting()),
                                     light_.at(at.x, at.y));
}

Rgb Shading::poster_at(const Look& look, const TracedScene::Sight& sight) const {
  const pictures::Image& poster = posters_[static_cast<std::size_t>(look.part)];
  const auto place = scene_.place_of(sight);
  const int x = std::clamp(static_cast<int>(place[0] * static_cast<float>(poster.width())), 0, poster.width() - 1);
  const int y = std::clamp(static_cast<int>(place[1] * static_cast<float>(poster.height())), 0, poster.height() - 1);
  const auto pixel = poster.bytes().subspan(
      4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(poster.width()) + static_cast<std::size_t>(x)), 3);
  return {to_linear(pixel[0]), to_linear(pixel[1]), to_linear(pixel[2])};
}

}  // namespace docent::simulator
