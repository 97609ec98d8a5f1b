#include "docent/modules/web/web_module.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "docent/base/files.h"
#include "docent/base/shipped_files.h"
#include "docent/interaction/sound/horn.h"
#include "docent/messages/conversions.h"
#include "docent/modules/shared/museum_mode.h"
#include "docent/modules/web/camera_desk.h"
#include "docent/modules/web/count_desk.h"
#include "docent/modules/web/foxglove_desk.h"
#include "docent/modules/web/inside_desk.h"
#include "docent/modules/web/live_desk.h"
#include "docent/modules/web/operators/maps_desk.h"
#include "docent/modules/web/operators/offices.h"
#include "docent/modules/web/operators/operator_desk.h"
#include "docent/modules/web/room_documents.h"
#include "docent/modules/web/screen_desk.h"
#include "docent/modules/web/slots.h"
#include "docent/modules/web/vote_desk.h"
#include "docent/modules/web/web_params.h"
#include "docent/modules/web/web_store.h"
#include "docent/modules/web/wish_desk.h"
#include "docent/telepresence/api/desk.h"
#include "docent/telepresence/live_encoding.h"
#include "docent/telepresence/museum_document.h"
#include "docent/telepresence/outbox.h"
#include "docent/telepresence/server/screen_key.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/site.h"
#include "docent/vocabulary/reason.h"

namespace docent::modules {
namespace {

std::filesystem::path page_folder(const std::string& root) {
  return root.empty() ? shipped_path("web/dist") : std::filesystem::path{root};
}

constexpr const char* kNoPage =
    "<!doctype html><meta charset=utf-8><title>Docent</title><p>The page has not been built yet: "
    "<code>cd web &amp;&amp; npm ci &amp;&amp; npm run build</code>, then start again.</p>";

constexpr Duration kOperationPeriod = std::chrono::milliseconds{200};
constexpr Duration kCountPeriod = std::chrono::seconds{10};

RequestSource source_of(telepresence::Role role) {
  switch (role) {
    case telepresence::Role::kiosk:
      return RequestSource::kiosk;
    case telepresence::Role::staff:
      return RequestSource::staff;
    case telepresence::Role::observer:
    case telepresence::Role::visitor:
      break;
  }
  return RequestSource::web;
}

/// Logins outlive restarts, and simulations: they go by the computer's clock.
Time wall_clock() {
  return Time{std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count()};
}

class WebModule final : public Module {
 public:
  static Result<std::unique_ptr<Module>> make(const ModuleContext& context) {
    auto params = context.config.section<WebParams>("web");
    if (!params) return tl::unexpected<Error>(params.error());
    const std::string where = params->database.empty() ? (context.state / "web.sqlite").string() : params->database;
    auto store = WebStore::open(where);
    if (!store) return tl::unexpected<Error>(store.error());
    Offices offices{context};
    auto desk = telepresence::Desk::open(where, params->api, params->forum, wall_clock, {}, offices.museum->office(),
                                         offices.setup->office());
    if (!desk) return tl::unexpected<Error>(desk.error());
    auto map = telepresence::encode_map_png(context.museum.map);
    if (!map) return tl::unexpected<Error>(map.error());
    auto key = telepresence::screen_key(context.state / "screen.key");
    if (!key) return tl::unexpected<Error>(key.error());
    auto uplink_key = telepresence::screen_key(context.state / "uplink.key");
    if (!uplink_key) return tl::unexpected<Error>(uplink_key.error());

    std::unique_ptr<WebModule> module{
        new WebModule{context, *params, std::move(*store), std::move(offices), std::move(*desk)}};
    if (auto filled = module->fill_site(context, std::move(*map)); !filled)
      return tl::unexpected<Error>(filled.error());
    auto server =
        telepresence::WebServer::start(*params, module->site_, module->hooks(std::move(*key), std::move(*uplink_key)));
    if (!server) return fail("web: " + server.error().message);
    module->set_server(std::move(*server));
    module->subscribe();
    return module;
  }

