#include "docent/modules/guide/mission_module.h"

#include <cmath>
#include <cstdio>
#include <memory>

#include "docent/base/random.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/messages/conversions.h"
#include "docent/modules/guide/mingling.h"
#include "docent/modules/guide/room_guide.h"
#include "docent/modules/shared/battery.h"
#include "docent/modules/shared/museum_mode.h"
#include "docent/task_control/golog_planner/golog_planner.h"
#include "docent/task_control/mission_service/daily_tours.h"
#include "docent/task_control/mission_service/mission_service.h"
#include "docent/task_control/mission_service/museum_programme.h"
#include "docent/task_control/plan_controller/plan_controller.h"
#include "docent/vocabulary/uuid.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

constexpr Duration kMissionPeriod = std::chrono::milliseconds{500};

std::string deployment_name(std::uint64_t seed, Time now) {
  char name[20];
  const auto hash = hash_of(std::to_string(seed) + "/" + std::to_string(now.nanoseconds));
  std::snprintf(name, sizeof name, "%08llx", static_cast<unsigned long long>(hash & 0xffffffffU));
  return name;
}

docent_msgs::RequestBoard to_message(const task_control::RequestBoard& board, Time now) {
  docent_msgs::RequestBoard message;
  message.header.stamp = docent::to_message(now);
  message.revision = board.revision();
  for (const task_control::BoardEntry& entry : board.entries()) {
    const task_control::VisitorRequest& request = entry.request;
    message.requests.push_back({{request.id, docent::to_message(request.stamp), request.source.text(), request.visitor,
                                 request.kind.text(), request.target, request.viewpoint, request.language},
                                to_text(entry.status),
                                entry.reason.text(),
                                docent::to_message(entry.created),
                                docent::to_message(entry.changed)});
  }
  return message;
}

docent_msgs::Task to_message(const task_control::MissionTask& task) {
  const task_control::TaskOrder& order = task.order;
  const Pose2& pose = order.map_from_base;
  docent_msgs::Task message{order.id,       order.kind.text(), order.exhibit_id, pose.x, pose.y, pose.theta.radians(),
                            order.language, order.offer_more,  order.tour_id,    {},     {},     {}};
  if (task.style) {
    message.gaze = to_text(task.style->gaze);
    message.face = to_text(task.style->face);
    message.speech = to_text(task.style->speech);
  }
  return message;
}

docent_msgs::Event to_message(task_control::Happening happening, Time now) {
  return {{docent::to_message(now), "map"},
          to_text(happening.kind),
          std::move(happening.subject),
          std::move(happening.detail),
          happening.value};
}

docent_msgs::Event to_message(const interaction::AttractionTrial& trial, Time now) {
  const interaction::AttractionAction& action = trial.action;
  return {{docent::to_message(now), "map"},
          to_text(EventKind::attraction_trial),
          to_text(interaction::style_of(action)),
          std::string{to_text(action.gaze)} + " " + to_text(action.face) + " " + to_text(action.speech),
          trial.reward};
}

docent_msgs::MissionState to_message(task_control::MissionStatus status, Time now) {
  docent_msgs::MissionState message;
  message.header = {docent::to_message(now), "map"};
  message.phase = to_text(status.phase);
  message.tour_id = std::move(status.tour_id);
  message.exhibit_id = std::move(status.exhibit_id);
  task_control::ShownQuestion& question = status.question;
  message.prompt = {std::move(question.id),
                    std::move(question.language),
                    std::move(question.languages),
                    std::move(question.texts),
                    std::move(question.options),
                    std::move(question.default_option),
                    docent::to_message(question.deadline)};
  message.exhibits_explained = status.exhibits_explained;
  message.tours_completed = status.tours_completed;
  message.requests_served = status.requests_served;
  message.agenda = std::move(status.agenda);
  message.languages = std::move(status.languages);
  message.texts = std::move(status.texts);
  return message;
}

task_control::ShownQuestion question_of(const docent_msgs::Prompt& prompt) {
  return {prompt.id,
          prompt.language,
          prompt.languages,
          prompt.texts,
          prompt.options,
          prompt.default_option,
          from_message(prompt.deadline)};
}

task_control::VisitorRequest request_of(const docent_msgs::Request& message) {
  return {message.id,
          from_message(message.stamp),
          Word<RequestSource>{message.source},
          message.visitor,
          Word<RequestKind>{message.kind},
          message.target,
          message.viewpoint,
          message.language};
}

