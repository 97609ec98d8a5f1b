#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "docent/vocabulary/vocabulary.h"

namespace docent::interaction {

/// What the robot says and shows of itself, in the languages that have a dictionary; other languages get English.
enum class Sentence {
  // shown on the page
  waking,        ///< does not know yet where it is
  relocalizing,  ///< lost its place
  idle,          ///< at home, waits for visitors
  waiting,       ///< nothing to do just now, not at home
  tour_soon,     ///< has nothing to do, and soon a daily tour begins: {title} has its name and its time
  driving,       ///< on its way to {title}
  blocked,       ///< on its way to {title}, people in the way
  to_point,      ///< on its way to a point on the map for which a visitor on the Web wished
  at_point,      ///< looks round there
  at_room,       ///< has come to the room {title}, as somebody wished
  room,          ///< what a room without a name is called: its number is {title}
  hallway,       ///< likewise
  explaining,    ///< talks about {title}
  asking,        ///< more about {title}, or next?
  going_home,
  battery_low,         ///< must charge, and is not at the charger yet
  charging,            ///< at the charger, for about {title} minutes more
  charger_occupied,    ///< must charge, and something stands on its charger; its charge is {title} %
  charger_no_current,  ///< must charge, and its charger gives no current; likewise
  // spoken
  tour_announced,  ///< some minutes before a daily tour begins; likewise
  announcement,    ///< when it sets out for {title}
  let_me_through,  ///< when people block the way: politely (happy), pleading (sad), angrily
  offer_more,      ///< more, or next?
  home_again,      ///< on arrival at home
  must_charge,     ///< when a visit or a tour is broken off for the battery
  at_charger,      ///< on arrival at the charger
  free_charger,    ///< before a charger on which something stands: to whoever can make room, or call the staff
  mend_charger,    ///< at a charger that gives no current: to whoever can call the staff
  stay_behind,     ///< to people who walk ahead of the robot or crowd round it: they shall walk behind it
  step_back,       ///< to people all round a robot that does not know where it is: they hide what it looks for
  greeting,        ///< when a tour begins
  next_exhibit,    ///< in a tour: {title} comes next
  farewell,        ///< when a tour is over
  help,            ///< what the robot is and how one asks it for something ([Rhino1999] 5.1 (1))
  // spoken in an office, and to whoever speaks to it
  office_delivery,       ///< with something for {title}, where it has come to
  office_put_in,         ///< before what it points at
  office_thanks,         ///< when somebody has done what it asked for
  office_empty,          ///< when its bin is to be emptied
  office_tidy,           ///< when it has seen all of the floor
  office_bin_full,       ///< when nobody has emptied it
  office_no_way,         ///< to {title}, to which it had something to bring
  voice_perhaps,         ///< when it has perhaps understood {title}: it asks back
  voice_not_understood,  ///< when somebody has said something that is no command
  // spoken to attract people, from friendly to upset ([Minerva2000] Fig. 15)
  attract_invitation,  ///< "Come over"
  attract_question,    ///< "Do you like robots?"
  attract_complaint,
  attract_demand,
};
inline constexpr int kSentences = static_cast<int>(Sentence::attract_demand) + 1;

/// By its key in the dictionaries; nullopt: there is no such sentence.
[[nodiscard]] std::optional<Sentence> find_sentence(std::string_view key);
/// Its key in the dictionaries, and its name in the names of recordings.
[[nodiscard]] const char* to_text(Sentence which);
[[nodiscard]] constexpr bool is_spoken(Sentence which) { return which >= Sentence::tour_announced; }

/// What the robot says to attract people so; nullopt: nothing.
[[nodiscard]] std::optional<Sentence> sentence_of(SpeechAct act);

/// The sentence with `title` put in, in the words of the mood; where a dictionary has none for it, in those of the
/// neutral mood, else in those of any mood that it has. Of several ways to say it number `variant` modulo their count,
/// so a caller may simply count. Never empty. @pre variant >= 0
[[nodiscard]] std::string sentence(Sentence which, std::string_view language, Mood mood, int variant,
                                   std::string_view title = {});
/// How many ways there are to say it in these words, at least 1.
[[nodiscard]] int count_variants(Sentence which, std::string_view language, Mood mood);

}  // namespace docent::interaction