  [[nodiscard]] ModuleHealth health() const override {
    for (const std::string& fault : {reason_, wishes_.fault(), screen_.fault(), votes_.fault(), cameras_.fault(),
                                     operator_.fault(), counts_.fault()}) {
      if (!fault.empty()) return {"degraded", fault};
    }
    return {};
  }

 private:
  WebModule(const ModuleContext& context, WebParams params, WebStore store, Offices offices,
            std::shared_ptr<telepresence::Desk> desk)
      : bus_{context.bus},
        museum_{context.museum},
        params_{std::move(params)},
        database_{std::move(store.database)},
        site_{std::move(offices.site)},
        museum_desk_{std::move(offices.museum)},
        setup_desk_{std::move(offices.setup)},
        desk_{std::move(desk)},
        wishes_{bus_, std::move(store.outbox), telepresence::Database::is_shared(params_.database)},
        choices_{bus_.publisher(topics::kChoice)},
        screen_{bus_, context.state / "poll.csv"},
        votes_{bus_, museum_, std::move(store.votes), context.seed},
        operator_{bus_, context.state / "stopped",
                  [raw = desk_.get()](std::string who, std::string what, std::string about) {
                    raw->note(std::move(who), std::move(what), std::move(about));
                  }},
        counts_{bus_, std::move(store.statistics), telepresence::make_token()},
        mode_{context},
        foxglove_{bus_, "Docent, " + museum::translated(context.museum.name, "en")},
        live_{bus_, context.config.body(), params_} {
    if (database_->was_damaged()) reason_ = "web.sqlite was damaged and has been set aside; a new one was begun";
  }

  Result<void> fill_site(const ModuleContext& context, std::string map) {
    auto page = site_->load_page(page_folder(params_.root));
    if (!page) {
      if (!params_.root.empty()) return page;
      reason_ = page.error().message;
      site_->set_document("/", "text/html; charset=utf-8", kNoPage);
    }
    load_pictures();
    site_->set_audio_folder(context.state / "audio");
    site_->set_document("/api/museum.json", "application/json",
                        telepresence::encode_museum(museum_, context.config.body().radius, rooms_of(museum_)));
    site_->set_document("/api/map.png", "image/png", std::move(map));
    site_->set_live_document("/api/health", "application/json", [this] { return health_document(); });
    site_->set_live_document("/metrics", "text/plain; version=0.0.4", [this] { return metrics(); });
    return {};
  }

  /// What the server calls on its own thread is done on the bus's.
  telepresence::WebServerHooks hooks(std::string screen_key, std::string uplink_key) {
    telepresence::WebServerHooks hooks;
    hooks.message = [this](const telepresence::Caller& caller, const telepresence::ClientMessage& m) {
      bus_.post([this, caller, m] { take(caller, m); });
    };
    hooks.arrived = [this](const std::string& address) { bus_.post([this, address] { counts_.arrived(address); }); };
    hooks.left = [this](const telepresence::Caller& caller) { bus_.post([this, caller] { operator_.left(caller); }); };
    hooks.screen_key = std::move(screen_key);
    hooks.uplink_key = std::move(uplink_key);
    hooks.foxglove = foxglove_.hub();
    hooks.desk = desk_;
    return hooks;
  }

  void load_pictures() {
    for (const auto& exhibit : museum_.exhibits) {
      constexpr std::size_t kMostBytes = 4U << 20U;
      if (exhibit.picture.empty()) continue;
      auto content = read_file(museum_.folder / exhibit.picture);
      if (content && content->size() > kMostBytes) content = fail(exhibit.picture.string() + " is larger than 4 MB");
      if (content) {
        site_->set_file(telepresence::picture_address(exhibit), std::move(*content));
      } else {
        reason_ = content.error().message;
      }
    }
  }

