#include "docent/apps/arguments.h"

#include <cmath>
#include <cstdlib>

#include "docent/apps/command.h"

namespace docent {

std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  bool good = true;
  while (good) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    good = end != at && std::isfinite(number);
    numbers.push_back(number);
    at = end;
    if (*at != ',') break;
    ++at;
  }
  if (!good || *at != '\0' || numbers.size() != count) {
    throw CommandFailed{option + " " + text + ": expected " + std::to_string(count) + " numbers with commas between",
                        2};
  }
  return numbers;
}

Point2 parse_point(const std::string& option, const std::string& text) {
  const auto numbers = parse_numbers(option, text, 2);
  return {numbers[0], numbers[1]};
}

Pose2 parse_pose(const std::string& option, const std::string& text) {
  const auto numbers = parse_numbers(option, text, 3);
  return {numbers[0], numbers[1], Angle::degrees(numbers[2])};
}

}  // namespace docent
