#include "docent/museum/editing/museum_text.h"

#include <gtest/gtest.h>

#include "docent/base/yaml.h"

namespace docent::museum {
namespace {

const char* const kYaml = R"(# A small museum, surveyed by hand.
name: {en: "Small", de: "Klein"}
languages: [en, de]
map: map.yaml
area: [[0, 0], [9, 0], [9, 7], [0, 7]]  # the hall
# What no sensor sees.
hazards:
  - {id: case, kind: glass, polygon: [[3, 3], [4, 3], [4, 4]]}  # the clock stands in it
  - id: steps
    kind: stairs
    polygon: [[8, 1], [9, 1], [9, 2]]
# Where it waits.
home: {x: 1, y: 1, heading: 90}
exhibits:
  # The oldest thing here.
  - id: clock
    title: {en: "The clock", de: "Die Uhr"}
    pose: {x: 3.5, y: 2, heading: 90}   # in front of it
    look_at: {x: 3.5, y: 3.5}
    viewpoints:
      - {x: 2, y: 3.5, heading: 0}
      - {x: 4.8, y: 3.6, heading: 180}
    short: {en: texts/clock.en.md, de: texts/clock.de.md}
    next: [coin]
  - id: coin
    title: {en: "The coin", de: "Die Münze"}
    pose: {x: 7.5, y: 3.5, heading: 0}
    look_at: {x: 8.5, y: 3.5}
    short: {en: texts/coin.en.md, de: texts/coin.de.md}
    topics: [metal]
tours:
  - {id: all, title: {en: "All", de: "Alles"}, exhibits: [clock, coin]}
)";

Result<std::string> text_of(const std::filesystem::path& file) { return "What " + file.string() + " says.\n"; }

MuseumDraft draft_of_yaml(const std::string& yaml) {
  const auto file = YamlFile::parse(yaml, "museum.yaml");
  MuseumSource source = read_museum(*file, text_of);
  EXPECT_TRUE(source.faults.empty()) << source.faults.front().message;
  return draft_of(source.museum);
}

/// The new museum.yaml; "" where it need not be written.
std::string edited(const MuseumDraft& draft, const std::string& yaml = kYaml) {
  const auto result = edit_museum(yaml, text_of, draft);
  EXPECT_TRUE(result) << result.error().message;
  if (!result) return "";
  EXPECT_TRUE(result->faults.empty()) << result->faults.front().message;
  const auto museum = result->files.find("museum.yaml");
  return museum == result->files.end() ? "" : museum->second;
}

/// `text` with its first `from` replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(MuseumText, WritesNothingWhereNothingChanges) { EXPECT_EQ(edited(draft_of_yaml(kYaml)), ""); }

TEST(MuseumText, ANewHazardIsOneMoreLine) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  draft.hazards.push_back({"puddle", HazardKind::other, {{1.0, 5.0}, {2.0, 5.0}, {2.0, 6.1234}}});
  EXPECT_EQ(edited(draft),
            with(kYaml, "# Where it waits.",
                 "  - {id: puddle, kind: other, polygon: [[1, 5], [2, 5], [2, 6.123]]}\n# Where it waits."));
}

TEST(MuseumText, AMovedHazardLeavesTheOthersAsTheyAreWritten) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  draft.hazards[1].polygon[0] = {8.5, 1.25};
  EXPECT_EQ(edited(draft), with(kYaml, "  - id: steps\n    kind: stairs\n    polygon: [[8, 1], [9, 1], [9, 2]]\n",
                                "  - {id: steps, kind: stairs, polygon: [[8.5, 1.25], [9, 1], [9, 2]]}\n"));
  draft.hazards.clear();
  const std::string without = edited(draft);
  EXPECT_NE(without.find("\nhazards: []\n# Where it waits.\n"), std::string::npos) << without;
}

TEST(MuseumText, AMovedExhibitKeepsWhatTheEditorDoesNotKnow) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  draft.exhibits[0].pose.x = 3.25;
  draft.exhibits[0].viewpoints.pop_back();
  draft.exhibits[1].web_only = true;
  draft.tours[0].exhibits = {"clock"};
  std::string expected =
      with(kYaml, "pose: {x: 3.5, y: 2, heading: 90}   # in front of it", "pose: {x: 3.25, y: 2, heading: 90}");
  expected = with(expected, "      - {x: 4.8, y: 3.6, heading: 180}\n", "");
  expected = with(expected, "    topics: [metal]\n", "    topics: [metal]\n    web_only: true\n");
  // A tour must not name what is for the Web alone.
  expected = with(expected, "exhibits: [clock, coin]}", "exhibits: [clock]}");
  const std::string yaml = with(kYaml, "exhibits: [clock, coin]}", "exhibits: [clock]}");
  EXPECT_EQ(edited(draft, yaml), expected);
}

