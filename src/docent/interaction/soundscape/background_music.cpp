#include "docent/interaction/soundscape/background_music.h"

#include <chrono>
#include <memory>
#include <utility>

#include "docent/interaction/sound/melody.h"
#include "docent/interaction/sound/sound_file.h"
#include "docent/interaction/speech/renderer.h"

namespace docent::interaction {

BackgroundMusic::Ready BackgroundMusic::read(const std::optional<std::filesystem::path>& file,
                                             const std::filesystem::path& folder) {
  Ready ready;
  Clip clip;
  if (file) {
    auto taken = take_recording(*file, folder);
    auto held = read_clip(*file);
    if (!taken || !held) return {{}, {}, 0.0, (taken ? held.error() : taken.error()).message};
    ready.file = std::move(taken->file);
    clip = std::move(*held);
  } else {
    clip = melody_clip();
    const SharedSound sound = shared_sound(clip);
    if (auto written = write_shared(sound, folder); !written) return {{}, {}, 0.0, written.error().message};
    ready.file = sound.file;
  }
  ready.loudness_db = interaction::loudness_db(clip);
  ready.clip = std::make_shared<const Clip>(std::move(clip));
  return ready;
}

bool BackgroundMusic::is_ready() {
  if (ready_.clip || !ready_.fault.empty()) return ready_.clip != nullptr;
  if (!reading_.valid()) reading_ = std::async(std::launch::async, read, file_, folder_);
  if (!is_virtual_time_ && reading_.wait_for(std::chrono::seconds{0}) != std::future_status::ready) return false;
  ready_ = reading_.get();
  return ready_.clip != nullptr;
}

bool BackgroundMusic::play(bool is_wanted, Time now) {
  const bool is_playing = is_wanted && is_ready();
  if (is_playing == is_playing_) return false;
  is_playing_ = is_playing;
  if (is_playing) start_ = now;
  return true;
}

}  // namespace docent::interaction
