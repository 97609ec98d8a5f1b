#pragma once

#include <array>
#include <string>

#include "docent/vocabulary/vocabulary.h"

namespace docent::telepresence {

/// What somebody may do on the Web, each more than the one before: watch and make wishes; write in the forum, under a
/// name; moderate the forum; operate the robot.
enum class Rank { viewer, visitor, moderator, operator_ };
constexpr auto words_of(Rank) { return std::array{"viewer", "visitor", "moderator", "operator"}; }

/// Somebody on the Web.
struct Person {
  std::string id;    ///< "account:NAME" with an account, else drawn by lot; empty: a viewer, of whom nothing is known
  std::string name;  ///< that others see
  Rank rank = Rank::viewer;
  [[nodiscard]] bool is_at_least(Rank least) const { return rank >= least; }
};

}  // namespace docent::telepresence
