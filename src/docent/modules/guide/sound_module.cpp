#include "docent/modules/guide/sound_module.h"

#include <algorithm>
#include <atomic>

#include "docent/interaction/sound/horn.h"
#include "docent/interaction/sound/loudspeaker.h"
#include "docent/interaction/speech/render_worker.h"
#include "docent/interaction/speech/repertoire.h"
#include "docent/interaction/speech/speaker.h"
#include "docent/interaction/speech/spoken_text.h"
#include "docent/messages/conversions.h"
#include "docent/modules/guide/background_music.h"
#include "docent/modules/shared/museum_mode.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

constexpr Duration kSoundPeriod = std::chrono::milliseconds{100};
constexpr std::size_t kLongestSpeech = 20000;  ///< [bytes]

/// Section `sound`: speech, horn and music.
struct SoundParams {
  std::string program = "espeak-ng";  ///< renders the speech; empty: recordings, and the words alone
  double timeout_s = 15.0;            ///< [s] > 0 for one line; espeak-ng needs a hundredth of what saying it takes
  bool ahead = true;                  ///< renders in idle time all that the robot can say in this museum
  std::string output = "none";        ///< where the robot is heard: card, file, or none; the pages play it in any case
  std::string device = "default";     ///< ALSA's name of the card, for instance default or plughw:1
  std::string file;                   ///< where output file goes; empty: sound.wav in the state's folder
  bool music = true;                  ///< plays music while it drives, or when docent/music orders it
  interaction::MixerParams mix;       ///< how loud what is
  template <class V>
  void visit(V& v) {
    v("program", program);
    v("timeout_s", timeout_s);
    v("ahead", ahead);
    v("output", output);
    v("device", device);
    v("file", file);
    v("music", music);
    v("mix", mix);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(timeout_s > 0.0)) return fail("sound.timeout_s must be > 0");
    if (!parse<interaction::SoundOutput>(output)) return fail("sound.output must be none, card or file");
    if (auto valid = mix.validate(); !valid) return fail("sound." + valid.error().message);
    return {};
  }
};

class SoundModule final : public Module {
 public:
  SoundModule(const ModuleContext& context, const SoundParams& params, interaction::SpeakerMemory memory)
      : bus_{context.bus},
        params_{params},
        mode_{context},
        checkpoint_{context.state / "sound.json"},
        audio_{context.state / "audio"},
        is_virtual_time_{context.virtual_time},
        survives_{context.virtual_time ? Survives::process_death : Survives::power_failure},
        speaker_{std::move(memory), bus_.now()},
        state_{bus_.publisher(topics::kSpeechState)},
        sound_state_{bus_.publisher(topics::kSoundState)},
        loudspeaker_{output_of(context, params), place_of(context, params), params.mix, bus_.now()},
        makes_sound_{!context.virtual_time || loudspeaker_.is_there()},
        music_{context.museum.sound.music, audio_, context.virtual_time} {
    if (makes_sound_) prepare_voice(context.museum);
    if (!speaker_.present().id.empty()) publish();
    if (loudspeaker_.is_there()) go_on_speaking();
    volume_ = mode_.volume(bus_.now());
    publish_sound();
    subscribe();
  }

  [[nodiscard]] ModuleHealth health() const override {
    for (const std::string* fault : {&speech_fault_, &recording_fault_, &disk_fault_, &horn_fault_})
      if (!fault->empty()) return {"degraded", *fault};
    if (!music_.fault().empty()) return {"degraded", "no music: " + music_.fault()};
    const std::string silent = loudspeaker_.fault();
    if (!silent.empty()) return {"degraded", "no loudspeaker: " + silent};
    return {};
  }

 private:
  /// A card plays wall time alone.
  [[nodiscard]] static interaction::SoundOutput output_of(const ModuleContext& context, const SoundParams& params) {
    const auto output = parse<interaction::SoundOutput>(params.output).value_or(interaction::SoundOutput::none);
    const bool is_late = context.virtual_time && output == interaction::SoundOutput::card;
    return is_late ? interaction::SoundOutput::none : output;
  }
  [[nodiscard]] static std::string place_of(const ModuleContext& context, const SoundParams& params) {
    if (params.output != "file") return params.device;
    return params.file.empty() ? (context.state / "sound.wav").string() : params.file;
  }

