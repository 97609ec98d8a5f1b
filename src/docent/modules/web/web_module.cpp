#include "docent/modules/web/web_module.h"

#include <memory>
#include <utility>

#include "docent/base/files.h"
#include "docent/base/shipped_files.h"
#include "docent/interaction/kiosk/poll.h"
#include "docent/interaction/sound/horn.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/messages/topics.h"
#include "docent/modules/shared/museum_mode.h"
#include "docent/modules/web/bus_link.h"
#include "docent/modules/web/camera_desk.h"
#include "docent/modules/web/foxglove_desk.h"
#include "docent/modules/web/inside_desk.h"
#include "docent/modules/web/live_desk.h"
#include "docent/modules/web/operators/maps_desk.h"
#include "docent/modules/web/operators/offices.h"
#include "docent/modules/web/room_documents.h"
#include "docent/modules/web/server_link.h"
#include "docent/modules/web/web_params.h"
#include "docent/telepresence/api/desk.h"
#include "docent/telepresence/museum_document.h"
#include "docent/telepresence/server/screen_key.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/service/web_service.h"
#include "docent/telepresence/site.h"

namespace docent::modules {
namespace {

std::filesystem::path page_folder(const std::string& root) {
  return root.empty() ? shipped_path("web/dist") : std::filesystem::path{root};
}

constexpr const char* kNoPage =
    "<!doctype html><meta charset=utf-8><title>Docent</title><p>The page has not been built yet: "
    "<code>cd web &amp;&amp; npm ci &amp;&amp; npm run build</code>, then start again.</p>";

constexpr Duration kSteeringPeriod = std::chrono::milliseconds{100};
constexpr Duration kOperationPeriod = std::chrono::milliseconds{200};
constexpr Duration kCountPeriod = std::chrono::seconds{10};
constexpr Duration kTidyPeriod = std::chrono::minutes{10};

namespace slots = telepresence::slots;

/// Logins outlive restarts, and simulations: they go by the computer's clock.
Time wall_clock() {
  return Time{std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count()};
}

telepresence::ScreenDesk::Means screen_means(const std::filesystem::path& state) {
  const auto poll = std::make_shared<interaction::Poll>(state / "poll.csv");
  const auto keep_answer = [poll](const telepresence::AnswerMessage& answer, Time now) {
    return poll->add({answer.id, answer.question, answer.answer, answer.language}, now);
  };
  const auto help_text = [](const std::string& language) {
    return interaction::sentence(interaction::Sentence::help, language, Mood::neutral, 0);
  };
  return {keep_answer, help_text};
}

std::string database_of(const ModuleContext& context, const WebParams& params) {
  return params.database.empty() ? (context.state / "web.sqlite").string() : params.database;
}

telepresence::WebServiceParts service_parts(const ModuleContext& context, const WebParams& params,
                                            telepresence::WebStore store, telepresence::Desk* desk, Offices& offices,
                                            const std::string& gateway) {
  const interaction::SharedSound horn = interaction::horn_sound();
  telepresence::WebServiceParts parts;
  parts.store = std::move(store);
  parts.post = [&bus = context.bus](std::function<void()> work) { bus.post(std::move(work)); };
  context.config.amend(parts.queue);
  parts.backups.emplace(context.state, database_of(context, params), context.museum.folder);
  parts.is_shared = telepresence::Database::is_shared(params.database);
  parts.max_open_requests = static_cast<std::size_t>(params.max_open_requests);
  parts.kept_places = static_cast<std::size_t>(params.kept_places);
  parts.max_open_of_address = static_cast<std::size_t>(params.max_open_of_address);
  parts.forgets_after = seconds(params.forget_hours * 3600.0);
  parts.note = [desk](std::string who, std::string what, std::string about) {
    desk->note(std::move(who), std::move(what), std::move(about));
  };
  parts.screen = screen_means(context.state);
  parts.horn = {horn.file, horn.duration_s};
  parts.gateway = gateway;
  parts.seed = context.seed;
  parts.operated = [&offices](const auto& document) {
    offices.museum->see(document);
    offices.robot->see(document);
  };
  return parts;
}

class WebModule final : public Module {
 public:
  static Result<std::unique_ptr<Module>> make(const ModuleContext& context) {
    auto params = context.config.section<WebParams>("web");
    if (!params) return tl::unexpected<Error>(params.error());
    const std::string where = database_of(context, *params);
    auto store = telepresence::WebStore::open(where);
    if (!store) return tl::unexpected<Error>(store.error());
    Offices offices{context};
    const auto when =
        store->database->is_gone() ? telepresence::Database::Try::later : telepresence::Database::Try::now;
    auto desk = telepresence::Desk::open(where, params->api, params->forum, wall_clock, {}, offices.museum->office(),
                                         offices.setup->office(), when, offices.robot->office());
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
    auto server = telepresence::WebServer::start(*params, module->offices_.site,
                                                 module->hooks(std::move(*key), std::move(*uplink_key)));
    if (!server) return fail("web: " + server.error().message);
    module->begin(std::move(*server));
    return module;
  }

