#include "docent/task_control/mission_service/status_text.h"

#include <algorithm>

#include "docent/task_control/tour_scheduler/programme.h"

namespace docent::task_control {

bool is_about_room(const MissionSummary& summary) { return summary.is_point && !point_of(summary.place); }

interaction::Sentence sentence_of(const MissionSummary& summary) {
  constexpr int kToldFrom = 30;  // [%] of the charge: with more nobody need care
  using interaction::Sentence;
  if (summary.phase == MissionPhase::waking) return Sentence::waking;
  if (summary.phase == MissionPhase::relocalizing) return Sentence::relocalizing;
  const bool is_room = is_about_room(summary);
  if (summary.is_point && summary.phase == MissionPhase::explaining)
    return is_room ? Sentence::at_room : Sentence::at_point;
  if (summary.is_point && !is_room && summary.phase == MissionPhase::driving) return Sentence::to_point;
  if (summary.phase == MissionPhase::driving) return summary.is_blocked ? Sentence::blocked : Sentence::driving;
  if (summary.says_farewell) return Sentence::farewell;
  if (summary.phase == MissionPhase::explaining) return Sentence::explaining;
  if (summary.phase == MissionPhase::asking) return Sentence::asking;
  const auto trouble = summary.charger_trouble.word();
  const bool is_told = summary.needs_charge || summary.charge_percent < kToldFrom;
  if (trouble == ReasonWord::charger_occupied && is_told) return Sentence::charger_occupied;
  if (trouble == ReasonWord::charger_no_current && is_told) return Sentence::charger_no_current;
  if (summary.phase == MissionPhase::charging) return Sentence::charging;
  if (summary.needs_charge) return Sentence::battery_low;
  if (summary.phase == MissionPhase::going_home) return Sentence::going_home;
  return summary.phase == MissionPhase::idle ? Sentence::idle : Sentence::waiting;
}

std::string status_text(const MissionSummary& summary, const museum::Translations& title, const std::string& daily_tour,
                        const std::string& language) {
  constexpr int kLeastMinutes = 5;
  const interaction::Sentence which = sentence_of(summary);
  const bool has_nothing_to_do = which == interaction::Sentence::idle || which == interaction::Sentence::waiting;
  if (has_nothing_to_do && !daily_tour.empty())
    return interaction::sentence(interaction::Sentence::tour_soon, language, Mood::neutral, 0, daily_tour);
  const bool is_of_charger =
      which == interaction::Sentence::charger_occupied || which == interaction::Sentence::charger_no_current;
  const std::string about = is_of_charger ? std::to_string(summary.charge_percent)
                            : summary.phase == MissionPhase::charging
                                ? std::to_string(std::max(kLeastMinutes, summary.charging_min))
                                : museum::translated(title, language);
  return interaction::sentence(which, language, Mood::neutral, 0, about);
}

}  // namespace docent::task_control
