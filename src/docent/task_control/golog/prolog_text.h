#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "docent/base/result.h"
#include "docent/task_control/golog/golog_term.h"

namespace docent::task_control {

// What a Prolog process is told: terms as text, which its reader takes for what they were, whatever they hold.
[[nodiscard]] std::string prolog_atom(const std::string& text);
[[nodiscard]] std::string prolog_string(const std::string& text);
/// @param value  finite
[[nodiscard]] std::string prolog_number(double value);
[[nodiscard]] std::string prolog_term(const GologTerm& term);
[[nodiscard]] std::string prolog_atoms(std::span<const std::string> texts);  ///< as a list
[[nodiscard]] std::string prolog_terms(std::span<const GologTerm> terms);    ///< likewise

/// What a Prolog process says: a text, a number, or a list. See `say/1` in prolog/host.pl:
///
///     s5:hello     a text and its characters
///     n2.5;        a number
///     l2:s1:an3;   a list and its length
struct PrologValue {
  std::variant<std::string, double, std::vector<PrologValue>> value;

  [[nodiscard]] const std::string* text() const { return std::get_if<std::string>(&value); }
  [[nodiscard]] const double* number() const { return std::get_if<double>(&value); }
  [[nodiscard]] const std::vector<PrologValue>* list() const { return std::get_if<std::vector<PrologValue>>(&value); }
  /// Element of a list; nullptr: there is none.
  [[nodiscard]] const PrologValue* at(std::size_t index) const;
};

/// Takes one value from the beginning of what has been read; nullopt: it has not come whole yet. Error: it is none.
[[nodiscard]] Result<std::optional<PrologValue>> take_value(std::string& read);

/// All elements as texts, numbers as they are written; empty for what is no list.
[[nodiscard]] std::vector<std::string> texts_of(const PrologValue& value);
/// Of a list of the name and the arguments.
[[nodiscard]] Result<GologTerm> term_of(const PrologValue& value);
[[nodiscard]] Result<std::vector<GologTerm>> terms_of(const PrologValue& value);

}  // namespace docent::task_control
