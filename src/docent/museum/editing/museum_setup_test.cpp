#include "docent/museum/editing/museum_setup.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "docent/base/files.h"
#include "docent/museum/editing/museum_founding.h"
#include "docent/museum/editing/museum_workshop.h"

namespace docent::museum {
namespace {

namespace fs = std::filesystem;

/// A map of a room of 6 x 4 m, free but for its walls.
OccupancyGrid room() {
  OccupancyGrid map;
  map.frame = {120, 80, 0.05, {-1.0, -1.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      if (row < 2 || column < 2 || row >= map.frame.rows - 2 || column >= map.frame.columns - 2)
        map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
    }
  }
  return map;
}

class MuseumSetupTest : public testing::Test {
 protected:
  MuseumSetupTest() { fs::remove_all(root_); }
  ~MuseumSetupTest() override { fs::remove_all(root_); }

  void begin() { ASSERT_TRUE(MuseumSetup::begin(folder_, {})); }
  /// As the module `explore` does.
  void explore() const {
    fs::create_directories(state_ / "explored");
    ASSERT_TRUE(save_map(room(), state_ / "explored" / "map"));
  }
  /// What is drawn is published, as the page does it.
  void publish(const std::function<void(MuseumDraft&)>& draw) const {
    const MuseumWorkshop workshop{folder_, state_ / "trial", {}, Stage::being_set_up};
    const auto edition = workshop.read();
    ASSERT_TRUE(edition) << edition.error().message;
    MuseumDraft draft = draft_of(edition->museum);
    draw(draft);
    const auto outcome = workshop.publish(draft, edition->revision);
    ASSERT_TRUE(outcome) << outcome.error().message;
    ASSERT_TRUE(outcome->faults.empty()) << outcome->faults.front();
  }
  [[nodiscard]] Museum museum() const { return load_museum(folder_, Stage::being_set_up).value(); }
  static Hazard pane() { return {"pane", HazardKind::glass, {{3.0, 1.0}, {3.5, 1.0}, {3.5, 1.5}, {3.0, 1.5}}}; }
  static Exhibit globe() {
    Exhibit exhibit;
    exhibit.id = "globe";
    exhibit.title = exhibit.short_text = {{"en", "A globe"}, {"de", "Ein Globus"}};
    exhibit.pose = {1.0, 1.0, Angle{}};
    exhibit.look_at = {2.0, 1.0};
    return exhibit;
  }

