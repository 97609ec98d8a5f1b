#include "docent/modules/guide/sound_module.h"

#include <memory>
#include <utility>

#include "docent/interaction/soundscape/sound_params.h"
#include "docent/interaction/soundscape/soundscape.h"
#include "docent/interaction/speech/repertoire.h"
#include "docent/interaction/speech/spoken_text.h"
#include "docent/messages/conversions.h"
#include "docent/modules/shared/museum_mode.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

constexpr Duration kSoundPeriod = std::chrono::milliseconds{100};
constexpr std::size_t kLongestSpeech = 20000;  ///< [bytes]

docent_msgs::SpeechState to_message(const interaction::Speech& speech, Time now) {
  return {{docent::to_message(now), ""},
          speech.id,
          to_text(speech.is_speaking ? SpeechStatus::speaking : SpeechStatus::done),
          speech.text,
          speech.language,
          docent::to_message(speech.start),
          speech.duration_s,
          speech.audio};
}

docent_msgs::SoundState to_message(interaction::PlayedSound sound, Time now) {
  return {{docent::to_message(now), ""},
          sound.volume,
          std::move(sound.music),
          sound.music_volume,
          docent::to_message(sound.music_start)};
}

interaction::SoundscapeParts parts_of(const ModuleContext& context, const interaction::SoundParams& params) {
  using interaction::SoundOutput;
  interaction::SoundscapeParts parts;
  parts.checkpoint = context.state / "sound.json";
  parts.audio = context.state / "audio";
  parts.survives = context.virtual_time ? Survives::process_death : Survives::power_failure;
  parts.output = parse<SoundOutput>(params.output).value_or(SoundOutput::none);
  // A card plays wall time alone.
  if (context.virtual_time && parts.output == SoundOutput::card) parts.output = SoundOutput::none;
  const std::string file = params.file.empty() ? (context.state / "sound.wav").string() : params.file;
  parts.place = params.output == "file" ? file : params.device;
  parts.mix = params.mix;
  // In virtual time the words alone, unless a file wants to hear them.
  parts.makes_sound = !context.virtual_time || parts.output != SoundOutput::none;
  parts.has_music = params.music;
  parts.music = context.museum.sound.music;
  parts.is_virtual_time = context.virtual_time;
  return parts;
}

class SoundModule final : public Module {
 public:
  SoundModule(const ModuleContext& context, const interaction::SoundParams& params, interaction::SpeakerMemory memory)
      : bus_{context.bus},
        mode_{context},
        state_{bus_.publisher(topics::kSpeechState)},
        sound_state_{bus_.publisher(topics::kSoundState)},
        soundscape_{parts_of(context, params), std::move(memory), bus_.now()} {
    if (soundscape_.makes_sound()) soundscape_.set_voice(voice_for(context, params));
    tell(soundscape_.begin(mode_.volume(bus_.now()), bus_.now()));
    subscribe();
  }

  [[nodiscard]] ModuleHealth health() const override {
    const std::string fault = soundscape_.fault();
    return fault.empty() ? ModuleHealth{} : ModuleHealth{"degraded", fault};
  }

 private:
  std::unique_ptr<interaction::LineVoice> voice_for(const ModuleContext& context,
                                                    const interaction::SoundParams& params) {
    auto lines = interaction::repertoire(context.museum);
    interaction::LineRenderer renderer{params.program, params.timeout_s, context.state / "audio",
                                       interaction::Recordings{context.museum.folder, lines}};
    if (context.virtual_time) return std::make_unique<interaction::PromptVoice>(std::move(renderer));
    if (!params.ahead) lines.clear();
    // The voice outlives no module: what it posts late finds the guard gone.
    const std::weak_ptr<SoundModule*> guard = guard_;
    return std::make_unique<interaction::WorkerVoice>(
        std::move(renderer), std::move(lines), soundscape_.has_loudspeaker(),
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
      soundscape_.drive(parse<TaskStatus>(state.state) == TaskStatus::driving);
      step();
    });
    bus_.subscribe<docent_msgs::Music>(topics::kMusic, [this](const auto& order) {
      soundscape_.order_music(order.plays);
      step();
    });
    bus_.subscribe<docent_msgs::Say>(topics::kSay, [this](const auto& say) { on_say(say); });
    bus_.subscribe<docent_msgs::Horn>(topics::kHorn, [this](const auto&) { soundscape_.honk(bus_.now()); });
    bus_.every(kSoundPeriod, [this] { step(); });
  }

  void step() { tell(soundscape_.step(mode_.volume(bus_.now()), bus_.now())); }

  void on_say(const docent_msgs::Say& message) {
    if (message.id.empty() || message.text.size() > kLongestSpeech) return;
    tell(soundscape_.say({message.id, interaction::spoken_text(message.text), message.language,
                          parse<Mood>(message.mood).value_or(Mood::neutral)},
                         bus_.now()));
  }

  void on_rendered(const std::string& id, const Result<interaction::RenderedSpeech>& speech) {
    tell(soundscape_.rendered(id, speech, bus_.now()));
  }

  void tell(interaction::SoundNews news) {
    for (const interaction::Speech& line : news.lines) state_.publish(to_message(line, bus_.now()));
    if (news.sound) sound_state_.publish(to_message(std::move(*news.sound), bus_.now()));
  }

  transport::Bus& bus_;
  MuseumMode mode_;
  transport::Publisher<docent_msgs::SpeechState> state_;
  transport::Publisher<docent_msgs::SoundState> sound_state_;
  std::shared_ptr<SoundModule*> guard_ = std::make_shared<SoundModule*>(this);
  interaction::Soundscape soundscape_;  ///< last: the thread of its voice ends first
};

}  // namespace

Result<std::unique_ptr<Module>> make_sound(const ModuleContext& context) {
  auto params = context.config.section<interaction::SoundParams>("sound");
  if (!params) return tl::unexpected<Error>(params.error());
  auto memory = interaction::load_speaker_checkpoint(context.state / "sound.json");
  return std::make_unique<SoundModule>(context, *params, memory.value_or(interaction::SpeakerMemory{}));
}

Result<robot::ParameterRows> parameters_of_sound(const robot::RobotConfig& config) {
  return robot::list_parameters<interaction::SoundParams>(config, "sound");
}

}  // namespace docent::modules
