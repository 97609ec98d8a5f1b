#pragma once

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace docent::apps::doctor_command {

enum class Verdict {
  fine,
  note,   ///< it will drive; a person should know
  wrong,  ///< it will not drive, or not as it should
};
[[nodiscard]] const char* to_text(Verdict verdict);

/// As printf has it; at most 239 letters.
template <class... Values>
[[nodiscard]] std::string text_of(const char* format, Values... values) {
  char text[240];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// One line of the page.
struct Finding {
  std::string section;  ///< files, base, computer
  std::string name;     ///< what was looked at
  Verdict verdict = Verdict::fine;
  std::string text;
  std::vector<std::pair<std::string, double>> figures{};  ///< for programs: name with unit, value
};

[[nodiscard]] Verdict worst_of(const std::vector<Finding>& findings);
/// For a person: a line each, under the names of the sections.
[[nodiscard]] std::string page_of(const std::vector<Finding>& findings);
/// For programs: {"verdict": …, "findings": [{"section", "name", "verdict", "text", "figures": {…}}]}
[[nodiscard]] std::string json_of(const std::vector<Finding>& findings);

}  // namespace docent::apps::doctor_command