/// Staff wants the robot to go there, and to look that way then.
task_control::VisitorRequest request_of(const geometry_msgs::PoseStamped& goal, Time now, Rng& rng) {
  const Pose2 map_from_base = from_message(goal.pose);
  char place[96];
  std::snprintf(place, sizeof place, "%.2f,%.2f,%.2f", map_from_base.x, map_from_base.y, map_from_base.theta.radians());
  return {make_uuid_v7(now, rng), now, RequestSource::staff, topics::kGoalPose.name, RequestKind::point, place, -1, ""};
}

/// Section `mission`, with the choice of its planner.
struct MissionModuleParams : task_control::MissionParams {
  std::string planner = "plans";  ///< plans: Minerva's controller; golog: the museum's tour.pl, or the shipped one
  task_control::GologPlannerParams golog;  ///< of the planner golog
  MinglingParams attraction;               ///< how it learns to attract people
  bool goal_poses = false;                 ///< goal_pose, which rviz2 sends, is a wish of the staff to go there
  template <class V>
  void visit(V& v) {
    task_control::MissionParams::visit(v);
    v("planner", planner);
    v("golog", golog);
    v("attraction", attraction);
    v("goal_poses", goal_poses);
  }
  [[nodiscard]] Result<void> validate() const {
    if (planner != "plans" && planner != "golog") return fail("mission.planner must be plans or golog");
    if (auto valid = golog.validate(); !valid) return valid;
    if (auto valid = attraction.validate(); !valid) return fail("mission.attraction." + valid.error().message);
    return task_control::MissionParams::validate();
  }
};

class MissionModule final : public Module {
 public:
  MissionModule(const ModuleContext& context, const MissionModuleParams& params,
                std::unique_ptr<task_control::Planner> planner, task_control::MissionStore store,
                task_control::MissionMemory memory)
      : bus_{context.bus},
        museum_{context.museum},
        daily_tours_{context.museum},
        guide_{context.museum},
        mode_{context},
        mingling_{context, params.attraction},
        service_{mission_in(context, params, std::move(planner), std::move(memory)), std::move(store), context.museum,
                 mingling_, [this](const std::string& room) { return guide_.name(room); }},
        board_{bus_.publisher(topics::kRequestBoard)},
        task_{bus_.publisher(topics::kTask)},
        state_{bus_.publisher(topics::kMissionState)},
        event_{bus_.publisher(topics::kEvent)},
        say_{bus_.publisher(topics::kSay)} {
    tell(service_.begin(bus_.now()));
    subscribe();
    take_goal_poses(params.goal_poses, Rng{context.seed}.stream("goal_pose"));
  }

  [[nodiscard]] ModuleHealth health() const override {
    const std::string fault = service_.fault(bus_.now());
    return fault.empty() ? ModuleHealth{"ready", mode_.clock().change()} : ModuleHealth{"degraded", fault};
  }

 private:
  std::unique_ptr<task_control::Mission> mission_in(const ModuleContext& context, const MissionModuleParams& params,
                                                    std::unique_ptr<task_control::Planner> planner,
                                                    task_control::MissionMemory memory) {
    const auto ways = task_control::ways_in(context.museum, context.config.body().radius);
    const auto rooms = [this]() -> const task_control::Rooms& { return guide_.rooms(); };
    return std::make_unique<task_control::Mission>(params, task_control::programme_on_map(context.museum, ways, rooms),
                                                   task_control::travel_by(ways), std::move(memory), std::move(planner),
                                                   bus_.now());
  }

