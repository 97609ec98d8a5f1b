#include "docent/modules/guide/mission_module.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include "docent/base/random.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/interaction/speech/spoken_text.h"
#include "docent/messages/conversions.h"
#include "docent/modules/guide/mingling.h"
#include "docent/modules/guide/room_guide.h"
#include "docent/modules/shared/battery.h"
#include "docent/modules/shared/museum_mode.h"
#include "docent/task_control/golog_planner/golog_planner.h"
#include "docent/task_control/mission/mission.h"
#include "docent/task_control/mission/mission_store.h"
#include "docent/task_control/plan_controller/plan_controller.h"
#include "docent/task_control/travel_times/travel.h"
#include "docent/vocabulary/reason.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

constexpr Duration kMissionPeriod = std::chrono::milliseconds{500};
constexpr std::size_t kLongestField = 200;  ///< [bytes] of any field of a request: it comes from anybody

/// As the executive speaks it.
task_control::SpokenLength length_of(const museum::Exhibit& exhibit, const std::string& language) {
  const auto seconds_of = [&](const std::string& text) {
    return interaction::speech_duration(text, language, Mood::neutral);
  };
  const auto spoken = [&](const museum::Translations& text) {
    return interaction::spoken_text(museum::translated(text, language));
  };
  return {seconds_of(spoken(exhibit.title) + " " + spoken(exhibit.short_text)), seconds_of(spoken(exhibit.long_text))};
}

task_control::Programme programme_of(const museum::Museum& museum) {
  task_control::Programme programme;
  if (!museum.languages.empty()) programme.languages = museum.languages;
  programme.home = museum.home;
  programme.charger = museum.charger;
  const std::string& language = programme.languages.front();
  const std::string farewell = interaction::sentence(interaction::Sentence::farewell, language, Mood::happy, 0);
  programme.farewell_s = interaction::speech_duration(farewell, language, Mood::happy);
  for (const museum::Exhibit& exhibit : museum.exhibits) {
    task_control::ProgrammeExhibit& shown = programme.exhibits.emplace_back();
    const task_control::SpokenLength own = length_of(exhibit, language);
    shown = {exhibit.id, exhibit.pose, exhibit.viewpoints, own.short_s, exhibit.web_only};
    shown.long_s = own.long_s;
    for (const std::string& other : programme.languages) shown.spoken[other] = length_of(exhibit, other);
    for (const museum::Exhibit* next : museum::sensible_next(museum, exhibit)) shown.next.push_back(next->id);
  }
  for (const museum::Tour& tour : museum.tours) {
    programme.tours.push_back({tour.id, tour.exhibits, 60.0 * tour.minutes.value_or(0.0)});
  }
  return programme;
}

planning::RoutePlanner planner_in(const ModuleContext& context) {
  const museum::Museum& museum = context.museum;
  planning::RouteParams params;
  params.robot_radius = context.config.body().radius;
  return {museum.map, museum.hazard_polygons(), museum.area, params};
}

task_control::TravelDistance travel_in(const ModuleContext& context) {
  if (context.museum.map.cells.empty()) return task_control::straight_distance();
  return task_control::travel_on_map(planner_in(context));
}

task_control::Programme programme_in(const ModuleContext& context, RoomGuide& guide) {
  task_control::Programme programme = programme_of(context.museum);
  if (context.museum.map.cells.empty()) return programme;
  programme.has_room = [planner = std::make_shared<planning::RoutePlanner>(planner_in(context))](Point2 place) {
    return !planner->is_closed(place);
  };
  programme.rooms = [&guide]() -> const task_control::Rooms& { return guide.rooms(); };
  return programme;
}

std::string deployment_name(std::uint64_t seed, Time now) {
  char name[20];
  const auto hash = hash_of(std::to_string(seed) + "/" + std::to_string(now.nanoseconds));
  std::snprintf(name, sizeof name, "%08llx", static_cast<unsigned long long>(hash & 0xffffffffU));
  return name;
}

docent_msgs::RequestState to_message(const task_control::BoardEntry& entry) {
  const task_control::VisitorRequest& request = entry.request;
  return {{request.id, docent::to_message(request.stamp), request.source.text(), request.visitor, request.kind.text(),
           request.target, request.viewpoint, request.language},
          to_text(entry.status),
          entry.reason.text(),
          docent::to_message(entry.created),
          docent::to_message(entry.changed)};
}