  const fs::path root_ = fs::temp_directory_path() / ("docent-setup-" + std::to_string(::getpid()));
  const fs::path folder_ = root_ / "hall", state_ = root_ / "state";
  const MuseumSetup setup_{folder_, state_, {}};
};

TEST_F(MuseumSetupTest, FromNothingToTheFirstTour) {
  begin();
  EXPECT_EQ(setup_.read()->step, SetupStep::name);
  ASSERT_TRUE(setup_.name("The \"small\" hall", {"en", "de"}));
  EXPECT_EQ(setup_.read()->step, SetupStep::map);
  EXPECT_EQ(museum().name.at("de"), "The \"small\" hall");
  EXPECT_TRUE(contains(museum().area, {100.0, -100.0})) << "nobody knows yet where it ends";
  publish([](MuseumDraft& draft) { draft.hazards.push_back(pane()); });

  EXPECT_FALSE(setup_.has_explored());
  EXPECT_FALSE(setup_.keep_map());
  explore();
  EXPECT_TRUE(setup_.has_explored());
  ASSERT_TRUE(setup_.keep_map());
  EXPECT_EQ(setup_.read()->step, SetupStep::hazards);
  EXPECT_EQ(museum().hazards.size(), 1U) << "what was fenced before";
  EXPECT_EQ(map_hash(museum().map), map_hash(load_map(state_ / "explored" / "map.yaml").value()));
  EXPECT_FALSE(contains(museum().area, {100.0, -100.0}));
  EXPECT_TRUE(contains(museum().area, {4.8, 2.8}));

  ASSERT_TRUE(setup_.go(SetupStep::exhibits)->empty());
  EXPECT_FALSE(load_museum(folder_)) << "without an exhibit it is not complete";
  EXPECT_FALSE(setup_.go(SetupStep::tour)->empty());
  publish([](MuseumDraft& draft) { draft.exhibits.push_back(globe()); });
  ASSERT_TRUE(setup_.go(SetupStep::check)->empty());
  EXPECT_FALSE(setup_.go(SetupStep::done)->empty()) << "there was no tour";
  const auto why_not = setup_.go(SetupStep::tour);
  ASSERT_TRUE(why_not && why_not->empty()) << why_not->front();
  ASSERT_TRUE(setup_.go(SetupStep::done)->empty());
  const auto complete = load_museum(folder_);
  ASSERT_TRUE(complete) << complete.error().message;
  EXPECT_EQ(complete->tours.size(), 1U);
}

TEST_F(MuseumSetupTest, GoesOnWhereItWas) {
  begin();
  ASSERT_TRUE(setup_.name("Hall", {"en"}));
  explore();
  ASSERT_TRUE(setup_.keep_map());
  const auto again = MuseumSetup::begin(folder_, {5.0, 5.0, Angle{}});
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->step, SetupStep::hazards);
  EXPECT_EQ(again->start.x, 0.0) << "its map lies where it lay";
}

TEST_F(MuseumSetupTest, AnotherMapForgetsWhatWasDrawnOnTheOldOne) {
  begin();
  ASSERT_TRUE(setup_.name("Hall", {"en"}));
  explore();
  ASSERT_TRUE(setup_.keep_map());
  publish([](MuseumDraft& draft) { draft.hazards.push_back(pane()); });
  const auto why_not = setup_.go(SetupStep::map);
  EXPECT_FALSE(why_not->empty()) << "nothing is lost by accident";
  ASSERT_TRUE(setup_.map_again(std::nullopt));
  EXPECT_EQ(setup_.read()->step, SetupStep::map);
  EXPECT_TRUE(museum().hazards.empty());
  EXPECT_FALSE(setup_.has_explored());
  EXPECT_EQ(translated(museum().name, "en"), "Hall");
}

TEST_F(MuseumSetupTest, TouchesNoFolderThatSomebodyElseMade) {
  fs::create_directories(folder_);
  ASSERT_TRUE(write_file_atomically(folder_ / "thesis.tex", "years of work"));
  const auto begun = MuseumSetup::begin(folder_, {});
  ASSERT_FALSE(begun);
  EXPECT_NE(begun.error().message.find("neither empty nor"), std::string::npos) << begun.error().message;
  EXPECT_FALSE(fs::exists(folder_ / "museum.yaml"));
}

TEST_F(MuseumSetupTest, RefusesNamesAndLanguagesThatCannotBe) {
  begin();
  for (const auto& [name, languages] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"", {"en"}}, {" ", {"en"}}, {"Hall", {}}, {"Hall", {"xx"}}, {"Hall", {"en", "en"}}, {"\xff", {"en"}}}) {
    EXPECT_FALSE(setup_.name(name, languages)) << name;
    EXPECT_EQ(setup_.read()->step, SetupStep::name);
  }
}

TEST_F(MuseumSetupTest, NamesWhatIsWrongInItsFile) {
  begin();
  for (const auto& [text, word] : std::vector<std::pair<std::string, std::string>>{
           {"step: dance\nstart: {x: 0, y: 0, heading: 0}\n", "setup.yaml:1: unknown step 'dance'"},
           {"step: map\n", "start"},
           {"step: map\nstart: {x: a, y: 0, heading: 0}\n", "setup.yaml:2"},
           {"step: [", "setup.yaml"}}) {
    ASSERT_TRUE(write_file_atomically(folder_ / "setup.yaml", text));
    const auto progress = setup_.read();
    ASSERT_FALSE(progress) << text;
    EXPECT_NE(progress.error().message.find(word), std::string::npos) << progress.error().message;
  }
}

}  // namespace
}  // namespace docent::museum
