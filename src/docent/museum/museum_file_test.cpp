#include "docent/museum/museum_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "docent/base/files.h"
#include "docent/museum/museum.h"

namespace docent::museum {
namespace {

/// A folder with a copy of Bonn in it.
class MuseumFolder : public testing::Test {
 protected:
  MuseumFolder() : above_{std::filesystem::temp_directory_path() / ("docent-above-" + std::to_string(getpid()))} {
    std::filesystem::remove_all(above_);
    std::filesystem::create_directories(above_);
    std::filesystem::copy("museums/bonn", above_ / "bonn", std::filesystem::copy_options::recursive);
  }
  ~MuseumFolder() override { std::filesystem::remove_all(above_); }

  std::filesystem::path above_;
};

TEST_F(MuseumFolder, WhoNamesTheFolderAboveIsOfferedTheMuseumsInIt) {
  const auto one = load_museum(above_);
  ASSERT_FALSE(one);
  EXPECT_EQ(one.error().message,
            above_.string() + ": this folder has no museum.yaml; did you mean '" + (above_ / "bonn").string() + "'?");
  std::filesystem::create_directories(above_ / "hall");
  ASSERT_TRUE(write_file_atomically(above_ / "hall" / "museum.yaml", "name: {}\n"));
  const auto two = load_museum(above_);
  ASSERT_FALSE(two);
  EXPECT_EQ(two.error().message, above_.string() +
                                     ": this folder has no museum.yaml; did you mean one of the museums in "
                                     "it? (" +
                                     (above_ / "bonn").string() + ", " + (above_ / "hall").string() + ")");
}

TEST_F(MuseumFolder, AMuseumWithoutExhibitsHasOneFaultAndNotOneForEachStopOfATour) {
  const auto file = above_ / "bonn" / "museum.yaml";
  std::string text = read_file(file).value();
  const auto begin = text.find("exhibits:\n");
  text.replace(begin, text.find("modes:\n") - begin, "exhibits: []\n");
  ASSERT_TRUE(write_file_atomically(file, text));
  const auto faults = check_museum(above_ / "bonn", {});
  ASSERT_EQ(faults.size(), 1U) << faults[1].message;
  EXPECT_NE(faults[0].message.find("needs at least one exhibit"), std::string::npos) << faults[0].message;
}

/// What follows from a fault is not told beside it.
TEST_F(MuseumFolder, TheCauseIsToldAndNotWhatFollows) {
  const auto file = above_ / "bonn" / "museum.yaml";
  const std::string whole = read_file(file).value();
  const auto without = [&](const std::string& key, const std::string& next, const std::string& instead) {
    std::string text = whole;
    const auto begin = text.find("\n" + key) + 1;
    return text.replace(begin, text.find("\n" + next) + 1 - begin, instead);
  };
  struct Case {
    std::string yaml, cause;
  };
  const std::vector<Case> cases{
      {without("exhibits:", "modes:", "exhibits: 3\n"), "expected a list of exhibits"},
      {without("exhibits:", "modes:", ""), "missing key 'exhibits'"},
      {without("languages:", "map:", "languages: [en, de, french]\n"), "unknown language 'french'"},
      {without("languages:", "map:", ""), "missing key 'languages'"},
      {without("languages:", "map:", "languages: [en, de, fr, it]\n"), "language 'it' has no text anywhere"},
  };
  for (const Case& one : cases) {
    ASSERT_TRUE(write_file_atomically(file, one.yaml));
    const auto faults = check_museum(above_ / "bonn", {});
    ASSERT_FALSE(faults.empty()) << one.cause;
    EXPECT_EQ(faults.size(), 1U) << one.cause << ", but also: " << faults.back().message;
    EXPECT_NE(faults[0].message.find(one.cause), std::string::npos) << faults[0].message;
  }
}

TEST_F(MuseumFolder, WhileItIsSetUpATourMustNotNameWhatIsNotThere) {
  const auto file = above_ / "bonn" / "museum.yaml";
  std::string text = read_file(file).value();
  const auto begin = text.find("exhibits:\n");
  text.replace(begin, text.find("modes:\n") - begin, "exhibits: []\n");
  ASSERT_TRUE(write_file_atomically(file, text));
  const auto museum = load_museum(above_ / "bonn", Stage::being_set_up);
  ASSERT_FALSE(museum);
  EXPECT_NE(museum.error().message.find("unknown exhibit"), std::string::npos) << museum.error().message;
}

TEST_F(MuseumFolder, AMisspeltModeIsToldFromThoseThatThereAre) {
  const auto file = above_ / "bonn" / "museum.yaml";
  std::string text = read_file(file).value();
  text.replace(text.find("  closed: {max"), 8, "  cloesd");
  ASSERT_TRUE(write_file_atomically(file, text));
  const auto faults = check_museum(above_ / "bonn", {});
  ASSERT_FALSE(faults.empty());
  EXPECT_NE(faults[0].message.find("unknown mode 'cloesd'; did you mean 'closed'?"), std::string::npos)
      << faults[0].message;
}

}  // namespace
}  // namespace docent::museum
