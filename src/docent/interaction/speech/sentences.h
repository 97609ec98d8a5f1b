#pragma once

#include <string>
#include <string_view>

namespace docent::interaction {

/// What the robot says and shows of itself, in the languages that have a dictionary; other languages get English.
enum class Sentence {
  waking,        ///< does not know yet where it is
  relocalizing,  ///< lost its place
  idle,          ///< at home, waits for visitors
  waiting,       ///< nothing to do just now, not at home
  driving,       ///< on its way to {title}
  blocked,       ///< on its way to {title}, people in the way
  explaining,    ///< talks about {title}
  asking,        ///< more about {title}, or next?
  going_home,
  battery_low,     ///< must charge, and is not at the charger yet
  charging,        ///< at the charger, for about {title} minutes more
  announcement,    ///< spoken when it sets out for {title}
  let_me_through,  ///< spoken when people block the way
  offer_more,      ///< spoken: more, or next?
  home_again,      ///< spoken on arrival at home
  must_charge,     ///< spoken when a visit or a tour is broken off for the battery
  at_charger,      ///< spoken on arrival at the charger
  help,            ///< spoken when somebody wants to know what to do ([Rhino1999] 5.1)
};
inline constexpr int kSentences = static_cast<int>(Sentence::help) + 1;

/// The sentence with `title` put in. Never empty.
[[nodiscard]] std::string sentence(Sentence which, std::string_view language, std::string_view title = {});

}  // namespace docent::interaction
