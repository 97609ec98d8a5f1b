#include "docent/museum/editing/museum_workshop.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "docent/base/files.h"
#include "docent/base/shipped_files.h"

namespace docent::museum {
namespace {

namespace fs = std::filesystem;

/// A copy of the museum of Bonn, and a place for trials.
class MuseumWorkshopTest : public testing::Test {
 protected:
  MuseumWorkshopTest() {
    fs::remove_all(root_);
    fs::create_directories(root_);
    fs::copy(shipped_path("museums/bonn"), root_ / "bonn", fs::copy_options::recursive);
  }
  ~MuseumWorkshopTest() override { fs::remove_all(root_); }

  [[nodiscard]] MuseumWorkshop workshop(const fs::path& folder) const { return {folder, root_ / "trial", {}}; }
  [[nodiscard]] MuseumWorkshop workshop() const { return workshop(root_ / "bonn"); }
  /// What is free of everything in Bonn.
  static Hazard puddle() { return {"puddle", HazardKind::other, {{9.0, 7.0}, {10.0, 7.0}, {10.0, 8.0}, {9.0, 8.0}}}; }

  fs::path root_ = fs::temp_directory_path() / ("docent-workshop-" + std::to_string(::getpid()));
};

TEST_F(MuseumWorkshopTest, TriesAndPublishes) {
  const auto before = workshop().read();
  ASSERT_TRUE(before) << before.error().message;
  MuseumDraft draft = draft_of(before->museum);
  draft.hazards.push_back(puddle());
  draft.exhibits[0].short_text["en"] = "Something new.";

  const auto tried = workshop().try_out(draft, before->revision);
  ASSERT_TRUE(tried) << tried.error().message;
  ASSERT_TRUE(tried->faults.empty()) << tried->faults.front();
  const auto trial = load_museum(root_ / "trial");
  ASSERT_TRUE(trial) << trial.error().message;
  EXPECT_EQ(trial->hazards.back().id, "puddle");
  EXPECT_EQ(trial->exhibits[0].short_text.at("en"), "Something new.\n");
  EXPECT_EQ(load_museum(root_ / "bonn")->hazards.size() + 1, trial->hazards.size()) << "what is published stays";

  const MuseumWorkshop inside = workshop(root_ / "trial");
  EXPECT_TRUE(inside.is_trial());
  EXPECT_EQ(inside.published(), root_ / "bonn");
  const auto now = inside.read();
  ASSERT_TRUE(now);
  EXPECT_EQ(now->museum.hazards.back().id, "puddle");
  const auto published = inside.publish(draft_of(now->museum), now->revision);
  ASSERT_TRUE(published) << published.error().message;
  ASSERT_TRUE(published->faults.empty()) << published->faults.front();
  const auto after = load_museum(root_ / "bonn");
  ASSERT_TRUE(after);
  EXPECT_EQ(after->hazards.back().id, "puddle");
  EXPECT_TRUE(fs::is_regular_file(root_ / "bonn" / "museum.yaml.before"));
  EXPECT_NE(workshop().read()->revision, before->revision);
}

TEST_F(MuseumWorkshopTest, RefusesWhatCannotWorkAndWritesNothing) {
  const auto before = workshop().read();
  const std::string yaml = *read_file(root_ / "bonn" / "museum.yaml");
  MuseumDraft draft = draft_of(before->museum);
  Hazard over_home = puddle();
  const Point2 home = draft.home.position();
  over_home.polygon = {
      {home.x - 1, home.y - 1}, {home.x + 1, home.y - 1}, {home.x + 1, home.y + 1}, {home.x - 1, home.y + 1}};
  draft.hazards.push_back(over_home);
  const auto faults = workshop().check(draft);
  ASSERT_TRUE(faults) << faults.error().message;
  ASSERT_EQ(faults->size(), 1U);
  EXPECT_EQ(faults->front(), "home lies inside the hazard 'puddle'");
  for (const auto& outcome :
       {workshop().try_out(draft, before->revision), workshop().publish(draft, before->revision)}) {
    ASSERT_TRUE(outcome);
    EXPECT_EQ(outcome->faults, *faults);
  }
  EXPECT_EQ(*read_file(root_ / "bonn" / "museum.yaml"), yaml);
  EXPECT_FALSE(fs::exists(root_ / "trial"));
  EXPECT_FALSE(fs::exists(root_ / "trial.check"));
  EXPECT_FALSE(fs::exists(root_ / "trial.next"));
}

TEST_F(MuseumWorkshopTest, WhoeverComesLateIsTold) {
  const auto before = workshop().read();
  MuseumDraft draft = draft_of(before->museum);
  draft.hazards.push_back(puddle());
  ASSERT_TRUE(workshop().publish(draft, before->revision)->faults.empty());
  EXPECT_TRUE(workshop().publish(draft_of(before->museum), before->revision)->is_outdated);
  EXPECT_TRUE(workshop().try_out(draft_of(before->museum), before->revision)->is_outdated);
  EXPECT_EQ(load_museum(root_ / "bonn")->hazards.back().id, "puddle");
}

TEST_F(MuseumWorkshopTest, ATextIsSomethingThatWhoeverComesLateMustNotUndo) {
  const auto before = workshop().read();
  MuseumDraft first = draft_of(before->museum);
  first.exhibits[0].short_text["en"] = "Something new.";
  ASSERT_TRUE(workshop().publish(first, before->revision)->faults.empty());
  MuseumDraft second = draft_of(before->museum);
  second.hazards.push_back(puddle());
  EXPECT_TRUE(workshop().publish(second, before->revision)->is_outdated);
  EXPECT_EQ(load_museum(root_ / "bonn")->exhibits[0].short_text.at("en"), "Something new.\n");
}

TEST_F(MuseumWorkshopTest, APictureIsKeptAndShownByTrialAndMuseum) {
  const auto picture = workshop().keep_picture("not looked at here", ".jpg");
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_EQ(picture->parent_path(), "pictures");
  EXPECT_EQ(*workshop().keep_picture("not looked at here", ".jpg"), *picture) << "the same once more is the same file";
  const auto before = workshop().read();
  MuseumDraft draft = draft_of(before->museum);
  draft.exhibits[0].picture = *picture;
  ASSERT_TRUE(workshop().try_out(draft, before->revision)->faults.empty());
  EXPECT_EQ(*read_file(root_ / "trial" / *picture), "not looked at here");
  ASSERT_TRUE(workshop(root_ / "trial").publish(draft, before->revision)->faults.empty());
  EXPECT_EQ(load_museum(root_ / "bonn")->exhibits[0].picture, *picture);
  draft.exhibits[0].picture = "pictures/none.jpg";
  const auto faults = workshop().check(draft);
  ASSERT_EQ(faults->size(), 1U);
  EXPECT_EQ(faults->front(), "pictures/none.jpg does not exist");
}

TEST_F(MuseumWorkshopTest, PicturesThatNobodyShowsMakeRoom) {
  const auto shown = workshop().keep_picture("shown", ".jpg");
  const auto before = workshop().read();
  MuseumDraft draft = draft_of(before->museum);
  draft.exhibits[0].picture = *shown;
  ASSERT_TRUE(workshop().publish(draft, before->revision)->faults.empty());
  for (int i = 0; i < 250; ++i) ASSERT_TRUE(workshop().keep_picture("picture " + std::to_string(i), ".jpg"));
  EXPECT_TRUE(fs::exists(root_ / "bonn" / *shown));
  const auto files = std::distance(fs::directory_iterator{root_ / "bonn" / "pictures"}, fs::directory_iterator{});
  EXPECT_LE(files, 200);
  // A folder full of pictures that are shown takes no more.
  std::string yaml = *read_file(root_ / "bonn" / "museum.yaml");
  for (const auto& entry : fs::directory_iterator{root_ / "bonn" / "pictures"})
    yaml += "# " + entry.path().filename().string() + "\n";
  for (int i = 0; fs::exists(root_ / "bonn" / *shown) && i < 250; ++i) {
    const auto kept = workshop().keep_picture("more " + std::to_string(i), ".jpg");
    if (!kept) break;
    yaml += "# " + kept->filename().string() + "\n";
    ASSERT_TRUE(write_file_atomically(root_ / "bonn" / "museum.yaml", yaml));
  }
  const auto full = workshop().keep_picture("one too many", ".jpg");
  ASSERT_FALSE(full);
  EXPECT_NE(full.error().message.find("more than 200 pictures"), std::string::npos) << full.error().message;
}

}  // namespace
}  // namespace docent::museum
