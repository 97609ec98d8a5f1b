#include "docent/modules/edge/web_module.h"

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
#include "docent/modules/edge/camera_desk.h"
#include "docent/modules/edge/foxglove_desk.h"
#include "docent/modules/edge/screen_desk.h"
#include "docent/modules/edge/vote_desk.h"
#include "docent/modules/edge/web_params.h"
#include "docent/modules/edge/wish_desk.h"
#include "docent/modules/shared/museum_mode.h"
#include "docent/modules/shared/scanners.h"
#include "docent/telepresence/belief_carrier.h"
#include "docent/telepresence/live_encoding.h"
#include "docent/telepresence/museum_document.h"
#include "docent/telepresence/outbox.h"
#include "docent/telepresence/server/screen_key.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/site.h"
#include "docent/vocabulary/reason.h"

namespace docent::modules {
namespace {

/// The slots of the live channel.
enum Slot : int {
  kLive,
  kBelief,
  kPath,
  kMission,
  kSpeech,
  kBoard,
  kHealth,
  kWindow,
  kHorn,
  kSound,
  kExpression,
  kButton,
  kPose,
  kVotes,
  kHours
};

std::filesystem::path page_folder(const std::string& root) {
  return root.empty() ? shipped_path("web/dist") : std::filesystem::path{root};
}

constexpr const char* kNoPage =
    "<!doctype html><meta charset=utf-8><title>Docent</title><p>The page has not been built yet: "
    "<code>cd web &amp;&amp; npm ci &amp;&amp; npm run build</code>, then start again.</p>";

RequestSource source_of(telepresence::Role role) {
  return role == telepresence::Role::kiosk ? RequestSource::kiosk : RequestSource::web;
}

class WebModule final : public Module {
 public:
  static Result<std::unique_ptr<Module>> make(const ModuleContext& context) {
    auto params = context.config.section<WebParams>("web");
    if (!params) return tl::unexpected<Error>(params.error());
    auto database = telepresence::Database::open(params->database.empty() ? (context.state / "web.sqlite").string()
                                                                          : params->database);
    if (!database) return tl::unexpected<Error>(database.error());
    auto outbox = telepresence::Outbox::open(**database);
    if (!outbox) return tl::unexpected<Error>(outbox.error());
    auto votes = telepresence::TourVotes::open(**database);
    if (!votes) return tl::unexpected<Error>(votes.error());
    auto map = telepresence::encode_map_png(context.museum.map);
    if (!map) return tl::unexpected<Error>(map.error());

    auto key = telepresence::screen_key(context.state / "screen.key");
    if (!key) return tl::unexpected<Error>(key.error());

    std::unique_ptr<WebModule> module{
        new WebModule{context, *params, std::move(*database), std::move(*outbox), std::move(*votes)}};
    telepresence::Site& site = *module->site_;
    auto page = site.load_page(page_folder(params->root));
    if (!page) {
      if (!params->root.empty()) return tl::unexpected<Error>(page.error());
      module->reason_ = page.error().message;
      site.set_document("/", "text/html; charset=utf-8", kNoPage);
    }
    module->load_pictures();
    site.set_audio_folder(context.state / "audio");
    site.set_document("/api/museum.json", "application/json",
                      telepresence::encode_museum(context.museum, context.config.body().radius));
    site.set_document("/api/map.png", "image/png", std::move(*map));
    site.set_live_document("/api/health", "application/json", [raw = module.get()] { return raw->health_document(); });
    site.set_live_document("/metrics", "text/plain; version=0.0.4", [raw = module.get()] { return raw->metrics(); });

    auto server = telepresence::WebServer::start(
        *params, module->site_,
        [raw = module.get()](telepresence::ViewerId viewer, telepresence::Role role,
                             const telepresence::ClientMessage& m) {
          raw->bus_.post([raw, viewer, role, m] { raw->take(viewer, source_of(role), m); });
        },
        std::move(*key), module->foxglove_.hub());
    if (!server) return fail("web: " + server.error().message);
    module->set_server(std::move(*server));
    module->subscribe();
    return module;
  }

