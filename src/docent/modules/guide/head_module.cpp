#include "docent/modules/guide/head_module.h"

#include <optional>

#include "docent/interaction/head/face_joints.h"
#include "docent/interaction/head/head_control.h"
#include "docent/messages/conversions.h"
#include "docent/modules/guide/people_around.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

constexpr Duration kGazePeriod = std::chrono::milliseconds{100};

/// Section `head`: what face and head show.
struct HeadParams {
  interaction::MoodParams mood;        ///< from happy to angry, by how long people block the way
  interaction::GazeChoiceParams gaze;  ///< at whom and what it looks
  interaction::NeckParams neck;        ///< how the head turns there
  interaction::FaceParams face;        ///< how far brows and mouth go
  template <class V>
  void visit(V& v) {
    v("mood", mood);
    v("gaze", gaze);
    v("neck", neck);
    v("face", face);
  }
  [[nodiscard]] Result<void> validate() const {
    if (auto valid = mood.validate(); !valid) return fail("head." + valid.error().message);
    if (auto valid = gaze.validate(); !valid) return fail("head." + valid.error().message);
    if (auto valid = neck.validate(); !valid) return fail("head." + valid.error().message);
    if (auto valid = face.validate(); !valid) return fail("head." + valid.error().message);
    return {};
  }
};

interaction::HeadTask to_task(const docent_msgs::Task& message, const museum::Museum& museum) {
  const museum::Exhibit* exhibit = museum.find_exhibit(message.exhibit_id);
  return {message.id, parse<TaskKind>(message.kind),
          exhibit != nullptr ? std::optional{exhibit->look_at} : std::nullopt, parse<GazeStrategy>(message.gaze),
          parse<Mood>(message.face)};
}

class HeadModule final : public Module {
 public:
  HeadModule(const ModuleContext& context, const HeadParams& params)
      : bus_{context.bus},
        museum_{context.museum},
        head_{{params.mood, params.gaze, params.neck}, Rng{context.seed}.stream("mood")},
        expression_{bus_.publisher(topics::kExpression)},
        face_{params.face},
        joints_{bus_.publisher(topics::kHeadCommand)},
        pose_{reach_of(context.config.body())},
        around_{bus_} {
    bus_.subscribe<docent_msgs::Task>(topics::kTask, [this](const auto& task) { head_.task(to_task(task, museum_)); });
    bus_.subscribe<docent_msgs::TaskState>(topics::kTaskState, [this](const auto& state) {
      head_.task_state({state.id, parse<TaskStatus>(state.state), parse<LookFor>(state.look)});
    });
    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) { pose_.on_belief(belief); });
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odom) { pose_.on_odometry(odom); });
    bus_.subscribe<docent_msgs::AvoidState>(topics::kAvoidState, [this](const auto& state) {
      const bool by_person = state.path_blocked && state.unmapped_obstacle && !state.low_obstacle;
      if (by_person) head_.block(bus_.now());
    });
    bus_.subscribe<docent_msgs::Reaction>(topics::kReaction, [this](const auto& reaction) {
      const auto rung = parse<Rung>(reaction.step);
      // It sounds the horn and asks before people alone.
      if (rung == Rung::horn || rung == Rung::ask) head_.block(bus_.now());
      if (rung == Rung::free) head_.unblock(bus_.now());
    });
    bus_.subscribe<docent_msgs::Gaze>(topics::kGaze, [this](const auto& gaze) {
      const bool is_none = parse<GazeAt>(gaze.at).value_or(GazeAt::none) == GazeAt::none;
      head_.want(is_none ? std::nullopt : std::optional{Angle::radians(gaze.heading)}, bus_.now());
    });
    bus_.subscribe<docent_msgs::OfficeState>(topics::kOfficeState, [this](const auto& office) {
      head_.point_at(office.points ? std::optional{Point2{office.x, office.y}} : std::nullopt);
    });
    bus_.subscribe<docent_msgs::SpeechState>(topics::kSpeechState, [this](const auto& speech) {
      head_.speech(parse<SpeechStatus>(speech.state) == SpeechStatus::speaking, from_message(speech.start),
                   speech.duration);
    });
    bus_.every(kGazePeriod, [this] { step(); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!around_.odom_from_base()) return {"degraded", "no odometry"};
    return {};
  }

 private:
  void step() {
    const Time now = bus_.now();
    const auto people = around_.people().value_or(std::vector<interaction::SeenPerson>{});
    const auto map_from_base = pose_.localized() ? pose_.map_from_base() : std::nullopt;
    publish(head_.step({around_.odom_from_base(), map_from_base, people}, now), now);
  }

  void publish(const interaction::HeadShown& shown, Time now) {
    const std_msgs::Header header{to_message(now), "base_link"};
    expression_.publish({header, to_text(shown.mood), shown.valence, shown.is_speaking, to_text(shown.at),
                         shown.pan.position, shown.tilt.position});
    const interaction::FaceJoints face = interaction::face_joints(shown, now, face_);
    joints_.publish(
        {header,
         {"head_pan_joint", "head_tilt_joint", "left_brow_joint", "right_brow_joint", "mouth_joint", "jaw_joint"},
         {shown.pan.position, shown.tilt.position, face.left_brow, face.right_brow, face.mouth, face.jaw},
         {},
         {}});
  }

  transport::Bus& bus_;
  const museum::Museum& museum_;
  interaction::HeadControl head_;
  transport::Publisher<docent_msgs::Expression> expression_;
  interaction::FaceParams face_;
  transport::Publisher<sensor_msgs::JointState> joints_;
  PoseTracker pose_;
  PeopleAround around_;
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
