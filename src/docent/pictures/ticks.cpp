#include "docent/pictures/ticks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "docent/base/check.h"

namespace docent::pictures {
namespace {

constexpr double kRounding = 1e-6;  // of a step: 0.3 is a multiple of 0.1, whatever its last bit says

std::string power_of_ten(int exponent) {
  static constexpr std::array<const char*, 10> kDigits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) text += kDigits[static_cast<std::size_t>(digit - '0')];
  return text;
}

}  // namespace

std::vector<Tick> round_ticks(double low, double high, int most) {
  DOCENT_CHECK(std::isfinite(low) && std::isfinite(high) && low < high && most >= 2);
  int exponent = static_cast<int>(std::floor(std::log10((high - low) / most)));
  for (;; ++exponent) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double step = factor * std::pow(10.0, exponent);
      const double first = std::ceil(low / step - kRounding);
      const double last = std::floor(high / step + kRounding);
      if (last - first + 1.0 > most) continue;
      std::vector<Tick> ticks;
      for (double i = first; i <= last; ++i) {
        std::array<char, 40> label{};
        const double at = i == 0.0 ? 0.0 : i * step;  // no -0
        std::snprintf(label.data(), label.size(), "%.*f", std::max(0, -exponent), at);
        ticks.push_back({at, label.data()});
      }
      return ticks;
    }
  }
}

std::vector<Tick> power_ticks(double low, double high) {
  DOCENT_CHECK(0.0 < low && low < high);
  std::vector<Tick> ticks;
  const int last = static_cast<int>(std::floor(std::log10(high) + kRounding));
  for (int i = static_cast<int>(std::ceil(std::log10(low) - kRounding)); i <= last; ++i)
    ticks.push_back({std::pow(10.0, i), power_of_ten(i)});
  return ticks;
}

}  // namespace docent::pictures