  [[nodiscard]] ModuleHealth health() const override {
    for (const std::string& fault : {reason_, wishes_.fault(), screen_.fault(), votes_.fault(), cameras_.fault()}) {
      if (!fault.empty()) return {"degraded", fault};
    }
    return {};
  }

 private:
  WebModule(const ModuleContext& context, WebParams params, std::unique_ptr<telepresence::Database> database,
            std::unique_ptr<telepresence::Outbox> outbox, std::unique_ptr<telepresence::TourVotes> votes)
      : bus_{context.bus},
        museum_{context.museum},
        body_{context.config.body()},
        params_{std::move(params)},
        database_{std::move(database)},
        wishes_{bus_, std::move(outbox), telepresence::Database::is_shared(params_.database)},
        choices_{bus_.publisher(topics::kChoice)},
        screen_{bus_, context.state / "poll.csv"},
        votes_{bus_, museum_, std::move(votes), context.seed},
        mode_{context},
        foxglove_{bus_, "Docent, " + museum::translated(context.museum.name, "en")},
        scans_(body_.scanners.size()) {
    if (database_->was_damaged()) reason_ = "web.sqlite was damaged and has been set aside; a new one was begun";
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
    server_->restrict_to(telepresence::Stream::details, kWindow);
    server_->restrict_to(telepresence::Stream::full, kLive);
    server_->restrict_to(telepresence::Stream::full, kBelief);
    server_->restrict_to(telepresence::Stream::thin, kPose);
    const std::scoped_lock lock{shared_mutex_};
    figures_from_ = server_.get();
  }