  void set_server(std::unique_ptr<telepresence::WebServer> server) {
    server_ = std::move(server);
    foxglove_.set_server(*server_);
    server_->restrict_to(telepresence::Stream::operators, kOperation);
    live_.begin(*server_);
    inside_.begin(*server_);
    maps_.begin(*server_, kMaps);
    setup_desk_->begin(*server_, kExploration);
    const std::scoped_lock lock{shared_mutex_};
    figures_from_ = server_.get();
  }

  void subscribe() {
    bus_.subscribe<docent_msgs::MissionState>(topics::kMissionState, [this](const auto& m) {
      mission_ = m;
      server_->broadcast(kMission, telepresence::encode_mission(m));
    });
    bus_.subscribe<docent_msgs::SpeechState>(
        topics::kSpeechState, [this](const auto& m) { server_->broadcast(kSpeech, telepresence::encode_speech(m)); });
    bus_.subscribe<docent_msgs::SoundState>(topics::kSoundState, [this](const auto& m) {
      is_muted_ = !(m.volume > 0.0);
      server_->broadcast(kSound, telepresence::encode_sound(m));
    });
    bus_.subscribe<docent_msgs::Horn>(topics::kHorn, [this](const auto&) { show_horn(); });
    bus_.subscribe<docent_msgs::Expression>(topics::kExpression, [this](const auto& m) {
      std::string text = telepresence::encode_expression(m);
      if (std::exchange(expression_, text) != text) server_->broadcast(kExpression, std::move(text));
    });
    bus_.subscribe<docent_msgs::Button>(topics::kButton, [this](const auto& m) {
      if (m.number < 1 || m.number > kButtons) return;
      server_->broadcast(kButton, telepresence::encode_button(bus_.now(), m.number));
    });
    bus_.subscribe<docent_msgs::RequestBoard>(topics::kRequestBoard, [this](const auto& m) { see_board(m); });
    bus_.subscribe<docent_msgs::Health>(topics::kHealth, [this](const auto& m) {
      constexpr std::size_t kMostModules = 64;  // whoever invents names shall not fill the memory
      if (modules_.size() < kMostModules || modules_.contains(m.module)) modules_[m.module] = {m, bus_.now()};
    });
    bus_.subscribe<docent_msgs::Limits>(topics::kLimits, [this](const auto& m) { mode_.limits(m); });
    bus_.every(seconds(1.0), [this] {
      show_health();
      show_hours();
      counts_.see_people(live_.people(), live_.map_from_base());
      if (auto votes = votes_.look()) server_->broadcast(kVotes, std::move(*votes));
      screen_.look();
    });
    bus_.every(seconds(params_.resend_s), [this] { resend(); });
    bus_.every(kOperationPeriod, [this] { show_operation(); });
    bus_.every(kCountPeriod, [this] {
      counts_.asked(server_->figures().http_requests);
      counts_.store(mode_.name(bus_.now()));
    });
    bus_.every(std::chrono::minutes{10}, [this] { forget_old(); });
    resend();
  }

  void forget_old() {
    const Time before = bus_.now() - seconds(params_.forget_hours * 3600.0);
    wishes_.forget_before(before);
    votes_.forget_before(before);
    desk_->tidy();
  }

  void show_health() {
    std::string text = telepresence::encode_health(modules_, server_->figures().viewers, bus_.now());
    {
      const std::scoped_lock lock{shared_mutex_};
      health_text_ = text;
    }
    server_->broadcast(kHealth, std::move(text));
  }

  void show_hours() {
    std::string text = telepresence::encode_hours(mode_.name(bus_.now()), mode_.takes_requests());
    if (std::exchange(hours_, text) != text) server_->broadcast(kHours, std::move(text));
  }

  void show_operation() {
    const auto document = operator_.document();
    museum_desk_->see(document);
    std::string text = telepresence::json_text(document);
    if (std::exchange(operation_, text) != text) server_->broadcast(kOperation, std::move(text));
  }

  /// The `sound` module has written the file of this name.
  void show_horn() {
    server_->broadcast(kHorn, telepresence::encode_horn(bus_.now(), is_muted_ ? "" : horn_.file, horn_.duration_s));
  }

