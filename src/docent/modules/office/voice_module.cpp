#include "docent/modules/office/voice_module.h"

#include <optional>
#include <string>
#include <utility>

#include "docent/base/random.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/interaction/voice/voice_recognizer.h"
#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/modules/office/listening.h"
#include "docent/vocabulary/uuid.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

using interaction::Sentence;
using Command = interaction::VoiceCommand;

constexpr Duration kListenPeriod = std::chrono::milliseconds{100};
constexpr Duration kSayAgain = std::chrono::seconds{2};
constexpr const char* kSpoken = "en";  // the one language that there is a model for

/// Section `voice`: commands that are spoken.
struct VoiceModuleParams {
  bool enabled = false;                 ///< the robot has a microphone, and listens after a press of the button
  std::string input = "default";        ///< ALSA's name of the microphone, or a sound file that is heard at each press
  bool orders = false;                  ///< those of `office` may be spoken, too
  int button = 4;                       ///< 1..4: the coloured button to press before one speaks
  ListeningParams listening;            ///< when somebody has said all
  interaction::VoiceParams recognizer;  ///< what counts as understood
  template <class V>
  void visit(V& v) {
    v("enabled", enabled);
    v("input", input);
    v("orders", orders);
    v("button", button);
    v("listening", listening);
    v("recognizer", recognizer);
  }
  [[nodiscard]] Result<void> validate() const {
    if (button < 1 || button > kButtons) return fail("voice.button must be 1..4");
    if (auto valid = listening.validate(); !valid) return fail("voice.listening." + valid.error().message);
    if (!(recognizer.acts_above >= recognizer.asks_above))
      return fail("voice.recognizer.acts_above must be >= asks_above");
    return {};
  }
};

std::unique_ptr<interaction::Microphone> microphone_of(const std::string& input) {
  if (input.find('/') != std::string::npos) return interaction::file_microphone(input);
  return interaction::open_microphone(input);
}

class VoiceModule final : public Module {
 public:
  VoiceModule(const ModuleContext& context, const VoiceModuleParams& params, interaction::VoiceRecognizer recognizer)
      : bus_{context.bus},
        params_{params},
        recognizer_{std::move(recognizer)},
        listening_{params.listening, microphone_of(params.input)},
        rng_{Rng{context.seed}.stream("voice")},
        requests_{bus_.publisher(topics::kRequest)},
        choices_{bus_.publisher(topics::kChoice)},
        orders_{bus_.publisher(topics::kOfficeOrder)},
        say_{bus_.publisher(topics::kSay)} {
    bus_.subscribe<docent_msgs::Button>(topics::kButton, [this](const auto& button) {
      if (button.number == params_.button) listening_.press(bus_.now());
    });
    bus_.subscribe<docent_msgs::MissionState>(topics::kMissionState,
                                              [this](const auto& mission) { prompt_ = mission.prompt.id; });
    bus_.subscribe<docent_msgs::RequestBoard>(topics::kRequestBoard, [this](const auto& board) { read(board); });
    bus_.every(kListenPeriod, [this] { listen(); });
    bus_.every(kSayAgain, [this] {
      if (wish_) requests_.publish(*wish_);
    });
  }

  [[nodiscard]] ModuleHealth health() const override {
    return listening_.fault().empty() ? ModuleHealth{} : ModuleHealth{"degraded", listening_.fault()};
  }

 private:
  void listen() {
    const auto said = listening_.listen(bus_.now());
    if (!said || !listening_.fault().empty()) return;
    if (said->empty()) return say(Sentence::voice_not_understood, "");
    const auto heard = recognizer_.hear(*said);
    if (!heard || heard->verdict == interaction::HeardVoice::Verdict::nothing || !heard->command)
      return say(Sentence::voice_not_understood, "");
    if (heard->verdict == interaction::HeardVoice::Verdict::perhaps && perhaps_ != *heard->command) {
      perhaps_ = heard->command;  // said again, it is meant
      return say(Sentence::voice_perhaps, heard->words);
    }
    perhaps_.reset();
    obey(*heard->command);
  }

