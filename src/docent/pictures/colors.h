#pragma once

#include <cstdint>

namespace docent::pictures {

/// Eight bits a channel, not premultiplied.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  std::uint8_t alpha = 255;
  friend bool operator==(const Color&, const Color&) = default;
};

[[nodiscard]] constexpr Color with_alpha(Color color, std::uint8_t alpha) {
  return {color.red, color.green, color.blue, alpha};
}
/// `at` 0 gives `a`, 1 gives `b`; clamped.
[[nodiscard]] Color mixed(Color a, Color b, double at);

/// Pale yellow to dark violet, rising in darkness: stays readable in grey and for colour-blind people. `at` 0..1,
/// clamped.
[[nodiscard]] Color heat(double at);
/// Blue (0) through green to red (1), for an order in time. Clamped.
[[nodiscard]] Color rainbow(double at);
/// The n-th of eight colours that are easy to tell apart; repeats.
[[nodiscard]] Color distinct(int n);

namespace colors {
inline constexpr Color kWhite{255, 255, 255};
inline constexpr Color kBlack{0, 0, 0};
inline constexpr Color kInk{38, 42, 56};
inline constexpr Color kFloor{250, 248, 243};
inline constexpr Color kUnknown{214, 212, 206};
inline constexpr Color kGrey{140, 140, 145};
inline constexpr Color kRed{206, 48, 44};
inline constexpr Color kOrange{233, 132, 28};
inline constexpr Color kGreen{46, 139, 87};
inline constexpr Color kBlue{38, 98, 180};
inline constexpr Color kViolet{122, 62, 157};
}  // namespace colors

}  // namespace docent::pictures