  void subscribe() {
    bus_.subscribe<docent_msgs::Request>(topics::kRequest, [this](const auto& message) {
      tell_mode();
      tell(service_.request(request_of(message), bus_.now()));
    });
    bus_.subscribe<docent_msgs::TaskState>(topics::kTaskState, [this](const auto& message) {
      tell(service_.report(message.id, parse<TaskStatus>(message.state), Reason::from_text(message.reason),
                           question_of(message.prompt), message.took_long, bus_.now()));
    });
    bus_.subscribe<docent_msgs::Votes>(topics::kVotes, [this](const auto& message) {
      tell(service_.votes({message.round, message.tours, message.counts}, bus_.now()));
    });
    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) {
      const auto& found = belief.hypotheses;
      const Point2 position = found.empty() ? Point2{} : Point2{found.front().x, found.front().y};
      tell(service_.localization(belief.localized && !found.empty(), position, bus_.now()));
    });
    bus_.subscribe<docent_msgs::Limits>(topics::kLimits, [this](const auto& message) { mode_.limits(message); });
    bus_.subscribe<sensor_msgs::BatteryState>(topics::kBattery, [this](const auto& message) {
      if (says_nothing(message) || !std::isfinite(message.percentage)) return;
      // Many a gauge never shows a whole charge: full is what the battery calls so.
      const double charge = is_full(message) ? 1.0 : static_cast<double>(message.percentage);
      service_.battery(charge, is_charging(message), bus_.now());
    });
    bus_.every(kMissionPeriod, [this] {
      mode_.clock().look();
      service_.time_of_day(mode_.minute_of_day(bus_.now()) / 60);
      tell_mode();
      look_at_daily_tours();
      tell(service_.tick(bus_.now()));
    });
  }

  void take_goal_poses(bool are_obeyed, const Rng& seed) {
    bus_.subscribe<geometry_msgs::PoseStamped>(
        topics::kGoalPose, [this, are_obeyed, rng = Rng{seed}](const auto& goal) mutable {
          if (!are_obeyed) return bus_.refuse(topics::kGoalPose.name, {"it", "is not obeyed: mission.goal_poses"});
          tell_mode();
          tell(service_.request(request_of(goal, bus_.now(), rng), bus_.now()));
        });
  }

  void look_at_daily_tours() {
    const Time now = bus_.now();
    const bool is_open = mode_.takes_requests() && parse<OperatingMode>(mode_.name(now)) == OperatingMode::open;
    auto news =
        daily_tours_.look(mode_.minute_of_day(now), mode_.clock().day(now), is_open, service_.may_speak(now), now);
    if (!news.language.empty()) {
      const std::string tour = task_control::name_and_time(museum_, *news.soon, news.language);
      const auto which = interaction::Sentence::tour_announced;
      say_.publish({"daily-tour-" + std::to_string(now.nanoseconds),
                    interaction::sentence(which, news.language, Mood::happy, 0, tour), news.language,
                    to_text(Mood::happy)});
    }
    service_.expect_daily_tour(std::move(news.soon));
    if (news.begins) tell(service_.request(std::move(*news.begins), now));
  }

  void tell_mode() { service_.limits(mode_.takes_requests(), parse<OperatingMode>(mode_.name(bus_.now()))); }

  void tell(task_control::MissionNews news) {
    const Time now = bus_.now();
    for (task_control::Happening& happening : news.happenings) event_.publish(to_message(std::move(happening), now));
    if (news.board) board_.publish(to_message(*news.board, now));
    if (news.trial) event_.publish(to_message(*news.trial, now));
    if (news.task) task_.publish(to_message(*news.task));
    if (news.status) state_.publish(to_message(std::move(*news.status), now));
  }

  transport::Bus& bus_;
  const museum::Museum& museum_;
  task_control::DailyTours daily_tours_;
  RoomGuide guide_;
  MuseumMode mode_;
  Mingling mingling_;
  task_control::MissionService service_;
  transport::Publisher<docent_msgs::RequestBoard> board_;
  transport::Publisher<docent_msgs::Task> task_;
  transport::Publisher<docent_msgs::MissionState> state_;
  transport::Publisher<docent_msgs::Event> event_;
  transport::Publisher<docent_msgs::Say> say_;
};

Result<std::unique_ptr<task_control::Planner>> planner_of(const ModuleContext& context,
                                                          const MissionModuleParams& params) {
  if (params.planner == "plans") return std::make_unique<task_control::PlanController>();
  const auto programme = task_control::programme_of(context.museum);
  const auto travel = task_control::travel_by(task_control::ways_in(context.museum, context.config.body().radius));
  const auto own = task_control::golog_file(context.museum.folder);
  auto program = task_control::GologProgram::load(params.golog.program, own, programme, travel);
  if (program) return std::make_unique<task_control::GologPlanner>(params.golog, std::move(*program));
  // Visitors are guided all the same, and whoever wrote the program reads why it is not it.
  auto shipped =
      task_control::GologProgram::load(params.golog.program, task_control::shipped_golog_file(), programme, travel);
  if (!shipped) return tl::unexpected<Error>(program.error());
  return std::make_unique<task_control::GologPlanner>(params.golog, std::move(*shipped),
                                                      program.error().message + "; the shipped program guides");
}

}  // namespace

Result<std::unique_ptr<Module>> make_mission(const ModuleContext& context) {
  auto params = context.config.section<MissionModuleParams>("mission");
  if (!params) return tl::unexpected<Error>(params.error());
  context.config.amend(params->schedule);
  context.config.amend(params->staff);
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