  void prepare_voice(const museum::Museum& museum) {
    auto lines = interaction::repertoire(museum);
    interaction::LineRenderer renderer{params_.program, params_.timeout_s, audio_,
                                       interaction::Recordings{museum.folder, lines}};
    if (is_virtual_time_) {  // which knows no waiting: a line is rendered when it is ordered
      renderer_ = std::move(renderer);
      return;
    }
    if (!params_.ahead) lines.clear();
    // The worker outlives no module: what it posts late finds the guard gone.
    const std::weak_ptr<SoundModule*> guard = guard_;
    worker_ = std::make_unique<interaction::RenderWorker>(
        std::move(renderer), std::move(lines), loudspeaker_.is_there(),
        [&bus = bus_, guard](std::string id, Result<interaction::RenderedSpeech> speech) {
          bus.post([guard, id = std::move(id), speech = std::move(speech)] {
            if (const auto self = guard.lock()) (*self)->on_rendered(id, speech);
          });
        });
  }

  void subscribe() {
    bus_.subscribe<docent_msgs::Limits>(topics::kLimits, [this](const auto& limits) {
      mode_.limits(limits);
      step();
    });
    bus_.subscribe<docent_msgs::TaskState>(topics::kTaskState, [this](const auto& state) {
      is_driving_ = parse<TaskStatus>(state.state) == TaskStatus::driving;
      step();
    });
    bus_.subscribe<docent_msgs::Music>(topics::kMusic, [this](const auto& order) {
      ordered_music_ = order.plays;
      step();
    });
    bus_.subscribe<docent_msgs::Say>(topics::kSay, [this](const auto& say) { on_say(say); });
    bus_.subscribe<docent_msgs::Horn>(topics::kHorn, [this](const auto&) { honk(); });
    bus_.every(kSoundPeriod, [this] { step(); });
  }

  void step() {
    volume_ = mode_.volume(bus_.now());
    at_now().set_volume(volume_);
    prepare_horn();
    if (speaker_.finish_if_over(bus_.now())) {
      save();
      publish();
    }
    const bool wants_music = params_.music && makes_sound_ && volume_ > 0.0 && ordered_music_.value_or(is_driving_);
    if (music_.play(wants_music, bus_.now())) at_now().play_music(music_.is_playing() ? music_.clip() : nullptr);
    publish_sound();
  }

  /// The loudspeaker, which has played all until now.
  [[nodiscard]] interaction::Loudspeaker& at_now() {
    loudspeaker_.advance(bus_.now());
    return loudspeaker_;
  }

  void on_say(const docent_msgs::Say& message) {
    if (message.id.empty() || message.text.size() > kLongestSpeech) return;
    const interaction::Say say{message.id, interaction::spoken_text(message.text), message.language,
                               parse<Mood>(message.mood).value_or(Mood::neutral)};
    switch (speaker_.judge(say)) {
      case interaction::Speaker::Verdict::under_way:
        if (speaker_.present().id == say.id) publish();
        return;
      case interaction::Speaker::Verdict::finished:
        publish_finished(say);
        return;
      case interaction::Speaker::Verdict::fresh:
        break;
    }
    speaker_.expect(say);
    const interaction::SpokenLine line{say.text, say.language, say.mood};
    if (volume_ > 0.0 && worker_ && worker_->can_render(line)) {
      worker_->render(say.id, line);
    } else if (volume_ > 0.0 && renderer_ && renderer_->can_render(line)) {
      const std::atomic<bool> go_on{false};
      on_rendered(say.id, renderer_->render(line, true, go_on));
    } else {
      begin_silently(say);
    }
  }

  void on_rendered(const std::string& id, const Result<interaction::RenderedSpeech>& speech) {
    speech_fault_ = speech ? "" : "no voice: " + speech.error().message;
    const auto& expected = speaker_.expected();
    if (!expected || expected->id != id) return;
    if (!speech) return begin_silently(*expected);
    recording_fault_ = speech->fault;
    begin(speech->line.file, speech->line.duration_s);
    if (speech->clip) at_now().speak(speech->clip);
  }

  void begin_silently(const interaction::Say& say) {
    at_now().hush();
    begin("", interaction::speech_duration(say.text, say.language, say.mood));
  }
  void begin(const std::string& audio, double duration_s) {
    speaker_.begin(duration_s, audio, bus_.now());
    save();
    publish();
    publish_sound();
  }
  /// After a restart: the rest of the line.
  void go_on_speaking() {
    const interaction::Speech& speech = speaker_.present();
    if (!speech.is_speaking || speech.audio.empty()) return;
    auto clip = interaction::read_clip(audio_ / speech.audio);
    if (!clip) return;  // the words remain
    at_now().speak(std::make_shared<const interaction::Clip>(std::move(*clip)), to_seconds(bus_.now() - speech.start));
  }

