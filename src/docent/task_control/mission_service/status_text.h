#pragma once

#include <string>

#include "docent/interaction/speech/sentences.h"
#include "docent/museum/museum.h"
#include "docent/task_control/mission/mission.h"

namespace docent::task_control {

/// What people are told of it.
[[nodiscard]] interaction::Sentence sentence_of(const MissionSummary& summary);
/// It is on its way to a room or there, not to a point on the map.
[[nodiscard]] bool is_about_room(const MissionSummary& summary);
/// One sentence for people, in that language.
/// @param title  of the exhibit or room that it is about
/// @param daily_tour  name and time of the tour that soon begins by itself, in that language; empty: none does
[[nodiscard]] std::string status_text(const MissionSummary& summary, const museum::Translations& title,
                                      const std::string& daily_tour, const std::string& language);

}  // namespace docent::task_control
