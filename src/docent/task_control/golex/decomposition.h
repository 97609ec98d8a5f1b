#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {

/// What the executive orders of the rest of the robot.
enum class DirectiveKind { look, horn, music, announce, drive, relocalize, dock, say, ask, wait };
[[nodiscard]] constexpr auto words_of(DirectiveKind) {
  return std::array{"look", "horn", "music", "announce", "drive", "relocalize", "dock", "say", "ask", "wait"};
}

/// When an item of an action is carried out.
enum class Condition { always, more, broken_off, moved, tour_begins };
[[nodiscard]] constexpr auto words_of(Condition) {
  return std::array{"always", "more", "broken_off", "moved", "tour_begins"};
}

struct Directive {
  DirectiveKind kind{};
  std::string argument;                        ///< as actions.yaml explains
  std::map<std::string, std::string> texts{};  ///< of say and announce, by language; empty: `argument` names a text
  std::string name{};                          ///< is used once in an action: for ids
  int use = 1;                                 ///< its number, from 1, among the action's directives of this name
};

/// What begins at once.
struct ActionItem {
  Condition condition = Condition::always;
  Mood mood = Mood::neutral;        ///< of its words
  std::vector<Directive> together;  ///< one of each kind at most
};

/// How each primitive action of a plan is divided into directives ([Rhino1999] 4.3 and Table 5): data, not code. The
/// built-in one is actions.yaml; a museum's file replaces single actions and adds others.
struct Decomposition {
  std::map<std::string, std::vector<ActionItem>, std::less<>> actions;  ///< by the kind of the task

  /// nullptr: there is no such action.
  [[nodiscard]] const std::vector<ActionItem>* find(const std::string& kind) const;
};

/// Whether an item that holds such a directive lasts until the directive is over.
[[nodiscard]] bool holds_up(DirectiveKind kind);
/// Whether one of the action's items from `first` on moves the robot.
[[nodiscard]] bool leads_somewhere(const std::vector<ActionItem>& action, std::size_t first);
/// The last drive among the action's first `count` items; nullptr: there is none.
[[nodiscard]] const Directive* last_drive(const std::vector<ActionItem>& action, std::size_t count);

[[nodiscard]] const Decomposition& default_decomposition();
/// The actions of the file over those of `base`. Error: "NAME:LINE: why".
[[nodiscard]] Result<Decomposition> parse_decomposition(const std::string& text, const std::string& name,
                                                        Decomposition base);

/// That of a museum: the built-in one under what the folder's golex.yaml says, if there is one. Error: names file and
/// line.
[[nodiscard]] Result<Decomposition> load_decomposition(const std::filesystem::path& folder);

}  // namespace docent::task_control
