#include "docent/pictures/colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace docent::pictures {
namespace {

Color along(std::span<const Color> stops, double at) {
  const double place = std::clamp(std::isfinite(at) ? at : 0.0, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  return mixed(stops[first], stops[first + 1], place - static_cast<double>(first));
}

}  // namespace

Color mixed(Color a, Color b, double at) {
  const double share = std::clamp(at, 0.0, 1.0);
  const auto channel = [share](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue), channel(a.alpha, b.alpha)};
}

Color heat(double at) {
  static constexpr std::array<Color, 5> kStops{
      {{255, 244, 196}, {253, 187, 99}, {232, 94, 72}, {152, 32, 104}, {46, 8, 84}}};
  return along(kStops, at);
}

Color rainbow(double at) {
  static constexpr std::array<Color, 5> kStops{
      {{44, 88, 200}, {22, 158, 196}, {54, 168, 84}, {236, 160, 24}, {206, 40, 44}}};
  return along(kStops, at);
}

Color distinct(int n) {
  static constexpr std::array<Color, 8> kColors{{{38, 98, 180},
                                                 {233, 132, 28},
                                                 {46, 139, 87},
                                                 {206, 48, 44},
                                                 {122, 62, 157},
                                                 {140, 88, 60},
                                                 {20, 160, 172},
                                                 {216, 92, 160}}};
  return kColors[static_cast<std::size_t>(((n % 8) + 8) % 8)];
}

}  // namespace docent::pictures