  void see_board(const docent_msgs::RequestBoard& board) {
    wishes_.see(board);
    votes_.see(board);
    counts_.see(board);
    server_->broadcast(kBoard, telepresence::encode_board(board));
  }

  void resend() {
    wishes_.resend();
    if (choice_ && (!mission_ || choice_->prompt_id != mission_->prompt.id)) choice_.reset();
    if (choice_) choices_.publish(*choice_);
  }

  void take(const telepresence::Caller& caller, const telepresence::ClientMessage& message) {
    const telepresence::ViewerId viewer = caller.id;
    const RequestSource source = source_of(caller.role);
    if (const auto done = operator_.take(caller, message)) {
      show_operation();
      return tell_operator(viewer, message, *done);
    }
    if (const auto* request = std::get_if<telepresence::RequestMessage>(&message))
      return take_request(viewer, source, *request);
    if (const auto* cancel = std::get_if<telepresence::CancelMessage>(&message)) {
      docent_msgs::Request wish;
      wish.id = cancel->id;
      wish.kind = to_text(RequestKind::cancel);
      wish.target = cancel->request;
      return store(viewer, source, std::move(wish));
    }
    if (const auto* choice = std::get_if<telepresence::ChoiceMessage>(&message))
      return take_choice(viewer, source, *choice);
    if (const auto* vote = std::get_if<telepresence::VoteMessage>(&message)) {
      const Reason why_not = votes_.take(*vote);
      if (why_not.is_none()) counts_.voted();
      return tell(viewer, vote->id, why_not);
    }
    take_of_screen(viewer, message);
  }

  void take_of_screen(telepresence::ViewerId viewer, const telepresence::ClientMessage& message) {
    const auto phase = mission_ ? parse<MissionPhase>(mission_->phase) : std::nullopt;
    const auto done = screen_.take(message, phase);
    const auto* help = std::get_if<telepresence::HelpMessage>(&message);
    const auto* answer = std::get_if<telepresence::AnswerMessage>(&message);
    if (!done || (help == nullptr && answer == nullptr)) return;
    const std::string& id = help != nullptr ? help->id : answer->id;
    tell(viewer, id, *done);
  }

  /// Steering has no id: it is answered only where it was refused.
  void tell_operator(telepresence::ViewerId viewer, const telepresence::ClientMessage& message, const Reason& why_not) {
    if (const auto* lease = std::get_if<telepresence::LeaseMessage>(&message)) return tell(viewer, lease->id, why_not);
    if (const auto* stop = std::get_if<telepresence::StopMessage>(&message)) return tell(viewer, stop->id, why_not);
    if (const auto* hours = std::get_if<telepresence::SetHoursMessage>(&message))
      return tell(viewer, hours->id, why_not);
    if (const auto word = why_not.word()) server_->send(viewer, telepresence::encode_error(*word));
  }

  void take_request(telepresence::ViewerId viewer, RequestSource source, const telepresence::RequestMessage& message) {
    if (const Reason why = refusal(message); !why.is_none())
      return server_->send(viewer, telepresence::encode_refusal(message.id, why));
    docent_msgs::Request wish;
    wish.id = message.id;
    wish.visitor = message.name;
    wish.kind = to_text(message.kind);
    wish.target = message.target;
    wish.viewpoint = message.viewpoint;
    wish.language =
        message.language.empty() && !museum_.languages.empty() ? museum_.languages.front() : message.language;
    store(viewer, source, std::move(wish));
  }

  /// None: it is taken.
  [[nodiscard]] Reason refusal(const telepresence::RequestMessage& message) const {
    if (wishes_.waiting() >= static_cast<std::size_t>(params_.max_open_requests)) return ReasonWord::too_many_wait;
    return telepresence::why_not_in(museum_, message);
  }

  void store(telepresence::ViewerId viewer, RequestSource source, docent_msgs::Request wish) {
    const std::string id = wish.id;
    wish.source = to_text(source);
    tell(viewer, id, wishes_.take(std::move(wish)));
  }

