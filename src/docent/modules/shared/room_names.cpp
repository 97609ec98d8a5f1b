#include "docent/modules/shared/room_names.h"

#include "docent/interaction/speech/sentences.h"

namespace docent::modules {

museum::Translations name_of(const mapping::Room& room, const std::vector<std::string>& languages) {
  using interaction::Sentence;
  if (room.number == 0) return room.name;
  const Sentence kind = room.kind == mapping::PlaceKind::hallway ? Sentence::hallway : Sentence::room;
  museum::Translations name;
  for (const std::string& language : languages)
    name[language] = interaction::sentence(kind, language, Mood::neutral, 0, std::to_string(room.number));
  return name;
}

}  // namespace docent::modules