  void obey(const Command& command) {
    using Kind = Command::Kind;
    switch (command.kind) {
      case Kind::exhibit:
        return wish(RequestKind::exhibit, command.target);
      case Kind::tour:
        return wish(RequestKind::tour, command.target);
      case Kind::room:
        return wish(RequestKind::room, command.target);
      case Kind::more:
        return choose(Answer::more);
      case Kind::next:
        return choose(Answer::next);
      case Kind::end_tour:
        if (!tour_.empty()) wish(RequestKind::cancel, tour_);
        return;
      case Kind::deliver:
        return order("deliver", command.target);
      case Kind::tidy:
        return order("tidy", "");
      case Kind::confirm:
        return order("confirm", "");
    }
  }

  void wish(RequestKind kind, const std::string& target) {
    docent_msgs::Request request;
    request.id = make_uuid_v7(bus_.now(), rng_);
    request.stamp = to_message(bus_.now());
    request.source = to_text(RequestSource::visitor);
    request.kind = to_text(kind);
    request.target = target;
    request.language = kSpoken;
    wish_ = request;
    requests_.publish(request);
  }
  void choose(Answer answer) {
    if (prompt_.empty()) return;
    choices_.publish({make_uuid_v7(bus_.now(), rng_), prompt_, to_text(answer), to_text(RequestSource::visitor)});
  }
  void order(const char* kind, const std::string& room) {
    orders_.publish({make_uuid_v7(bus_.now(), rng_), kind, room, to_text(RequestSource::visitor)});
  }

  void read(const docent_msgs::RequestBoard& board) {
    tour_.clear();
    for (const docent_msgs::RequestState& entry : board.requests) {
      if (wish_ && entry.request.id == wish_->id) wish_.reset();
      const auto status = parse<RequestStatus>(entry.state);
      if (entry.request.kind == to_text(RequestKind::tour) && status && is_open(*status)) tour_ = entry.request.id;
    }
  }

  void say(Sentence which, const std::string& title) {
    say_.publish({"voice-" + std::to_string(++lines_), interaction::sentence(which, kSpoken, Mood::neutral, 0, title),
                  kSpoken, to_text(Mood::neutral)});
  }

  transport::Bus& bus_;
  VoiceModuleParams params_;
  interaction::VoiceRecognizer recognizer_;
  Listening listening_;
  Rng rng_;
  transport::Publisher<docent_msgs::Request> requests_;
  transport::Publisher<docent_msgs::Choice> choices_;
  transport::Publisher<docent_msgs::OfficeOrder> orders_;
  transport::Publisher<docent_msgs::Say> say_;
  std::optional<Command> perhaps_;            ///< that it has asked back
  std::optional<docent_msgs::Request> wish_;  ///< until it stands on the board
  std::string prompt_;                        ///< id of the question on show
  std::string tour_;                          ///< id of the request of the tour under way
  int lines_ = 0;
};

/// A robot without a microphone.
class NoVoice final : public Module {};

}  // namespace

Result<std::unique_ptr<Module>> make_voice(const ModuleContext& context) {
  auto params = context.config.section<VoiceModuleParams>("voice");
  if (!params) return tl::unexpected<Error>(params.error());
  if (!params->enabled) return std::make_unique<NoVoice>();
  auto recognizer = interaction::VoiceRecognizer::create(interaction::VoiceGrammar{context.museum, params->orders},
                                                         params->recognizer);
  if (!recognizer) return tl::unexpected<Error>(recognizer.error());
  return std::make_unique<VoiceModule>(context, *params, std::move(*recognizer));
}

Result<robot::ParameterRows> parameters_of_voice(const robot::RobotConfig& config) {
  return robot::list_parameters<VoiceModuleParams>(config, "voice");
}

}  // namespace docent::modules
