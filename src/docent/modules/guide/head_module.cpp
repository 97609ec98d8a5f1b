#include "docent/modules/guide/head_module.h"

#include <optional>

#include "docent/interaction/head/gaze_choice.h"
#include "docent/interaction/head/neck.h"
#include "docent/interaction/mood/mood_machine.h"
#include "docent/messages/conversions.h"
#include "docent/modules/guide/people_around.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

constexpr Duration kGazePeriod = std::chrono::milliseconds{100};
constexpr Duration kStaleAfter = std::chrono::seconds{1};  // whoever is silent for so long may be dead
constexpr Duration kMouthClosesAfter = std::chrono::seconds{1};

/// Section `head`: what face and head show.
struct HeadParams {
  interaction::MoodParams mood;        ///< from happy to angry, by how long people block the way
  interaction::GazeChoiceParams gaze;  ///< at whom and what it looks
  interaction::NeckParams neck;        ///< how the head turns there
  template <class V>
  void visit(V& v) {
    v("mood", mood);
    v("gaze", gaze);
    v("neck", neck);
  }
  [[nodiscard]] Result<void> validate() const {
    if (auto valid = mood.validate(); !valid) return fail("head." + valid.error().message);
    if (auto valid = gaze.validate(); !valid) return fail("head." + valid.error().message);
    if (auto valid = neck.validate(); !valid) return fail("head." + valid.error().message);
    return {};
  }
};

class HeadModule final : public Module {
 public:
  HeadModule(const ModuleContext& context, const HeadParams& params)
      : bus_{context.bus},
        museum_{context.museum},
        mood_{params.mood, Rng{context.seed}.stream("mood")},
        gaze_choice_{params.gaze},
        neck_{params.neck},
        expression_{bus_.publisher(topics::kExpression)},
        joints_{bus_.publisher(topics::kJointStates)},
        around_{bus_} {
    bus_.subscribe<docent_msgs::Task>(topics::kTask, [this](const auto& task) { task_ = task; });
    bus_.subscribe<docent_msgs::TaskState>(topics::kTaskState, [this](const auto& state) { task_state_ = state; });
    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) { pose_.on_belief(belief); });
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odom) { pose_.on_odometry(odom); });
    bus_.subscribe<docent_msgs::AvoidState>(topics::kAvoidState, [this](const auto& state) {
      const bool by_person = state.path_blocked && state.unmapped_obstacle && !state.low_obstacle;
      if (by_person) blocked_until_ = bus_.now() + kStaleAfter;
    });
    bus_.subscribe<docent_msgs::Reaction>(topics::kReaction, [this](const auto& reaction) {
      const auto rung = parse<Rung>(reaction.step);
      // It sounds the horn and asks before people alone.
      if (rung == Rung::horn || rung == Rung::ask) blocked_until_ = bus_.now() + kStaleAfter;
      if (rung == Rung::free) blocked_until_ = bus_.now();
    });
    bus_.subscribe<docent_msgs::Gaze>(topics::kGaze, [this](const auto& gaze) {
      gaze_ = gaze;
      gaze_received_ = bus_.now();
    });
    bus_.subscribe<docent_msgs::SpeechState>(topics::kSpeechState, [this](const auto& speech) { speech_ = speech; });
    bus_.every(kGazePeriod, [this] { step(); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!around_.odom_from_base()) return {"degraded", "no odometry"};
    return {};
  }

 private:
  void step() {
    const Time now = bus_.now();
    const bool is_blocked = now < blocked_until_;
    mood_.put_on(is_mingling() && !is_blocked ? parse<Mood>(task_.face) : std::nullopt);
    mood_.step(is_blocked, now);
    const auto people = around_.people().value_or(std::vector<interaction::SeenPerson>{});
    interaction::HeadView view = view_of_task();
    view.wanted = wanted(now);
    view.is_blocked = is_blocked;
    view.people = people;
    const interaction::GazeTarget target = gaze_choice_.choose(view, now);
    neck_.step(target, now);
    publish(target, now);
  }

  [[nodiscard]] bool is_under_way() const {
    const auto status = parse<TaskStatus>(task_state_.state);
    const bool is_over = !status || status == TaskStatus::done || status == TaskStatus::failed;
    return !task_.id.empty() && task_state_.id == task_.id && !is_over;
  }
  [[nodiscard]] bool is_mingling() const { return is_under_way() && parse<TaskKind>(task_.kind) == TaskKind::mingle; }

  [[nodiscard]] interaction::HeadView view_of_task() const {
    interaction::HeadView view;
    if (task_.id.empty()) return view;
    view.task = parse<TaskKind>(task_.kind);
    if (task_state_.id == task_.id) view.status = parse<TaskStatus>(task_state_.state);
    if (is_under_way()) view.look = parse<LookFor>(task_state_.look);
    if (is_mingling()) view.company = parse<GazeStrategy>(task_.gaze).value_or(GazeStrategy::nearest);
    const museum::Exhibit* exhibit = museum_.find_exhibit(task_.exhibit_id);
    const auto map_from_base = pose_.localized() ? pose_.map_from_base() : std::nullopt;
    if (exhibit != nullptr && map_from_base) view.exhibit = inverse(*map_from_base) * exhibit->look_at;
    return view;
  }

  [[nodiscard]] std::optional<Angle> wanted(Time now) const {
    const auto odom_from_base = around_.odom_from_base();
    if (!odom_from_base || now - gaze_received_ > kStaleAfter) return std::nullopt;
    if (parse<GazeAt>(gaze_.at).value_or(GazeAt::none) == GazeAt::none) return std::nullopt;
    return Angle::radians(gaze_.heading) - odom_from_base->theta;
  }

  [[nodiscard]] bool is_speaking(Time now) const {
    // Should `sound` die in the middle of a line, the mouth closes nevertheless.
    return parse<SpeechStatus>(speech_.state) == SpeechStatus::speaking &&
           now <= from_message(speech_.start) + seconds(speech_.duration) + kMouthClosesAfter;
  }

  void publish(const interaction::GazeTarget& target, Time now) {
    const std_msgs::Header header{to_message(now), "base_link"};
    expression_.publish({header, to_text(mood_.mood()), mood_.valence(), is_speaking(now), to_text(target.at),
                         neck_.pan().position, neck_.tilt().position});
    joints_.publish({header,
                     {"head_pan_joint", "head_tilt_joint"},
                     {neck_.pan().position, neck_.tilt().position},
                     {neck_.pan().velocity, neck_.tilt().velocity},
                     {}});
  }

  transport::Bus& bus_;
  const museum::Museum& museum_;
  interaction::MoodMachine mood_;
  interaction::GazeChoice gaze_choice_;
  interaction::Neck neck_;
  transport::Publisher<docent_msgs::Expression> expression_;
  transport::Publisher<sensor_msgs::JointState> joints_;
  PoseTracker pose_;
  PeopleAround around_;
  docent_msgs::Task task_;
  docent_msgs::TaskState task_state_;
  docent_msgs::Gaze gaze_;
  Time gaze_received_{};
  docent_msgs::SpeechState speech_;
  Time blocked_until_{};
};

}  // namespace

Result<std::unique_ptr<Module>> make_head(const ModuleContext& context) {
  auto params = context.config.section<HeadParams>("head");
  if (!params) return tl::unexpected<Error>(params.error());
  return std::make_unique<HeadModule>(context, *params);
}

Result<robot::ParameterRows> parameters_of_head(const robot::RobotConfig& config) {
  return robot::list_parameters<HeadParams>(config, "head");
}

}  // namespace docent::modules
