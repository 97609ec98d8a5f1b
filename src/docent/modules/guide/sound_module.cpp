#include "docent/modules/guide/sound_module.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "docent/interaction/speech/horn.h"
#include "docent/interaction/speech/loudspeaker.h"
#include "docent/interaction/speech/renderer.h"
#include "docent/interaction/speech/speaker.h"
#include "docent/interaction/speech/spoken_text.h"
#include "docent/messages/conversions.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds{100};
constexpr std::size_t kMostText = 20000;  ///< [bytes]

/// Section `sound`: speech.
struct SoundParams {
  std::string program = "espeak-ng";  ///< renders the speech; empty: the words alone
  double timeout_s = 15.0;            ///< [s] > 0 for one line
  std::string player;                 ///< plays a WAV file on the robot, for instance aplay; empty: the pages play it
  template <class V>
  void visit(V& v) {
    v("program", program);
    v("timeout_s", timeout_s);
    v("player", player);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(timeout_s > 0.0)) return fail("sound.timeout_s must be > 0");
    return {};
  }
};

/// Renders one line at a time on a thread of its own; a newer line ends the one before.
class RenderWorker {
 public:
  using Done = std::function<void(std::string id, Result<interaction::RenderedLine>)>;

  RenderWorker(const SoundParams& params, std::filesystem::path folder, Done done)
      : params_{params}, folder_{std::move(folder)}, done_{std::move(done)}, thread_{[this] { work(); }} {}
  RenderWorker(const RenderWorker&) = delete;
  RenderWorker& operator=(const RenderWorker&) = delete;
  ~RenderWorker() {
    {
      const std::scoped_lock lock{mutex_};
      is_ending_ = true;
      stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }

  void render(std::string id, interaction::SpokenLine line) {
    {
      const std::scoped_lock lock{mutex_};
      next_.emplace(std::move(id), std::move(line));
      stop_ = true;
    }
    wake_.notify_one();
  }

 private:
  void work() {
    while (true) {
      std::pair<std::string, interaction::SpokenLine> job;
      {
        std::unique_lock lock{mutex_};
        wake_.wait(lock, [this] { return is_ending_ || next_; });
        if (is_ending_) return;
        job = std::move(*next_);
        next_.reset();
        stop_ = false;
      }
      auto line = interaction::render_speech(job.second, folder_, params_.program, params_.timeout_s, stop_);
      if (!stop_) done_(std::move(job.first), std::move(line));
    }
  }

  SoundParams params_;
  std::filesystem::path folder_;
  Done done_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<std::pair<std::string, interaction::SpokenLine>> next_;
  bool is_ending_ = false;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

class SoundModule final : public Module {
 public:
  SoundModule(const ModuleContext& context, const SoundParams& params, interaction::SpeakerMemory memory)
      : bus_{context.bus},
        checkpoint_{context.state / "sound.json"},
        audio_{context.state / "audio"},
        makes_sound_{!context.virtual_time},
        survives_{context.virtual_time ? Survives::process_death : Survives::power_failure},
        speaker_{std::move(memory), bus_.now()},
        state_{bus_.publisher(topics::kSpeechState)},
        loudspeaker_{makes_sound_ ? params.player : ""} {
    if (makes_sound_ && !params.program.empty()) {
      // The worker outlives no module: what it posts late finds the guard gone.
      const std::weak_ptr<SoundModule*> guard = guard_;
      worker_ = std::make_unique<RenderWorker>(
          params, audio_, [&bus = bus_, guard](std::string id, Result<interaction::RenderedLine> line) {
            bus.post([guard, id = std::move(id), line = std::move(line)] {
              if (const auto self = guard.lock()) (*self)->on_rendered(id, line);
            });
          });
    }
    if (!speaker_.present().id.empty()) publish();
    bus_.subscribe<docent_msgs::Limits>(topics::kLimits,
                                        [this](const auto& limits) { volume_ = std::clamp(limits.volume, 0.0, 1.0); });
    bus_.subscribe<docent_msgs::Say>(topics::kSay, [this](const auto& say) { on_say(say); });
    bus_.subscribe<docent_msgs::Horn>(topics::kHorn, [this](const auto&) { honk(); });
    bus_.every(kPeriod, [this] {
      prepare_horn();
      if (!speaker_.finish_if_over(bus_.now())) return;
      save();
      publish();
    });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!speech_fault_.empty()) return {"degraded", speech_fault_};
    if (!disk_fault_.empty()) return {"degraded", disk_fault_};
    if (!horn_fault_.empty()) return {"degraded", horn_fault_};
    if (!loudspeaker_fault_.empty()) return {"degraded", loudspeaker_fault_};
    return {};
  }

 private:
  void on_say(const docent_msgs::Say& message) {
    if (message.id.empty() || message.text.size() > kMostText) return;
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
    if (worker_ && volume_ > 0.0) {
      worker_->render(say.id, {say.text, say.language, say.mood, volume_});
    } else {
      begin("", interaction::speech_duration(say.text, say.language, say.mood));
    }
  }

  void on_rendered(const std::string& id, const Result<interaction::RenderedLine>& line) {
    const auto& expected = speaker_.expected();
    if (!expected || expected->id != id) return;
    if (line) {
      speech_fault_.clear();
      begin(line->file, line->duration_s);
    } else {
      speech_fault_ = "no voice: " + line.error().message;
      begin("", interaction::speech_duration(expected->text, expected->language, expected->mood));
    }
  }

  void begin(const std::string& audio, double duration_s) {
    speaker_.begin(duration_s, audio, bus_.now());
    if (audio.empty()) {
      loudspeaker_.hush();
    } else {
      note(loudspeaker_.speak(audio_ / audio));
    }
    save();
    publish();
  }

  /// The horn's sound lies ready in the volume of the hour before it is needed: whoever hears of the horn may fetch it.
  void prepare_horn() {
    constexpr Duration kRetry = std::chrono::seconds{5};  // after a file that could not be written
    if (!makes_sound_ || volume_ <= 0.0 || (volume_ == horn_volume_ && horn_fault_.empty())) return;
    if (volume_ == horn_volume_ && bus_.now() - horn_tried_ < kRetry) return;
    horn_volume_ = volume_;
    horn_tried_ = bus_.now();
    const interaction::HornSound horn = interaction::horn_sound(volume_);
    horn_file_ = horn.file;
    const auto written = interaction::write_horn_sound(horn, audio_);
    horn_fault_ = written ? "" : "no horn: " + written.error().message;
  }
  void honk() {
    prepare_horn();
    if (!makes_sound_ || volume_ <= 0.0 || !horn_fault_.empty()) return;
    note(loudspeaker_.honk(audio_ / horn_file_));
  }
  void note(const Result<void>& played) {
    loudspeaker_fault_ = played ? "" : "no loudspeaker: " + played.error().message;
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

  /// Who orders a line again has not heard that it is over. The latched state stays that of the newest line.
  void publish_finished(const interaction::Say& say) {
    if (say.id == speaker_.present().id) {
      publish();
      return;
    }
    const auto now = to_message(bus_.now());
    state_.publish({{now, ""}, say.id, to_text(SpeechStatus::done), say.text, say.language, now, 0.0, ""});
    publish();
  }

  transport::Bus& bus_;
  std::filesystem::path checkpoint_;
  std::filesystem::path audio_;  ///< the folder of what is heard
  bool makes_sound_;             ///< not in virtual time
  Survives survives_;
  interaction::Speaker speaker_;
  transport::Publisher<docent_msgs::SpeechState> state_;
  interaction::Loudspeaker loudspeaker_;
  double volume_ = 1.0;
  Time horn_tried_;
  double horn_volume_ = 0.0;  ///< of `horn_file_`; 0: there is none yet
  std::string horn_file_;
  std::string speech_fault_;
  std::string disk_fault_;
  std::string horn_fault_;
  std::string loudspeaker_fault_;
  std::shared_ptr<SoundModule*> guard_ = std::make_shared<SoundModule*>(this);
  std::unique_ptr<RenderWorker> worker_;  ///< last: its thread ends first
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
