#include "docent/interaction/sound/microphone.h"

#include <gtest/gtest.h>

#include "docent/base/files.h"
#include "docent/interaction/sound/sound_file.h"

namespace docent::interaction::microphone_test {
namespace {

TEST(Microphone, AFileIsHeardAsFastAsItIsSpokenAndThenThereIsSilence) {
  const SharedSound sound = shared_sound(Clip(static_cast<std::size_t>(kSampleRate), 0.25F));
  const auto path = std::filesystem::path{testing::TempDir()} / "spoken.wav";
  ASSERT_TRUE(write_file_atomically(path, sound.content));
  const auto microphone = file_microphone(path);
  ASSERT_TRUE(microphone->begin(time_from_seconds(5.0)));
  EXPECT_TRUE(microphone->read(time_from_seconds(5.0))->empty());
  const auto half = microphone->read(time_from_seconds(5.5));
  ASSERT_TRUE(half);
  EXPECT_EQ(half->size(), static_cast<std::size_t>(kSampleRate / 2));
  EXPECT_NEAR(static_cast<double>(half->front()), 0.25, 0.001);
  const auto rest = microphone->read(time_from_seconds(7.0));
  EXPECT_EQ(rest->back(), 0.0F);
  ASSERT_TRUE(microphone->begin(time_from_seconds(9.0))) << "from its beginning";
  EXPECT_NEAR(static_cast<double>(microphone->read(time_from_seconds(9.1))->front()), 0.25, 0.001);
}

TEST(Microphone, ADeviceThatIsNotThereSaysWhich) {
  const auto begun = open_microphone("hw:77")->begin(time_from_seconds(1.0));
  ASSERT_FALSE(begun);
  EXPECT_NE(begun.error().message.find("microphone 'hw:77': "), std::string::npos);
  EXPECT_FALSE(file_microphone("/nowhere/at/all.wav")->begin(time_from_seconds(1.0)));
}

}  // namespace
}  // namespace docent::interaction::microphone_test