  void tell(telepresence::ViewerId viewer, const std::string& id, const Reason& why_not) {
    server_->send(viewer, why_not.is_none() ? telepresence::encode_acknowledgement(id)
                                            : telepresence::encode_refusal(id, why_not));
  }

  void take_choice(telepresence::ViewerId viewer, RequestSource source, const telepresence::ChoiceMessage& message) {
    const auto* prompt = mission_ && mission_->prompt.id == message.prompt ? &mission_->prompt : nullptr;
    if (prompt == nullptr)
      return server_->send(viewer, telepresence::encode_refusal(message.id, ReasonWord::question_over));
    if (std::find(prompt->options.begin(), prompt->options.end(), message.choice) == prompt->options.end())
      return server_->send(viewer, telepresence::encode_refusal(message.id, ReasonWord::no_such_answer));
    if (!choice_ || choice_->prompt_id != message.prompt) {  // the first answer counts
      choice_ = docent_msgs::Choice{message.id, message.prompt, message.choice, to_text(source)};
      choices_.publish(*choice_);
    }
    server_->send(viewer, telepresence::encode_acknowledgement(message.id));
  }

  // The server's thread calls these two.
  [[nodiscard]] std::string health_document() {
    const std::scoped_lock lock{shared_mutex_};
    return health_text_;
  }
  [[nodiscard]] std::string metrics() {
    const std::scoped_lock lock{shared_mutex_};
    if (figures_from_ == nullptr) return "";
    const telepresence::WebServerFigures f = figures_from_->figures();
    const auto line = [](const char* name, auto value) {
      return "docent_web_" + (name + (" " + std::to_string(value))) + "\n";
    };
    return line("connections", f.connections) + line("viewers", f.viewers) + line("viewers_total", f.viewers_ever) +
           line("http_requests_total", f.http_requests) + line("messages_received_total", f.messages_in) +
           line("messages_refused_total", f.messages_refused) + line("messages_sent_total", f.messages_out) +
           line("values_skipped_total", f.values_skipped);
  }

  transport::Bus& bus_;
  const museum::Museum& museum_;
  const WebParams params_;
  std::string reason_;  ///< what is wrong since the start
  std::unique_ptr<telepresence::Database> database_;
  std::shared_ptr<telepresence::Site> site_;
  std::unique_ptr<MuseumDesk> museum_desk_;  // these two outlive the desk, which works in them
  std::unique_ptr<SetupDesk> setup_desk_;
  std::shared_ptr<telepresence::Desk> desk_;
  WishDesk wishes_;
  transport::Publisher<docent_msgs::Choice> choices_;
  ScreenDesk screen_;
  VoteDesk votes_;
  OperatorDesk operator_;
  CountDesk counts_;
  MuseumMode mode_;
  std::string hours_;  ///< as they were shown last
  CameraDesk cameras_{bus_, site_};
  FoxgloveDesk foxglove_;
  LiveDesk live_;
  InsideDesk inside_{bus_};
  MapsDesk maps_{bus_};
  std::string operation_;  ///< as it was shown last

  std::optional<docent_msgs::MissionState> mission_;
  std::optional<docent_msgs::Choice> choice_;  ///< resent until its question is closed
  std::string expression_;                     ///< as it was shown last
  bool is_muted_ = false;
  const interaction::SharedSound horn_ = interaction::horn_sound();
  std::map<std::string, telepresence::HealthEntry> modules_;

  std::mutex shared_mutex_;  ///< of the two below
  std::string health_text_ = R"({"type":"health","modules":[]})";
  const telepresence::WebServer* figures_from_ = nullptr;

  std::unique_ptr<telepresence::WebServer> server_;  ///< last: its thread ends before the rest goes
};

}  // namespace

Result<std::unique_ptr<Module>> make_web(const ModuleContext& context) { return WebModule::make(context); }

Result<robot::ParameterRows> parameters_of_web(const robot::RobotConfig& config) {
  return robot::list_parameters<WebParams>(config, "web");
}

}  // namespace docent::modules
