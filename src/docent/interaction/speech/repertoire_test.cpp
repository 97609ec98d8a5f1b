#include "docent/interaction/speech/repertoire.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <set>

#include "docent/base/files.h"
#include "docent/interaction/sound/sound_file.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/interaction/speech/spoken_text.h"

namespace docent::interaction::repertoire_test {
namespace {

museum::Museum small_museum() {
  museum::Museum museum;
  museum.languages = {"en", "de"};
  museum::Exhibit clock;
  clock.id = "clock";
  clock.title = {{"en", "The clock"}, {"de", "Die Uhr"}};
  clock.short_text = {{"en", "# It *ticks*"}, {"de", "Sie tickt."}};
  museum::Exhibit coin = clock;
  coin.id = "coin";
  coin.long_text = {{"en", "More of it."}, {"de", "Noch mehr."}};
  museum.exhibits = {clock, coin};
  return museum;
}

const RepertoireLine* find(const std::vector<RepertoireLine>& lines, const std::string& name,
                           const std::string& language) {
  for (const RepertoireLine& line : lines) {
    if (line.name == name && line.line.language == language) return &line;
  }
  return nullptr;
}

TEST(Repertoire, HoldsWhatTheRobotSays) {
  const auto lines = repertoire(small_museum());
  ASSERT_NE(find(lines, "clock.short", "en"), nullptr);
  EXPECT_EQ(find(lines, "clock.short", "en")->line.text, "The clock. It ticks.");
  EXPECT_EQ(find(lines, "clock.long", "en"), nullptr) << "there is no more to tell";
  ASSERT_NE(find(lines, "coin.long", "de"), nullptr);
  EXPECT_EQ(find(lines, "coin.long", "de")->line.text, "Noch mehr.");
  ASSERT_NE(find(lines, "announcement.happy.1.clock", "en"), nullptr);
  EXPECT_EQ(find(lines, "announcement.happy.1.clock", "en")->line.text, "Please follow me to the clock.");
  EXPECT_EQ(find(lines, "announcement.happy.1.clock", "en")->line.mood, Mood::happy);
  ASSERT_NE(find(lines, "let_me_through.angry.2", "de"), nullptr);
  EXPECT_EQ(find(lines, "let_me_through.angry.2", "de")->line.text,
            sentence(Sentence::let_me_through, "de", Mood::angry, 1));
  EXPECT_EQ(find(lines, "waking.neutral.1", "en"), nullptr) << "that is shown and not spoken";
  std::set<std::pair<std::string, std::string>> names;
  for (const RepertoireLine& line : lines) {
    EXPECT_FALSE(line.line.text.empty()) << line.name;
    EXPECT_TRUE(names.emplace(line.line.language, line.name).second) << line.name << " stands twice";
  }
}

// A line that is ordered is read as Markdown once more: it must be found again.
TEST(Repertoire, ItsTextsAreAsTheyAreOrdered) {
  for (const char* folder : {"museums/bonn", "museums/smithsonian"}) {
    const auto museum = museum::load_museum(folder);
    ASSERT_TRUE(museum) << museum.error().message;
    const auto lines = repertoire(*museum);
    EXPECT_GT(lines.size(), 2 * 2 * museum->exhibits.size());
    for (const RepertoireLine& line : lines) EXPECT_EQ(spoken_text(line.line.text), line.line.text) << line.name;
  }
}

class RecordingsTest : public testing::Test {
 protected:
  RecordingsTest() : folder_{std::filesystem::temp_directory_path() / ("docent_recorded_" + std::to_string(getpid()))} {
    std::filesystem::create_directories(folder_ / "content/audio/en");
    std::filesystem::create_directories(folder_ / "content/audio/de");
    std::filesystem::create_directories(folder_ / "content/audio/fr");
  }
  ~RecordingsTest() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& content) const {
    ASSERT_TRUE(write_file_atomically(folder_ / "content/audio" / name, content));
  }
  std::filesystem::path folder_;
};

TEST_F(RecordingsTest, AreFoundByWhatIsSaid) {
  const std::string sound = shared_sound(Clip(kSampleRate, 0.25F)).content;
  write("en/clock.short.wav", sound);
  write("de/let_me_through.angry.2.FLAC", sound);
  write("en/clock.long.wav", sound);
  write("fr/clock.short.wav", sound);
  write("en/notes.txt", "who spoke when");
  const Recordings recordings{folder_, repertoire(small_museum())};
  EXPECT_EQ(recordings.count(), 2U);
  const auto* found = recordings.find("en", "The clock. It ticks.");
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(*found, folder_ / "content/audio/en/clock.short.wav");
  EXPECT_EQ(recordings.find("de", "The clock. It ticks."), nullptr) << "in that language only";
  EXPECT_NE(recordings.find("de", sentence(Sentence::let_me_through, "de", Mood::angry, 1)), nullptr);
  ASSERT_EQ(recordings.strays().size(), 2U) << "the clock has no long text, and the museum no French";
  EXPECT_EQ(recordings.strays()[0].filename(), "clock.long.wav");
  EXPECT_TRUE(recordings.faults().empty());
}

TEST_F(RecordingsTest, ThatCannotBePlayedAreNamed) {
  write("en/coin.long.ogg", "this is no sound at all");
  const Recordings recordings{folder_, repertoire(small_museum())};
  ASSERT_EQ(recordings.faults().size(), 1U);
  EXPECT_NE(recordings.faults()[0].message.find("coin.long.ogg"), std::string::npos);
}

TEST_F(RecordingsTest, AMuseumNeedsNone) {
  const Recordings none{"/nonexistent", repertoire(small_museum())};
  EXPECT_EQ(none.count(), 0U);
  EXPECT_TRUE(none.strays().empty());
  EXPECT_TRUE(none.faults().empty());
}

}  // namespace
}  // namespace docent::interaction::repertoire_test