  [[nodiscard]] ModuleHealth health() const override {
    for (const std::string& fault : {start_fault_, service_.fault(), cameras_.fault()}) {
      if (!fault.empty()) return {"degraded", fault};
    }
    if (const std::string second = server_ ? server_->second_holder() : std::string{}; !second.empty())
      return {"degraded", "a second holder of the key of the line comes from " + second + " and is sent away"};
    return robot_.stop().health();
  }

 private:
  WebModule(const ModuleContext& context, WebParams params, telepresence::WebStore store, Offices offices,
            std::shared_ptr<telepresence::Desk> desk)
      : bus_{context.bus},
        params_{std::move(params)},
        offices_{std::move(offices)},
        desk_{std::move(desk)},
        robot_{context, "web/" + telepresence::make_token()},
        service_{service_parts(context, params_, std::move(store), desk_.get(), offices_, robot_.name()),
                 context.museum,
                 robot_,
                 robot_.stop().button(),
                 viewers_,
                 bus_.now()},
        mode_{context},
        foxglove_{bus_, "Docent, " + museum::translated(context.museum.name, "en")},
        live_{bus_, context.config.body(), params_} {}

  Result<void> fill_site(const ModuleContext& context, std::string map) {
    telepresence::Site& site = *offices_.site;
    const museum::Museum& museum = context.museum;
    auto page = site.load_page(page_folder(params_.root));
    if (!page) {
      if (!params_.root.empty()) return page;
      start_fault_ = page.error().message;
      site.set_document("/", "text/html; charset=utf-8", kNoPage);
    }
    load_pictures(museum);
    site.set_audio_folder(context.state / "audio");
    site.set_document("/api/museum.json", "application/json",
                      telepresence::encode_museum(museum, context.config.body().radius, rooms_of(museum)));
    site.set_document("/api/map.png", "image/png", std::move(map));
    site.set_live_document("/api/health", "application/json", [this] { return service_.health_document(); });
    site.set_live_document("/metrics", "text/plain; version=0.0.4", [this] { return viewers_.metrics(); });
    return {};
  }

  void load_pictures(const museum::Museum& museum) {
    for (const auto& exhibit : museum.exhibits) {
      constexpr std::size_t kMostBytes = 4U << 20U;
      if (exhibit.picture.empty()) continue;
      auto content = read_file(museum.folder / exhibit.picture);
      if (content && content->size() > kMostBytes) content = fail(exhibit.picture.string() + " is larger than 4 MB");
      if (content) {
        offices_.site->set_file(telepresence::picture_address(exhibit), std::move(*content));
      } else {
        start_fault_ = content.error().message;
      }
    }
  }

  /// What the server calls on its own thread is done on the bus's.
  telepresence::WebServerHooks hooks(std::string screen_key, std::string uplink_key) {
    telepresence::WebServerHooks hooks;
    hooks.message = [this](const telepresence::Caller& caller, const telepresence::ClientMessage& m) {
      bus_.post([this, caller, m] { service_.take(caller, m, bus_.now()); });
    };
    hooks.arrived = [this](const std::string& address) { bus_.post([this, address] { service_.arrived(address); }); };
    hooks.left = [this](const telepresence::Caller& caller) {
      bus_.post([this, caller] { service_.left(caller, bus_.now()); });
    };
    hooks.screen_key = std::move(screen_key);
    hooks.uplink_key = std::move(uplink_key);
    hooks.foxglove = foxglove_.hub();
    hooks.desk = desk_;
    return hooks;
  }

