#include "docent/evaluation/reference/number_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace docent::evaluation {
namespace {

/// One number of a line; false where there is none.
bool take_number(std::string_view& rest, double& value) {
  const std::size_t start = rest.find_first_not_of(" \t\r");
  if (start == std::string_view::npos) return false;
  rest.remove_prefix(start);
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc{} || !std::isfinite(value) || std::abs(value) > 1e12) return false;
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  return rest.empty() || rest.front() == ' ' || rest.front() == '\t' || rest.front() == '\r';
}

}  // namespace

Result<std::vector<std::vector<double>>> parse_number_lines(std::string_view text, const std::string& name,
                                                            const std::string& columns) {
  const auto count = static_cast<std::size_t>(std::count(columns.begin(), columns.end(), ' ')) + 1;
  std::vector<std::vector<double>> lines;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    std::string_view rest = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    rest = rest.substr(0, rest.find('#'));
    if (rest.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const std::string where = name + ":" + std::to_string(line);
    std::vector<double> numbers(count);
    for (double& number : numbers) {
      if (!take_number(rest, number)) return fail(where + ": expected " + columns);
    }
    if (rest.find_first_not_of(" \t\r") != std::string_view::npos) return fail(where + ": more than " + columns);
    if (std::abs(numbers[0]) > 9e9) return fail(where + ": the time is out of range");
    lines.push_back(std::move(numbers));
  }
  return lines;
}

}  // namespace docent::evaluation
