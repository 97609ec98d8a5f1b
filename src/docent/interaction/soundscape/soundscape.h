#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/files.h"
#include "docent/base/time.h"
#include "docent/interaction/sound/loudspeaker.h"
#include "docent/interaction/soundscape/background_music.h"
#include "docent/interaction/soundscape/voice.h"
#include "docent/interaction/speech/speaker.h"

namespace docent::interaction {

/// What pages play besides speech, and how loud.
struct PlayedSound {
  double volume = 0.0;  ///< 0..1 of everything
  std::string music;    ///< its file; empty: none plays
  double music_volume = 0.0;
  Time music_start{};
  friend bool operator==(const PlayedSound&, const PlayedSound&) = default;
};

/// What there is to tell, in this order.
struct SoundNews {
  std::vector<Speech> lines;  ///< the last one is the newest
  std::optional<PlayedSound> sound;
};

/// What a soundscape is made with.
struct SoundscapeParts {
  std::filesystem::path checkpoint;  ///< of what was said
  std::filesystem::path audio;       ///< the folder of what is heard
  Survives survives = Survives::power_failure;
  SoundOutput output = SoundOutput::none;
  std::string place;  ///< the card's device, or the file's path
  MixerParams mix;
  bool makes_sound = true;  ///< else the words alone
  bool has_music = true;
  std::optional<std::filesystem::path> music;  ///< the museum's; nullopt: Docent's melody
  bool is_virtual_time = false;
};

/// All that the robot sounds like: it says one line after the other, honks, and plays music on its way; quietly, loudly
/// or not at all, as its museum wants to hear it. What is said outlives a restart.
class Soundscape {
 public:
  Soundscape(SoundscapeParts parts, SpeakerMemory memory, Time now);

  /// Without one the words remain.
  void set_voice(std::unique_ptr<LineVoice> voice) { voice_ = std::move(voice); }
  /// False: nothing is heard, so nothing need be rendered.
  [[nodiscard]] bool makes_sound() const { return parts_.makes_sound; }
  [[nodiscard]] bool has_loudspeaker() const { return loudspeaker_.is_there(); }

  /// All that is known at the start; a line that was being said goes on.
  [[nodiscard]] SoundNews begin(double volume, Time now);
  /// Several times a second. @param volume  0..1, as the museum wants it now
  [[nodiscard]] SoundNews step(double volume, Time now);
  /// Whoever orders a line again hears how it goes.
  [[nodiscard]] SoundNews say(const Say& line, Time now);
  /// The voice is done, or could not do it.
  [[nodiscard]] SoundNews rendered(const std::string& id, const Result<RenderedSpeech>& speech, Time now);
  void honk(Time now);
  /// Music plays while the robot drives, until somebody orders it.
  void drive(bool is_driving) { is_driving_ = is_driving; }
  void order_music(bool plays) { ordered_music_ = plays; }

  /// Why something is not heard as it should be; empty: all is.
  [[nodiscard]] std::string fault() const;

 private:
  /// The loudspeaker, which has played all until now.
  [[nodiscard]] Loudspeaker& at(Time now);
  [[nodiscard]] SoundNews begin_line(const std::string& audio, double duration_s, Time now);
  [[nodiscard]] SoundNews begin_silently(const Say& line, Time now);
  /// After a restart: the rest of the line.
  void go_on_speaking(Time now);
  void prepare_horn(Time now);
  void save();
  /// What pages play; nullopt: as it was told last.
  [[nodiscard]] std::optional<PlayedSound> news_of_sound();

  const SoundscapeParts parts_;
  Speaker speaker_;
  Loudspeaker loudspeaker_;
  BackgroundMusic music_;
  bool is_driving_ = false;
  std::optional<bool> ordered_music_;
  double volume_ = 1.0;
  std::optional<PlayedSound> told_sound_;
  SharedClip horn_;  ///< null: not made yet
  Time horn_tried_;
  std::string speech_fault_;
  std::string recording_fault_;
  std::string disk_fault_;
  std::string horn_fault_;
  std::unique_ptr<LineVoice> voice_;  ///< last: its thread ends first
};

}  // namespace docent::interaction
