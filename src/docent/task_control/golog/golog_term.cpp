#include "docent/task_control/golog/golog_term.h"

#include <cstdio>

namespace docent::task_control {

std::string to_text(const GologTerm& term) {
  std::string text = term.name;
  const char* before = "(";
  for (const auto& argument : term.arguments) {
    text += before;
    before = ", ";
    if (const auto* word = std::get_if<std::string>(&argument)) {
      text += *word;
    } else {
      char number[32];
      std::snprintf(number, sizeof number, "%.6g", std::get<double>(argument));
      text += number;
    }
  }
  return term.arguments.empty() ? text : text + ")";
}

}  // namespace docent::task_control