  /// The horn's sound lies ready before it is needed: whoever hears of the horn may fetch it.
  void prepare_horn() {
    constexpr Duration kRetry = std::chrono::seconds{5};  // after a file that could not be written
    if (!makes_sound_ || volume_ <= 0.0 || (horn_ && horn_fault_.empty())) return;
    if (horn_ && bus_.now() - horn_tried_ < kRetry) return;
    horn_tried_ = bus_.now();
    interaction::Clip clip = interaction::horn_clip();
    const auto written = interaction::write_shared(interaction::shared_sound(clip), audio_);
    horn_fault_ = written ? "" : "no horn: " + written.error().message;
    horn_ = std::make_shared<const interaction::Clip>(std::move(clip));
  }
  void honk() {
    prepare_horn();
    if (horn_) at_now().honk(horn_);
  }

  void save() {
    auto saved = interaction::save_checkpoint(checkpoint_, speaker_.memory(), survives_);
    disk_fault_ = saved ? "" : saved.error().message;
  }

  void publish() {
    const interaction::Speech& speech = speaker_.present();
    state_.publish({{to_message(bus_.now()), ""},
                    speech.id,
                    to_text(speech.is_speaking ? SpeechStatus::speaking : SpeechStatus::done),
                    speech.text,
                    speech.language,
                    to_message(speech.start),
                    speech.duration_s,
                    speech.audio});
  }

  /// A line is ordered again by a module that has not heard that it is over. The latched state stays that of the newest
  /// line.
  void publish_finished(const interaction::Say& say) {
    if (say.id == speaker_.present().id) {
      publish();
      return;
    }
    const auto now = to_message(bus_.now());
    state_.publish({{now, ""}, say.id, to_text(SpeechStatus::done), say.text, say.language, now, 0.0, ""});
    publish();
  }

  /// What the pages play, and how loud; only what has changed.
  void publish_sound() {
    docent_msgs::SoundState sound;
    sound.volume = volume_;
    if (music_.is_playing()) {
      // Pages play speech as it is rendered and music as its file holds it: its level is brought to that of the mix.
      const double duck_db = speaker_.present().is_speaking ? params_.mix.duck_db : 0.0;
      const double gain_db = params_.mix.music_db - duck_db - music_.loudness_db();
      sound.music = music_.file();
      sound.music_volume = std::min(1.0, volume_ * interaction::from_db(gain_db));
      sound.music_start = to_message(music_.start());
    }
    auto bytes = encode_cdr(sound);
    if (bytes == published_sound_) return;
    published_sound_ = std::move(bytes);
    sound.header.stamp = to_message(bus_.now());
    sound_state_.publish(std::move(sound));
  }

  transport::Bus& bus_;
  SoundParams params_;
  MuseumMode mode_;
  std::filesystem::path checkpoint_;
  std::filesystem::path audio_;  ///< the folder of what is heard
  bool is_virtual_time_;
  Survives survives_;
  interaction::Speaker speaker_;
  transport::Publisher<docent_msgs::SpeechState> state_;
  transport::Publisher<docent_msgs::SoundState> sound_state_;
  std::vector<std::uint8_t> published_sound_;
  interaction::Loudspeaker loudspeaker_;
  bool makes_sound_;  ///< else the words alone: in virtual time, unless a file wants to hear them
  BackgroundMusic music_;
  bool is_driving_ = false;
  std::optional<bool> ordered_music_;  ///< by docent/music; nullopt: music follows the task
  double volume_ = 1.0;
  interaction::SharedClip horn_;  ///< null: not made yet
  Time horn_tried_;
  std::string speech_fault_;
  std::string recording_fault_;
  std::string disk_fault_;
  std::string horn_fault_;
  std::optional<interaction::LineRenderer> renderer_;  ///< in virtual time
  std::shared_ptr<SoundModule*> guard_ = std::make_shared<SoundModule*>(this);
  std::unique_ptr<interaction::RenderWorker> worker_;  ///< last: its thread ends first
};

}  // namespace

Result<std::unique_ptr<Module>> make_sound(const ModuleContext& context) {
  auto params = context.config.section<SoundParams>("sound");
  if (!params) return tl::unexpected<Error>(params.error());
  auto memory = interaction::load_speaker_checkpoint(context.state / "sound.json");
  return std::make_unique<SoundModule>(context, *params, memory.value_or(interaction::SpeakerMemory{}));
}

Result<robot::ParameterRows> parameters_of_sound(const robot::RobotConfig& config) {
  return robot::list_parameters<SoundParams>(config, "sound");
}

}  // namespace docent::modules
