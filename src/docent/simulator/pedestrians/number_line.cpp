#include "docent/simulator/pedestrians/number_line.h"

#include <charconv>
#include <cmath>

namespace docent::simulator {

Result<std::vector<double>> numbers_of(std::string_view line) {
  constexpr std::string_view kBetween = " \t,";
  constexpr std::size_t kShown = 40;
  std::vector<double> numbers;
  while (true) {
    const std::size_t start = line.find_first_not_of(kBetween);
    if (start == std::string_view::npos) return numbers;
    line.remove_prefix(start);
    const std::string_view word = line.substr(0, line.find_first_of(kBetween));
    line.remove_prefix(word.size());
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) {
      return fail("'" + std::string{word.substr(0, kShown)} + "' where a number should be");
    }
    numbers.push_back(value);
  }
}

}  // namespace docent::simulator
