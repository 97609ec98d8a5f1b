#include "docent/modules/web/operators/recording_list.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "docent/base/files.h"

namespace docent::modules {
namespace {

namespace fs = std::filesystem;

TEST(RecordingList, NamesTextsOfExhibitsAndWhatIsRecorded) {
  const fs::path folder = fs::temp_directory_path() / ("docent-recording-list-" + std::to_string(::getpid()));
  fs::create_directories(folder / "content/audio/en");
  museum::Museum museum;
  museum.folder = folder;
  museum.languages = {"en"};
  museum.exhibits.resize(1);
  museum.exhibits[0].id = "clock";
  museum.exhibits[0].title = {{"en", "The clock"}};
  museum.exhibits[0].short_text = {{"en", "It ticks."}};
  for (const char* name : {"clock.short.ogg", "nobody.short.wav"})
    ASSERT_TRUE(write_file_atomically(folder / "content/audio/en" / name, "sound"));
  const auto list = recordings_of(museum);
  fs::remove_all(folder);
  ASSERT_EQ(list.recordings.size(), 1U);
  EXPECT_EQ(list.recordings[0].file, "content/audio/en/clock.short");
  EXPECT_TRUE(list.recordings[0].is_recorded);
  EXPECT_GT(list.lines, 10U);
  ASSERT_EQ(list.strays.size(), 1U);
  EXPECT_EQ(list.strays[0], "content/audio/en/nobody.short.wav");
}

}  // namespace
}  // namespace docent::modules