/// Section `mission`, with the choice of its planner.
struct MissionModuleParams : task_control::MissionParams {
  std::string planner = "plans";  ///< plans: Minerva's controller; golog: the museum's tour.pl, or the shipped one
  task_control::GologPlannerParams golog;  ///< of the planner golog
  MinglingParams attraction;               ///< how it learns to attract people
  template <class V>
  void visit(V& v) {
    task_control::MissionParams::visit(v);
    v("planner", planner);
    v("golog", golog);
    v("attraction", attraction);
  }
  [[nodiscard]] Result<void> validate() const {
    if (planner != "plans" && planner != "golog") return fail("mission.planner must be plans or golog");
    if (auto valid = golog.validate(); !valid) return valid;
    if (auto valid = attraction.validate(); !valid) return fail("mission.attraction." + valid.error().message);
    return task_control::MissionParams::validate();
  }
};

Result<std::unique_ptr<task_control::Planner>> planner_of(const ModuleContext& context,
                                                          const MissionModuleParams& params) {
  if (params.planner == "plans") return std::make_unique<task_control::PlanController>();
  auto program = task_control::GologProgram::load(params.golog.program, task_control::golog_file(context.museum.folder),
                                                  programme_of(context.museum), travel_in(context));
  if (!program) return tl::unexpected<Error>(program.error());
  return std::make_unique<task_control::GologPlanner>(params.golog, std::move(*program));
}