TEST(MuseumText, ATourAndItsTimesOfDayAreOneLine) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  draft.tours[0].daily = {9 * 60 + 5, 14 * 60};
  const std::string daily =
      with(kYaml, "{en: \"All\", de: \"Alles\"}, exhibits: [clock, coin]}",
           "{de: \"Alles\", en: \"All\"}, exhibits: [clock, coin], daily: [\"09:05\", \"14:00\"]}");
  EXPECT_EQ(edited(draft), daily);
  draft.tours.push_back({"quick", {{"en", "Quick: \"now\""}, {"de", "Kurz"}}, {}, 7.5, {}});
  EXPECT_EQ(edited(draft),
            daily + "  - {id: quick, title: {de: \"Kurz\", en: \"Quick: \\\"now\\\"\"}, minutes: 7.5}\n");
  draft.tours.clear();
  EXPECT_NE(edited(draft).find("tours: []\n"), std::string::npos);
}

TEST(MuseumText, NamesOfRoomsAreLinesOfTheirOwn) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  draft.rooms = {{"west", {{"en", "The west"}, {"de", "Der Westen"}}, {2.0, 3.5}}};
  const std::string west =
      std::string{kYaml} + "rooms:\n  - {id: west, name: {de: \"Der Westen\", en: \"The west\"}, at: {x: 2, y: 3.5}}\n";
  EXPECT_EQ(edited(draft), west);
  draft = draft_of_yaml(west);
  draft.rooms[0].at.x = 2.25;
  EXPECT_EQ(edited(draft, west), with(west, "at: {x: 2, y", "at: {x: 2.25, y"));
  draft.rooms.clear();
  EXPECT_NE(edited(draft, west).find("rooms: []\n"), std::string::npos);
}

TEST(MuseumText, HoursLeaveSpeedsAsTheyAreWritten) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  draft.hours["open"] = {"09:00-18:00"};
  draft.hours["web"] = {"18:30-21:30", "06:00-08:00"};
  EXPECT_EQ(edited(draft), std::string{kYaml} +
                               "modes:\n  open: {hours: [\"09:00-18:00\"]}\n"
                               "  web: {hours: [\"18:30-21:30\", \"06:00-08:00\"]}\n");
  const std::string modes = std::string{kYaml} +
                            "modes:\n  open: {max_speed: 0.6}\n  # at night\n"
                            "  web: {max_speed: 0.3, wait_s: 20, hours: [\"18:00-22:00\"]}\n";
  draft = draft_of_yaml(modes);
  draft.hours["web"].clear();
  draft.hours["closed"] = {"22:00-06:00"};
  EXPECT_EQ(edited(draft, modes), with(modes, "web: {max_speed: 0.3, wait_s: 20, hours: [\"18:00-22:00\"]}\n",
                                       "web: {max_speed: 0.3, wait_s: 20}\n  closed: {hours: [\"22:00-06:00\"]}\n"));
  draft.hours["open"] = {"nine to five"};
  const auto result = edit_museum(modes, text_of, draft);
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_FALSE(result->faults.empty());
}

TEST(MuseumText, HoursAndRoomsOfAFileThatIsNotInLines) {
  const std::string json =
      R"({name: {en: "S"}, languages: [en], map: map.yaml, area: [[0, 0], [9, 0], [9, 7]], home: {x: 1, y: 1, heading: 0},)"
      R"( exhibits: [], modes: {web: {wait_s: 20}}})";
  MuseumDraft draft = draft_of_yaml(json);
  draft.hours["web"] = {"18:00-22:00"};
  draft.rooms = {{"west", {{"en", "The west"}}, {2.0, 3.5}}};
  const auto file = YamlFile::parse(edited(draft, json), "museum.yaml");
  ASSERT_TRUE(file);
  const MuseumSource source = read_museum(*file, text_of);
  ASSERT_TRUE(source.faults.empty()) << source.faults.front().message;
  EXPECT_EQ(source.museum.modes.at("web").hours, draft.hours["web"]);
  EXPECT_EQ(source.museum.modes.at("web").wait_s, 20.0);
  EXPECT_EQ(source.museum.rooms.size(), 1U);
}

TEST(MuseumText, APictureIsNamedAndTakenAway) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  draft.exhibits[1].picture = "pictures/0123456789abcdef.jpg";
  const std::string shown =
      with(kYaml, "    topics: [metal]\n", "    topics: [metal]\n    picture: \"pictures/0123456789abcdef.jpg\"\n");
  EXPECT_EQ(edited(draft), shown);
  draft.exhibits[1].picture.clear();
  EXPECT_EQ(edited(draft, shown), kYaml);
}