  void begin(std::unique_ptr<telepresence::WebServer> server) {
    server_ = std::move(server);
    viewers_.set_server(*server_);
    foxglove_.set_server(*server_);
    server_->restrict_to(telepresence::Stream::stop, slots::kOperation);
    live_.begin(*server_);
    inside_.begin(*server_);
    maps_.begin(*server_, slots::kMaps);
    offices_.setup->begin(*server_, slots::kExploration);
    subscribe();
    keep_time();
    service_.resend(bus_.now());
  }

  void subscribe() {
    const auto see = [this](const auto& message) { service_.see(message); };
    const auto see_now = [this](const auto& message) { service_.see(message, bus_.now()); };
    bus_.subscribe<docent_msgs::Limits>(topics::kLimits, [this](const auto& limits) {
      service_.see(limits);
      mode_.limits(limits);
    });
    // After the keeper of the button, which has heard it already: somebody may wait for the answer.
    bus_.subscribe<docent_msgs::Stop>(topics::kStop, [this](const auto&) { service_.confirm(bus_.now()); });
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, see);
    bus_.subscribe<docent_msgs::Event>(topics::kEvent, see);
    bus_.subscribe<docent_msgs::Tactile>(topics::kTactile, see);
    bus_.subscribe<docent_msgs::MissionState>(topics::kMissionState, see);
    bus_.subscribe<docent_msgs::SpeechState>(topics::kSpeechState, see);
    bus_.subscribe<docent_msgs::SoundState>(topics::kSoundState, see);
    bus_.subscribe<docent_msgs::Expression>(topics::kExpression, see);
    bus_.subscribe<docent_msgs::RequestBoard>(topics::kRequestBoard, see_now);
    bus_.subscribe<docent_msgs::Health>(topics::kHealth, see_now);
    bus_.subscribe<docent_msgs::Horn>(topics::kHorn, [this](const auto&) { service_.honk(bus_.now()); });
    bus_.subscribe<docent_msgs::Button>(topics::kButton,
                                        [this](const auto& button) { service_.press(button.number, bus_.now()); });
  }

  void keep_time() {
    bus_.every(kSteeringPeriod, [this] { service_.steer_on(bus_.now()); });
    bus_.every(seconds(1.0), [this] {
      service_.see_people(live_.people(), live_.map_from_base());
      service_.look(hours(), server_->figures().viewers, bus_.now());
      desk_->look();
    });
    bus_.every(seconds(params_.resend_s), [this] { service_.resend(bus_.now()); });
    bus_.every(kOperationPeriod, [this] {
      service_.show_operation();
      offices_.robot->see(live_.map_from_base());
    });
    bus_.every(kCountPeriod, [this] { service_.store_counts(hours(), server_->figures().http_requests, bus_.now()); });
    bus_.every(kTidyPeriod, [this] {
      service_.forget_old(bus_.now());
      desk_->tidy();
    });
  }

  [[nodiscard]] telepresence::PresentHours hours() const {
    const Time now = bus_.now();
    telepresence::PresentHours hours{mode_.name(now), mode_.takes_requests()};
    if (const auto next = mode_.next(now)) {
      hours.next_mode = next->mode;
      hours.next_at = museum::clock_text(next->minute_of_day);
    }
    return hours;
  }

  transport::Bus& bus_;
  const WebParams params_;
  std::string start_fault_;  ///< what is wrong since the start
  Offices offices_;          ///< outlives the desk, which works in them
  std::shared_ptr<telepresence::Desk> desk_;
  BusLink robot_;
  ServerLink viewers_;
  telepresence::WebService service_;
  MuseumMode mode_;
  CameraDesk cameras_{bus_, offices_.site};
  FoxgloveDesk foxglove_;
  LiveDesk live_;
  InsideDesk inside_{bus_};
  MapsDesk maps_{bus_};
  std::unique_ptr<telepresence::WebServer> server_;  ///< last: its thread ends before the rest goes
};

}  // namespace

Result<std::unique_ptr<Module>> make_web(const ModuleContext& context) { return WebModule::make(context); }

Result<robot::ParameterRows> parameters_of_web(const robot::RobotConfig& config) {
  return robot::list_parameters<WebParams>(config, "web");
}

}  // namespace docent::modules
