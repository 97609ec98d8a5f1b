#include "docent/task_control/mission_service/status_text.h"

#include <gtest/gtest.h>

namespace docent::task_control {
namespace {

using interaction::Sentence;

MissionSummary in(MissionPhase phase) {
  MissionSummary summary;
  summary.phase = phase;
  return summary;
}
MissionSummary to_place(MissionPhase phase, const std::string& place) {
  MissionSummary summary = in(phase);
  summary.is_point = true;
  summary.place = place;
  return summary;
}

TEST(StatusText, EachPhaseHasItsSentence) {
  EXPECT_EQ(sentence_of(in(MissionPhase::waking)), Sentence::waking);
  EXPECT_EQ(sentence_of(in(MissionPhase::relocalizing)), Sentence::relocalizing);
  EXPECT_EQ(sentence_of(in(MissionPhase::driving)), Sentence::driving);
  EXPECT_EQ(sentence_of(in(MissionPhase::explaining)), Sentence::explaining);
  EXPECT_EQ(sentence_of(in(MissionPhase::asking)), Sentence::asking);
  EXPECT_EQ(sentence_of(in(MissionPhase::charging)), Sentence::charging);
  EXPECT_EQ(sentence_of(in(MissionPhase::going_home)), Sentence::going_home);
  EXPECT_EQ(sentence_of(in(MissionPhase::idle)), Sentence::idle);
  EXPECT_EQ(sentence_of(in(MissionPhase::waiting)), Sentence::waiting);
}

TEST(StatusText, WhatIsInTheWayAndWhatIsMissingIsSaid) {
  MissionSummary summary = in(MissionPhase::driving);
  summary.is_blocked = true;
  EXPECT_EQ(sentence_of(summary), Sentence::blocked);
  summary = in(MissionPhase::going_home);
  summary.needs_charge = true;
  EXPECT_EQ(sentence_of(summary), Sentence::battery_low);
  summary = in(MissionPhase::charging);
  summary.needs_charge = true;
  EXPECT_EQ(sentence_of(summary), Sentence::charging) << "it is there";
  summary = in(MissionPhase::explaining);
  summary.says_farewell = true;
  EXPECT_EQ(sentence_of(summary), Sentence::farewell);
}

TEST(StatusText, WhatKeepsItFromChargingIsSaidWhereItMatters) {
  MissionSummary summary = in(MissionPhase::waiting);
  summary.charger_trouble = ReasonWord::charger_occupied;
  summary.charge_percent = 80;
  EXPECT_EQ(sentence_of(summary), Sentence::waiting) << "nobody need care";
  summary.needs_charge = true;
  summary.charge_percent = 14;
  EXPECT_EQ(sentence_of(summary), Sentence::charger_occupied);
  EXPECT_NE(status_text(summary, {}, "", "en").find("14 percent"), std::string::npos);
  summary.charger_trouble = ReasonWord::charger_no_current;
  EXPECT_EQ(sentence_of(summary), Sentence::charger_no_current);
  summary.phase = MissionPhase::explaining;
  EXPECT_EQ(sentence_of(summary), Sentence::explaining);
}

TEST(StatusText, PointsAndRoomsAreNoExhibits) {
  const std::string point = point_name({{1.0, 2.0}});
  EXPECT_EQ(sentence_of(to_place(MissionPhase::driving, point)), Sentence::to_point);
  EXPECT_EQ(sentence_of(to_place(MissionPhase::explaining, point)), Sentence::at_point);
  EXPECT_EQ(sentence_of(to_place(MissionPhase::driving, "clocks")), Sentence::driving);
  EXPECT_EQ(sentence_of(to_place(MissionPhase::explaining, "clocks")), Sentence::at_room);
  EXPECT_FALSE(is_about_room(to_place(MissionPhase::driving, point)));
  EXPECT_TRUE(is_about_room(to_place(MissionPhase::driving, "clocks")));
  EXPECT_FALSE(is_about_room(in(MissionPhase::driving)));
}

TEST(StatusText, NamesTheTitleInItsLanguage) {
  const museum::Translations title{{"en", "Clocks"}, {"de", "Uhren"}};
  EXPECT_NE(status_text(in(MissionPhase::driving), title, "", "en").find("Clocks"), std::string::npos);
  EXPECT_NE(status_text(in(MissionPhase::driving), title, "", "de").find("Uhren"), std::string::npos);
}

TEST(StatusText, ChargingSaysForHowLongAndNeverLessThanFiveMinutes) {
  MissionSummary summary = in(MissionPhase::charging);
  EXPECT_NE(status_text(summary, {}, "", "en").find(" 5 "), std::string::npos) << status_text(summary, {}, "", "en");
  summary.charging_min = 40;
  EXPECT_NE(status_text(summary, {}, "", "en").find(" 40 "), std::string::npos);
}

TEST(StatusText, SaysWhichTourBeginsSoonWhereThereIsNothingElseToSay) {
  const std::string tour = "The highlights, 14:00";
  EXPECT_EQ(status_text(in(MissionPhase::idle), {}, tour, "en"),
            "The next tour for everybody is the highlights, 14:00.");
  EXPECT_EQ(status_text(in(MissionPhase::driving), {{"en", "Clocks"}}, tour, "en").find("14:00"), std::string::npos);
}

}  // namespace
}  // namespace docent::task_control