  void subscribe() {
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& m) { carrier_.add_odometry(m); });
    subscribe_scanners(bus_, body_, [this](std::size_t i, const auto& m) { scans_[i] = m; });
    bus_.subscribe<sensor_msgs::BatteryState>(topics::kBattery, [this](const auto& m) { battery_ = m.percentage; });
    bus_.subscribe<docent_msgs::People>(topics::kPeople, [this](const auto& m) { people_ = m; });
    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& m) {
      carrier_.set_belief(m);
      belief_ = m;
    });
    bus_.subscribe<docent_msgs::AvoidState>(topics::kAvoidState, [this](const auto& m) {
      avoid_ = m;
      if (!m.window.empty()) server_->broadcast(kWindow, telepresence::encode_window(m));
    });
    bus_.subscribe<nav_msgs::Path>(topics::kPath, [this](const auto& m) {
      path_ = m;
      is_path_new_ = true;
    });
    bus_.subscribe<docent_msgs::GoalState>(topics::kGoalState, [this](const auto& m) {
      goal_ = m;
      is_path_new_ = true;
    });
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
    bus_.every(seconds(1.0 / params_.live_hz), [this] { show_live(); });
    bus_.every(seconds(params_.pose_s / telepresence::WebServer::kParts), [this] { show_pose(); });
    bus_.every(seconds(1.0 / params_.belief_hz), [this] { show_slow(); });
    bus_.subscribe<docent_msgs::Limits>(topics::kLimits, [this](const auto& m) { mode_.limits(m); });
    bus_.every(seconds(1.0), [this] {
      show_health();
      show_hours();
      if (auto votes = votes_.look()) server_->broadcast(kVotes, std::move(*votes));
      screen_.look();
    });
    bus_.every(seconds(params_.resend_s), [this] { resend(); });
    bus_.every(std::chrono::minutes{10}, [this] { forget_old(); });
    resend();
  }

  void forget_old() {
    const Time before = bus_.now() - seconds(params_.forget_hours * 3600.0);
    wishes_.forget_before(before);
    votes_.forget_before(before);
  }

  /// Where the robot is, and how fast.
  [[nodiscard]] telepresence::LiveFrame frame_now() const {
    telepresence::LiveFrame frame;
    frame.now = bus_.now();
    frame.map_from_base = carrier_.map_from_base(frame.now);
    frame.linear = carrier_.linear();
    frame.angular = carrier_.angular();
    frame.p_lost = carrier_.p_lost();
    frame.battery = battery_;
    return frame;
  }

  void show_live() {
    constexpr Duration kFresh = std::chrono::seconds{1};
    telepresence::LiveFrame frame = frame_now();
    if (!frame.map_from_base) frame.hypotheses = carrier_.hypotheses(frame.now, 0.03);
    frame.is_scan_in_map = frame.map_from_base.has_value();
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      const sensor_msgs::LaserScan& scan = scans_[i];
      const Time taken = from_message(scan.header.stamp);
      if (scan.ranges.empty() || frame.now - taken > kFresh) continue;
      const Pose2 from_base = frame.is_scan_in_map ? *carrier_.map_from_base(taken) : Pose2{};
      frame.scan_origin = from_base.position();
      for (const Point2 point : telepresence::scan_points(scan, body_.scanners[i].base_from_sensor(),
                                                          static_cast<std::size_t>(params_.scan_step)))
        frame.scan.push_back(from_base * point);
    }
    if (frame.now - from_message(people_.header.stamp) <= kFresh) frame.people = people_;
    if (avoid_ && frame.now - from_message(avoid_->header.stamp) <= kFresh) frame.avoid = avoid_;
    server_->broadcast(kLive, telepresence::encode_live(frame));
  }

  /// Each part of the thin viewers gets the pose of its own moment, so that nobody waits until all have theirs.
  void show_pose() {
    server_->broadcast_part(kPose, part_, telepresence::encode_pose(frame_now()));
    part_ = (part_ + 1) % telepresence::WebServer::kParts;
  }

  void show_slow() {
    if (belief_) server_->broadcast(kBelief, telepresence::encode_belief(*std::exchange(belief_, std::nullopt)));
    if (std::exchange(is_path_new_, false)) server_->broadcast(kPath, telepresence::encode_path(path_, goal_));
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

  /// The `sound` module has written the file of this name.
  void show_horn() {
    server_->broadcast(kHorn, telepresence::encode_horn(bus_.now(), is_muted_ ? "" : horn_.file, horn_.duration_s));
  }

  void see_board(const docent_msgs::RequestBoard& board) {
    wishes_.see(board);
    votes_.see(board);
    server_->broadcast(kBoard, telepresence::encode_board(board));
  }

  void resend() {
    wishes_.resend();
    if (choice_ && (!mission_ || choice_->prompt_id != mission_->prompt.id)) choice_.reset();
    if (choice_) choices_.publish(*choice_);
  }

  void take(telepresence::ViewerId viewer, RequestSource source, const telepresence::ClientMessage& message) {
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
    if (const auto* vote = std::get_if<telepresence::VoteMessage>(&message))
      return tell(viewer, vote->id, votes_.take(*vote));
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
  const robot::RobotBody body_;
  const WebParams params_;
  std::string reason_;  ///< what is wrong since the start
  std::unique_ptr<telepresence::Database> database_;
  WishDesk wishes_;
  transport::Publisher<docent_msgs::Choice> choices_;
  ScreenDesk screen_;
  VoteDesk votes_;
  MuseumMode mode_;
  std::string hours_;  ///< as they were shown last
  std::shared_ptr<telepresence::Site> site_ = std::make_shared<telepresence::Site>();
  CameraDesk cameras_{bus_, site_};
  FoxgloveDesk foxglove_;

  telepresence::BeliefCarrier carrier_;
  std::vector<sensor_msgs::LaserScan> scans_;  ///< [scanners] newest sweeps
  docent_msgs::People people_;
  std::optional<docent_msgs::Belief> belief_;  ///< not yet shown
  std::optional<docent_msgs::AvoidState> avoid_;
  std::optional<docent_msgs::MissionState> mission_;
  std::optional<docent_msgs::Choice> choice_;  ///< resent until its question is closed
  std::optional<double> battery_;
  std::string expression_;  ///< as it was shown last
  bool is_muted_ = false;
  const interaction::SharedSound horn_ = interaction::horn_sound();
  nav_msgs::Path path_;
  docent_msgs::GoalState goal_;
  bool is_path_new_ = false;
  int part_ = 0;  ///< of the thin viewers, that gets the next pose
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