class MissionModule final : public Module {
 public:
  MissionModule(const ModuleContext& context, const MissionModuleParams& params,
                std::unique_ptr<task_control::Planner> planner, task_control::MissionStore store,
                task_control::MissionMemory memory)
      : bus_{context.bus},
        museum_{context.museum},
        guide_{context.museum},
        mode_{context},
        store_{std::move(store)},
        set_aside_{store_.set_aside()},
        mission_{params,    programme_in(context, guide_), travel_in(context), std::move(memory), std::move(planner),
                 bus_.now()},
        mingling_{context, params.attraction},
        board_{bus_.publisher(topics::kRequestBoard)},
        task_{bus_.publisher(topics::kTask)},
        state_{bus_.publisher(topics::kMissionState)},
        event_{bus_.publisher(topics::kEvent)} {
    flush();
    bus_.subscribe<docent_msgs::Request>(topics::kRequest, [this](const auto& message) { on_request(message); });
    bus_.subscribe<docent_msgs::TaskState>(topics::kTaskState, [this](const auto& message) { on_task(message); });
    bus_.subscribe<docent_msgs::Votes>(topics::kVotes, [this](const auto& message) { on_votes(message); });
    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& message) { on_belief(message); });
    bus_.subscribe<docent_msgs::Limits>(topics::kLimits, [this](const auto& message) { mode_.limits(message); });
    bus_.subscribe<sensor_msgs::BatteryState>(topics::kBattery, [this](const auto& message) {
      if (message.present && std::isfinite(message.percentage)) {
        // Many a gauge never shows a whole charge: full is what the battery calls so.
        const double charge = is_full(message) ? 1.0 : static_cast<double>(message.percentage);
        mission_.battery(charge, is_charging(message), bus_.now());
      }
    });
    bus_.every(kMissionPeriod, [this] {
      mission_.time_of_day(mode_.minute_of_day(bus_.now()) / 60);
      tell_mode();
      mission_.company(mingling_.has_company());
      mingling_.observe();
      mission_.tick(bus_.now());
      flush();
    });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!fault_.empty()) return {"degraded", fault_};
    if (const std::string fault = mission_.planner_fault(); !fault.empty()) return {"degraded", fault};
    if (!mingling_.fault().empty()) return {"degraded", mingling_.fault()};
    if (mission_.is_battery_silent(bus_.now())) return {"degraded", "the battery says nothing"};
    if (!set_aside_.empty()) return {"degraded", "a damaged database was set aside: " + set_aside_};
    return {};
  }

 private:
  void tell_mode() { mission_.limits(mode_.takes_requests(), parse<OperatingMode>(mode_.name(bus_.now()))); }

  void on_request(const docent_msgs::Request& message) {
    tell_mode();
    for (const std::string* text :
         {&message.id, &message.source, &message.visitor, &message.kind, &message.target, &message.language}) {
      if (text->size() > kLongestField) return;
    }
    if (message.id.empty()) return;
    if (mission_.scheduler().state().board.find(message.id) == nullptr) {
      const auto old = store_.find(message.id);
      if (!old) {  // unknown whether it is new: the client will ask again
        fault_ = old.error().message;
        return;
      }
      if (*old) {
        mission_.show_again(**old);
        flush();
        return;
      }
    }
    mission_.submit({message.id, from_message(message.stamp), Word<RequestSource>{message.source}, message.visitor,
                     Word<RequestKind>{message.kind}, message.target, message.viewpoint, message.language},
                    bus_.now());
    flush();
  }

  /// The tour that leads; of two with as many votes the one that is listed first.
  void on_votes(const docent_msgs::Votes& message) {
    std::size_t best = 0;
    std::uint32_t most = 0;
    for (std::size_t i = 0; i < std::min(message.tours.size(), message.counts.size()); ++i) {
      if (message.counts[i] <= most || museum_.find_tour(message.tours[i]) == nullptr) continue;
      most = message.counts[i];
      best = i;
    }
    if (message.round.size() > kLongestField) return;
    mission_.votes(message.round, most > 0 ? message.tours[best] : "", bus_.now());
    flush();
  }

  void on_task(const docent_msgs::TaskState& message) {
    if (message.id == mission_.task().id) prompt_ = message.prompt;
    mission_.report(message.id, parse<TaskStatus>(message.state), Reason::from_text(message.reason), bus_.now(),
                    message.took_long);
    flush();
  }

  void on_belief(const docent_msgs::Belief& belief) {
    Point2 position;
    if (!belief.hypotheses.empty()) position = {belief.hypotheses.front().x, belief.hypotheses.front().y};
    const bool was_localized = is_localized_;
    is_localized_ = belief.localized && !belief.hypotheses.empty();
    mission_.localization(is_localized_, position, bus_.now());
    if (is_localized_ != was_localized) flush();
  }

  /// Commits what changed, then publishes it; what cannot be committed is not published and tried again.
  void flush() {
    const task_control::MissionMemory memory = mission_.memory();
    if (auto saved = store_.save(memory); !saved) {
      fault_ = saved.error().message;
      return;
    }
    fault_.clear();
    mission_.mark_stored();
    const Time now = bus_.now();
    for (task_control::Happening& happening : mission_.take_happenings()) {
      event_.publish({{docent::to_message(now), "map"},
                      to_text(happening.kind),
                      std::move(happening.subject),
                      std::move(happening.detail),
                      happening.value});
    }
    const std::uint64_t revision = memory.schedule.board.revision();
    if (!is_published_ || revision != published_revision_) publish_board(memory.schedule.board, now);
    if (!is_published_ || memory.task.id != published_task_) publish_task(memory.task);
    publish_state(now);
    is_published_ = true;
  }

  void publish_board(const task_control::RequestBoard& board, Time now) {
    docent_msgs::RequestBoard message;
    message.header.stamp = docent::to_message(now);
    message.revision = board.revision();
    for (const task_control::BoardEntry& entry : board.entries()) message.requests.push_back(to_message(entry));
    published_revision_ = board.revision();
    board_.publish(std::move(message));
  }

  void publish_task(const task_control::TaskOrder& task) {
    const Pose2& pose = task.map_from_base;
    published_task_ = task.id;
    prompt_ = {};
    end_mingling();
    docent_msgs::Task message{task.id,       task.kind.text(), task.exhibit_id, pose.x, pose.y, pose.theta.radians(),
                              task.language, task.offer_more,  task.tour_id,    {},     {},     {}};
    if (task.kind == TaskKind::mingle) {
      const interaction::AttractionAction style = mingling_.begin();
      message.gaze = to_text(style.gaze);
      message.face = to_text(style.face);
      message.speech = to_text(style.speech);
    }
    task_.publish(std::move(message));
  }

  /// It counts as what it was worth until now, also where a visitor ended it by a wish.
  void end_mingling() {
    const auto trial = mingling_.finish();
    if (!trial) return;
    const interaction::AttractionAction& action = trial->action;
    event_.publish({{docent::to_message(bus_.now()), "map"},
                    to_text(EventKind::attraction_trial),
                    to_text(interaction::style_of(action)),
                    std::string{to_text(action.gaze)} + " " + to_text(action.face) + " " + to_text(action.speech),
                    trial->reward});
  }

  void publish_state(Time now) {
    const task_control::MissionSummary summary = mission_.summary(now);
    docent_msgs::MissionState message;
    message.phase = to_text(summary.phase);
    message.tour_id = summary.tour_id;
    message.exhibit_id = summary.exhibit_id;
    const museum::Exhibit* exhibit = museum_.find_exhibit(summary.exhibit_id);
    const bool is_room = summary.is_point && !task_control::point_of(summary.place);
    const museum::Translations title = is_room              ? guide_.name(summary.place)
                                       : exhibit != nullptr ? exhibit->title
                                                            : museum::Translations{};
    const auto text = [&](const std::string& language) {
      const std::string minutes = std::to_string(std::max(5, summary.charging_min));
      return interaction::sentence(
          sentence_of(summary), language, Mood::neutral, 0,
          summary.phase == MissionPhase::charging ? minutes : museum::translated(title, language));
    };
    message.languages = mission_.scheduler().programme().languages;
    for (const std::string& language : message.languages) message.texts.push_back(text(language));
    if (summary.phase == MissionPhase::asking) message.prompt = prompt_;
    message.exhibits_explained = summary.counters.exhibits_explained;
    message.tours_completed = summary.counters.tours_completed;
    message.requests_served = summary.counters.requests_served;
    message.agenda = summary.agenda;
    auto bytes = encode_cdr(message);  // without a stamp: equal states are equal bytes
    if (bytes == published_state_) return;
    published_state_ = std::move(bytes);
    message.header = {docent::to_message(now), "map"};
    state_.publish(std::move(message));
  }

  [[nodiscard]] static interaction::Sentence sentence_of(const task_control::MissionSummary& summary) {
    if (summary.phase == MissionPhase::waking) return interaction::Sentence::waking;
    if (summary.phase == MissionPhase::relocalizing) return interaction::Sentence::relocalizing;
    const bool is_room = summary.is_point && !task_control::point_of(summary.place);
    if (summary.is_point && summary.phase == MissionPhase::explaining)
      return is_room ? interaction::Sentence::at_room : interaction::Sentence::at_point;
    if (summary.is_point && !is_room && summary.phase == MissionPhase::driving) return interaction::Sentence::to_point;
    if (summary.phase == MissionPhase::driving)
      return summary.is_blocked ? interaction::Sentence::blocked : interaction::Sentence::driving;
    if (summary.says_farewell) return interaction::Sentence::farewell;
    if (summary.phase == MissionPhase::explaining) return interaction::Sentence::explaining;
    if (summary.phase == MissionPhase::asking) return interaction::Sentence::asking;
    if (summary.phase == MissionPhase::charging) return interaction::Sentence::charging;
    if (summary.needs_charge) return interaction::Sentence::battery_low;
    if (summary.phase == MissionPhase::going_home) return interaction::Sentence::going_home;
    return summary.phase == MissionPhase::idle ? interaction::Sentence::idle : interaction::Sentence::waiting;
  }

  transport::Bus& bus_;
  const museum::Museum& museum_;
  RoomGuide guide_;
  MuseumMode mode_;
  task_control::MissionStore store_;
  std::string set_aside_;
  task_control::Mission mission_;
  Mingling mingling_;
  transport::Publisher<docent_msgs::RequestBoard> board_;
  transport::Publisher<docent_msgs::Task> task_;
  transport::Publisher<docent_msgs::MissionState> state_;
  transport::Publisher<docent_msgs::Event> event_;
  docent_msgs::Prompt prompt_;
  bool is_localized_ = false;
  bool is_published_ = false;
  std::uint64_t published_revision_ = 0;
  std::string published_task_;
  std::vector<std::uint8_t> published_state_;
  std::string fault_;
};

}  // namespace

Result<std::unique_ptr<Module>> make_mission(const ModuleContext& context) {
  auto params = context.config.section<MissionModuleParams>("mission");
  if (!params) return tl::unexpected<Error>(params.error());
  context.config.amend(params->schedule);
  context.config.amend(params->golog);
  auto store = task_control::MissionStore::open(
      context.state / "mission.sqlite", deployment_name(context.seed, context.bus.now()), !context.virtual_time);
  if (!store) return tl::unexpected<Error>(store.error());
  auto memory = store->load();
  if (!memory) return tl::unexpected<Error>(memory.error());
  context.config.amend(*memory);
  auto planner = planner_of(context, *params);
  if (!planner) return tl::unexpected<Error>(planner.error());
  return std::make_unique<MissionModule>(context, *params, std::move(*planner), std::move(*store), std::move(*memory));
}

Result<robot::ParameterRows> parameters_of_mission(const robot::RobotConfig& config) {
  return robot::list_parameters<MissionModuleParams>(config, "mission");
}

}  // namespace docent::modules
