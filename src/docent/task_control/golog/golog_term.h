#pragma once

#include <string>
#include <variant>
#include <vector>

namespace docent::task_control {

/// An action or an event of a GOLOG program: a name with arguments, `drive(e1)` or `battery(0.15)`.
struct GologTerm {
  std::string name;
  std::vector<std::variant<std::string, double>> arguments{};

  friend bool operator==(const GologTerm&, const GologTerm&) = default;
};

/// As a person reads it: "drive(tv-sat)". A program writes names that are no Prolog atoms in quotes: drive('tv-sat').
[[nodiscard]] std::string to_text(const GologTerm& term);

}  // namespace docent::task_control