TEST(MuseumText, ATourWithoutStopsOrAtATimeThatIsNoneHasAFault) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  draft.tours[0].exhibits.clear();
  auto result = edit_museum(kYaml, text_of, draft);
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_FALSE(result->faults.empty());
  EXPECT_NE(result->faults[0].message.find("needs either exhibits or minutes"), std::string::npos);
  draft = draft_of_yaml(kYaml);
  draft.tours[0].daily = {1440};
  result = edit_museum(kYaml, text_of, draft);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_FALSE(result->faults.empty());
}

TEST(MuseumText, AnExhibitGetsAndLosesLinks) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  draft.exhibits[1].links = {{{{"en", "More"}, {"de", "Mehr"}}, "https://example.org/coin"}};
  const std::string linked = with(kYaml, "    topics: [metal]\n",
                                  "    topics: [metal]\n    links: [{title: {de: \"Mehr\", en: \"More\"}, url: "
                                  "\"https://example.org/coin\"}]\n");
  EXPECT_EQ(edited(draft), linked);
  EXPECT_EQ(edited(draft_of_yaml(kYaml), linked), kYaml);
}

TEST(MuseumText, ANewExhibitComesWithItsTexts) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  Exhibit pump;
  pump.id = "pump";
  pump.title = {{"en", "The \"pump\": loud"}, {"de", "Die Pumpe"}};
  pump.pose = {5.0, 5.0, Angle::degrees(-45.04)};
  pump.look_at = {6.0, 6.0};
  pump.short_text = {{"en", "It pumps."}, {"de", "Sie pumpt."}};
  pump.topics = {"steam"};
  draft.exhibits.push_back(pump);
  const auto result = edit_museum(kYaml, text_of, draft);
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_TRUE(result->faults.empty()) << result->faults.front().message;
  EXPECT_EQ(result->files.at("content/pump.short.en.md"), "It pumps.\n");
  EXPECT_EQ(result->files.at("content/pump.short.de.md"), "Sie pumpt.\n");
  EXPECT_EQ(result->files.size(), 3U);
  const std::string& yaml = result->files.at("museum.yaml");
  EXPECT_NE(yaml.find("    topics: [metal]\n  - id: pump\n    title: "), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("tours:\n"), std::string::npos);
}

TEST(MuseumText, ANewTextGoesWhereTheOldOneIs) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  draft.exhibits[0].short_text["en"] = "It ticks.";
  const auto result = edit_museum(kYaml, text_of, draft);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->files, (FolderFiles{{"texts/clock.en.md", "It ticks.\n"}}));
}

TEST(MuseumText, AreaHomeAndCharger) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  draft.area[2] = {8.5, 7.0};
  draft.home.x = 1.5;
  draft.charger = Pose2{2.0, 1.0, Angle::degrees(45.0)};
  const std::string yaml = edited(draft);
  EXPECT_NE(yaml.find("\narea: [[0, 0], [9, 0], [8.5, 7], [0, 7]]\n# What no sensor sees.\n"), std::string::npos)
      << yaml;
  EXPECT_NE(yaml.find("\nhome: {x: 1.5, y: 1, heading: 90}\nexhibits:\n"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("\ncharger: {x: 2, y: 1, heading: 45}\n"), std::string::npos) << yaml;
  draft.charger.reset();
  EXPECT_EQ(edited(draft, yaml).find("charger"), std::string::npos);
}

TEST(MuseumText, WhatIsNotWrittenInLinesIsWrittenAnew) {
  const YAML::Node root = YAML::Load(kYaml);
  YAML::Emitter json;
  json << YAML::Flow << YAML::DoubleQuoted << root;
  const std::string flow = json.c_str();
  MuseumDraft draft = draft_of_yaml(flow);
  draft.hazards.pop_back();
  draft.exhibits[0].pose.y = 2.5;
  const std::string yaml = edited(draft, flow);
  EXPECT_TRUE(is_same(draft_of_yaml(yaml), draft)) << yaml;
  EXPECT_NE(yaml.find("next"), std::string::npos) << "what the editor does not know";
}

TEST(MuseumText, FaultsOfTheDraftAreNamedAndNothingIsToBeWritten) {
  MuseumDraft draft = draft_of_yaml(kYaml);
  draft.hazards[0].polygon = {{3.0, 3.0}, {4.0, 4.0}, {4.0, 3.0}, {3.0, 4.0}};
  auto result = edit_museum(kYaml, text_of, draft);
  ASSERT_TRUE(result);
  ASSERT_FALSE(result->faults.empty());
  EXPECT_NE(result->faults.front().message.find("crosses itself"), std::string::npos);

  for (const char* id : {"../../up", "a}, kind: glass", "Ä", ""}) {
    draft = draft_of_yaml(kYaml);
    draft.exhibits.push_back(draft.exhibits.back());
    draft.exhibits.back().id = id;
    result = edit_museum(kYaml, text_of, draft);
    EXPECT_TRUE(!result || !result->faults.empty()) << id;
  }
}

}  // namespace
}  // namespace docent::museum
