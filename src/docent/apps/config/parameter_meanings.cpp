#include "docent/apps/config/parameter_meanings.h"

#include <string_view>

namespace docent::apps::config_command {

namespace {

struct Meaning {
  std::string_view owner;
  std::string_view field;  ///< empty: the struct itself; "<": its visit lists the keys of the struct `meaning` as well
  std::string_view meaning;
};

/// From the headers, by parameter_meanings_generator.cpp.
constexpr Meaning kMeanings[] = {
#include "parameter_meanings.inc"
};

}  // namespace

std::string meaning_of(const std::string& owner, const std::string& field) {
  for (const Meaning& row : kMeanings)
    if (row.owner == owner && row.field == field) return std::string{row.meaning};
  for (const Meaning& row : kMeanings) {
    if (row.owner != owner || row.field != "<") continue;
    if (auto meaning = meaning_of(std::string{row.meaning}, field); !meaning.empty()) return meaning;
  }
  return "";
}

std::string meaning_of_struct(const std::string& owner) { return meaning_of(owner, ""); }

}  // namespace docent::apps::config_command
