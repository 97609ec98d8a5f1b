#include "docent/task_control/mission_service/museum_programme.h"

#include <gtest/gtest.h>

#include "docent/interaction/speech/spoken_text.h"

namespace docent::task_control {
namespace {

/// A hall of 10 m x 5 m with a wall across its middle that leaves a door of 1 m at the lower end.
museum::Museum hall() {
  museum::Museum museum;
  museum.languages = {"en", "de"};
  museum.home = {1.0, 1.0, {}};
  museum.charger = Pose2{2.0, 1.0, {}};
  museum.exhibits.resize(2);
  museum.exhibits[0].id = "sputnik";
  museum.exhibits[0].pose = {2.0, 4.0, {}};
  museum.exhibits[0].title = {{"en", "Sputnik"}, {"de", "Sputnik"}};
  museum.exhibits[0].short_text = {{"en", "It **beeped**."}, {"de", "Es machte lange Zeit und immer wieder Piep."}};
  museum.exhibits[0].viewpoints = {{3.0, 4.0, {}}};
  museum.exhibits[1].next = {"sputnik"};
  museum.exhibits[1].id = "v2";
  museum.exhibits[1].pose = {8.0, 4.0, {}};
  museum.exhibits[1].title = {{"en", "V2"}};
  museum.exhibits[1].long_text = {{"en", "A long story of a rocket."}};
  museum.exhibits[1].web_only = true;
  museum.tours = {{"space", {}, {"sputnik", "v2"}, std::nullopt}, {"quick", {}, {}, 6.0}};
  return museum;
}

museum::Museum hall_with_map() {
  museum::Museum museum = hall();
  museum.map.frame = {200, 100, 0.05, {0.0, 0.0}};
  museum.map.cells.assign(museum.map.frame.size(), OccupancyGrid::kOccupied);
  for (int row = 1; row < 99; ++row) {
    for (int column = 1; column < 199; ++column) {
      const bool is_wall = column > 97 && column < 103 && row > 20;
      if (!is_wall) museum.map.cells[museum.map.frame.index({column, row})] = OccupancyGrid::kFree;
    }
  }
  museum.area = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 5.0}, {0.0, 5.0}};
  return museum;
}

TEST(MuseumProgramme, HoldsWhatTheMuseumOffers) {
  const Programme programme = programme_of(hall());
  EXPECT_EQ(programme.languages, (std::vector<std::string>{"en", "de"}));
  EXPECT_EQ(programme.home.x, 1.0);
  ASSERT_TRUE(programme.charger);
  EXPECT_EQ(programme.charger->x, 2.0);
  ASSERT_EQ(programme.exhibits.size(), 2U);
  EXPECT_EQ(programme.exhibits[0].place(0).x, 3.0);
  EXPECT_EQ(programme.exhibits[1].next, std::vector<std::string>{"sputnik"});
  EXPECT_FALSE(programme.exhibits[0].web_only);
  EXPECT_TRUE(programme.exhibits[1].web_only);
  ASSERT_EQ(programme.tours.size(), 2U);
  EXPECT_EQ(programme.tours[0].target_s, 0.0);
  EXPECT_EQ(programme.tours[1].target_s, 360.0);
}

TEST(MuseumProgramme, KnowsHowLongEachLanguageTakes) {
  const Programme programme = programme_of(hall());
  const ProgrammeExhibit& sputnik = programme.exhibits[0];
  const double spoken = interaction::speech_duration("Sputnik. It beeped.", "en", Mood::neutral);
  EXPECT_NEAR(sputnik.speech_s, spoken, 0.2) << "without the marks of Markdown";
  EXPECT_EQ(sputnik.length_in("en").short_s, sputnik.speech_s);
  EXPECT_GT(sputnik.length_in("de").short_s, sputnik.speech_s + 1.0);
  EXPECT_GT(programme.exhibits[1].long_s, 1.0);
  EXPECT_GT(programme.farewell_s, 0.5);
}

TEST(MuseumProgramme, AMuseumWithoutLanguagesSpeaksTheProgrammesOwn) {
  museum::Museum museum = hall();
  museum.languages.clear();
  EXPECT_EQ(programme_of(museum).languages, Programme{}.languages);
}

TEST(MuseumProgramme, WithAMapItKnowsWhereThereIsRoom) {
  const Rooms rooms{{{"clocks", {1.0, 1.0}}}};
  const Programme programme =
      programme_on_map(hall_with_map(), ways_in(hall_with_map(), 0.3), [&]() -> const Rooms& { return rooms; });
  ASSERT_TRUE(programme.has_room);
  EXPECT_TRUE(programme.has_room({2.0, 2.0}));
  EXPECT_FALSE(programme.has_room({5.0, 4.0})) << "in the wall";
  EXPECT_FALSE(programme.has_room({0.2, 2.0})) << "a robot is wider";
  ASSERT_TRUE(programme.rooms);
  EXPECT_EQ(programme.rooms().rooms.front().id, "clocks");
  const Programme without = programme_on_map(hall(), ways_in(hall(), 0.3), [&]() -> const Rooms& { return rooms; });
  EXPECT_FALSE(without.has_room);
  EXPECT_FALSE(without.rooms);
}

TEST(MuseumProgramme, TravelGoesRoundWalls) {
  const Point2 from{2.0, 4.0};
  const Point2 to{8.0, 4.0};
  EXPECT_DOUBLE_EQ(travel_by(ways_in(hall(), 0.3))(from, to), 6.0) << "as the crow flies";
  EXPECT_GT(travel_by(ways_in(hall_with_map(), 0.3))(from, to), 8.0) << "through the door";
}

}  // namespace
}  // namespace docent::task_control
