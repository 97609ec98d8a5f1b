#include "docent/interaction/sound/sound_file.h"

#include <gtest/gtest.h>
#include <sndfile.h>
#include <unistd.h>

#include "docent/base/files.h"
#include "docent/interaction/sound/levels_for_test.h"

namespace docent::interaction::sound_file_test {
namespace {

class SoundFile : public testing::Test {
 protected:
  SoundFile() : folder_{std::filesystem::temp_directory_path() / ("docent_clip_" + std::to_string(getpid()))} {
    std::filesystem::create_directories(folder_);
  }
  ~SoundFile() override { std::filesystem::remove_all(folder_); }
  /// A sine of 1 kHz, -20 dB and one second, in each channel alike.
  std::filesystem::path write(const std::string& name, int format, int rate, int channels) const {
    const auto path = folder_ / name;
    SF_INFO info{};
    info.samplerate = rate;
    info.channels = channels;
    info.format = format;
    SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
    EXPECT_NE(file, nullptr) << sf_strerror(nullptr);
    std::vector<float> frames;
    for (int i = 0; i < rate; ++i) {
      const double value = std::numbers::sqrt2 * 0.1 * std::sin(2.0 * std::numbers::pi * 1000.0 * i / rate);
      frames.insert(frames.end(), static_cast<std::size_t>(channels), static_cast<float>(value));
    }
    EXPECT_EQ(sf_writef_float(file, frames.data(), rate), rate);
    sf_close(file);
    return path;
  }
  std::filesystem::path folder_;
};

TEST_F(SoundFile, ReadsWhatAMuseumMayBring) {
  for (const auto& path : {write("a.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 44100, 1),
                           write("b.wav", SF_FORMAT_WAV | SF_FORMAT_FLOAT, 22050, 2),
                           write("c.flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_24, 48000, 2),
                           write("d.OGG", SF_FORMAT_OGG | SF_FORMAT_VORBIS, 48000, 1),
                           write("e.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_U8, 8000, 1)}) {
    EXPECT_TRUE(is_sound_file(path));
    const auto duration = sound_duration(path);
    ASSERT_TRUE(duration) << duration.error().message;
    EXPECT_NEAR(*duration, 1.0, 0.01) << path;
    const auto clip = read_clip(path);
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_NEAR(duration_s(*clip), 1.0, 0.01) << path;
    std::vector<std::int16_t> samples;
    for (const float sample : *clip) samples.push_back(to_pcm(sample));
    const auto middle = part(samples, 0.2, 0.8);
    EXPECT_NEAR(level_db(middle), -20.0, 0.5) << path;
    EXPECT_NEAR(goertzel_db(middle, 1000.0), -20.0, 0.5) << path << ": another pitch";
  }
  EXPECT_FALSE(is_sound_file("a.mp4"));
  EXPECT_FALSE(is_sound_file("ogg"));
}

TEST_F(SoundFile, RefusesWhatIsNone) {
  EXPECT_FALSE(sound_duration(folder_ / "absent.wav"));
  ASSERT_TRUE(write_file_atomically(folder_ / "text.wav", "this is no sound at all"));
  EXPECT_FALSE(sound_duration(folder_ / "text.wav"));
  const auto fault = read_clip(folder_ / "text.wav");
  ASSERT_FALSE(fault);
  EXPECT_NE(fault.error().message.find("text.wav"), std::string::npos);
  const std::string whole = *read_file(write("a.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 22050, 1));
  for (std::size_t size = 0; size <= 44; ++size) {
    ASSERT_TRUE(write_file_atomically(folder_ / "cut.wav", whole.substr(0, size)));
    EXPECT_FALSE(sound_duration(folder_ / "cut.wav")) << size;
    EXPECT_FALSE(read_clip(folder_ / "cut.wav")) << size;
  }
  ASSERT_TRUE(write_file_atomically(folder_ / "half.wav", whole.substr(0, whole.size() / 2)));
  EXPECT_NEAR(sound_duration(folder_ / "half.wav").value_or(0.0), 0.5, 0.01) << "by what is there";
}

TEST_F(SoundFile, SharedSoundsAreNamedByTheirContent) {
  const SharedSound sound = shared_sound(sine(440.0, -20.0, 0.5));
  EXPECT_EQ(sound.file, shared_sound(sine(440.0, -20.0, 0.5)).file);
  EXPECT_NE(sound.file, shared_sound(sine(441.0, -20.0, 0.5)).file);
  ASSERT_TRUE(write_shared(sound, folder_ / "audio"));
  ASSERT_TRUE(write_shared(sound, folder_ / "audio")) << "writing it again changes nothing";
  const auto clip = read_clip(folder_ / "audio" / sound.file);
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_NEAR(duration_s(*clip), 0.5, 1e-3);
  EXPECT_NEAR(level_db(*clip), -20.0, 0.1);
  EXPECT_EQ(shared_name("abc", "Music.OGG").substr(16), ".ogg");
  const auto written = write_shared(sound, "/proc/nowhere");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("/proc/nowhere"), std::string::npos);
}

TEST_F(SoundFile, AGrowingFileIsWholeAtAnyMoment) {
  auto writer = WavWriter::create(folder_ / "mix.wav");
  ASSERT_TRUE(writer) << writer.error().message;
  const std::vector<std::int16_t> samples(kSampleRate, 1000);
  ASSERT_TRUE(writer->write(samples));
  ASSERT_TRUE(writer->write(samples));
  EXPECT_NEAR(sound_duration(folder_ / "mix.wav").value_or(0.0), 2.0, 0.1) << "as a killed process leaves it";
  EXPECT_FALSE(WavWriter::create("/proc/nowhere/mix.wav"));
}

}  // namespace
}  // namespace docent::interaction::sound_file_test
