#pragma once

#include <string>
#include <string_view>

namespace docent {

/// What the robot says and shows of itself, in English and German; other languages get English.
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
  charging,        ///< at the charger or on the way to it
  announcement,    ///< spoken when it sets out for {title}
  let_me_through,  ///< spoken when people block the way
  offer_more,      ///< spoken: more, or next?
  home_again,      ///< spoken on arrival at home
};

/// The sentence with `title` put in. Never empty.
[[nodiscard]] std::string sentence(Sentence which, std::string_view language, std::string_view title = {});

}  // namespace docent
