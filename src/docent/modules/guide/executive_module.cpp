#include "docent/modules/guide/executive_module.h"

#include <cmath>

#include "docent/interaction/speech/sentences.h"
#include "docent/interaction/speech/spoken_text.h"
#include "docent/messages/conversions.h"
#include "docent/modules/guide/drive_goals.h"
#include "docent/modules/shared/battery.h"
#include "docent/modules/shared/museum_mode.h"
#include "docent/task_control/golex/checkpoint.h"
#include "docent/task_control/golex/executive.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

constexpr Duration kTaskPeriod = std::chrono::milliseconds{250};

std::vector<std::string> texts_of(const std::vector<Answer>& answers) {
  std::vector<std::string> texts;
  for (const Answer answer : answers) texts.emplace_back(to_text(answer));
  return texts;
}

/// The question in each of the museum's languages.
docent_msgs::Prompt to_message(const task_control::Question& question, const museum::Museum& museum) {
  docent_msgs::Prompt prompt;
  if (question.id.empty()) return prompt;
  prompt.id = question.id;
  prompt.language = question.language;
  prompt.languages = museum.languages;
  if (prompt.languages.empty()) prompt.languages = {question.language};
  for (const std::string& language : prompt.languages)
    prompt.texts.push_back(interaction::sentence(question.sentence, language, Mood::neutral, question.variant));
  prompt.options = texts_of(question.options);
  prompt.default_option = to_text(question.default_option);
  prompt.deadline = docent::to_message(question.deadline);
  return prompt;
}

class ExecutiveModule final : public Module {
 public:
  ExecutiveModule(const ModuleContext& context, const task_control::ExecutiveParams& params,
                  task_control::Decomposition decomposition, task_control::ExecutiveMemory memory, std::string fault)
      : bus_{context.bus},
        museum_{context.museum},
        mode_{context},
        checkpoint_{context.state / "executive.json"},
        map_{map_hash(context.museum.map)},
        survives_{context.virtual_time ? Survives::process_death : Survives::power_failure},
        executive_{params, std::move(decomposition), std::move(memory), bus_.now()},
        fault_{std::move(fault)},
        goals_{bus_, params.docking.by_action},
        say_{bus_.publisher(topics::kSay)},
        state_{bus_.publisher(topics::kTaskState)},
        event_{bus_.publisher(topics::kEvent)},
        reaction_{bus_.publisher(topics::kReaction)},
        horn_{bus_.publisher(topics::kHorn)},
        music_{bus_.publisher(topics::kMusic)} {
    flush();
    bus_.subscribe<docent_msgs::Limits>(topics::kLimits, [this](const auto& limits) { mode_.limits(limits); });
    bus_.subscribe<docent_msgs::Task>(topics::kTask, [this](const auto& task) {
      executive_.set_task(to_task(task), bus_.now());
      flush();
    });
    bus_.subscribe<docent_msgs::GoalState>(topics::kGoalState, [this](const auto& state) {
      executive_.goal_report({state.id, parse<GoalStatus>(state.state), state.remaining_m, state.straight_m,
                              state.blocked_s, state.reason, state.detour, state.occupied},
                             bus_.now());
      flush();
    });
    bus_.subscribe<docent_msgs::SpeechState>(topics::kSpeechState, [this](const auto& state) {
      executive_.speech_report({state.id, parse<SpeechStatus>(state.state), from_message(state.start), state.duration},
                               bus_.now());
      flush();
    });
    bus_.subscribe<docent_msgs::Choice>(topics::kChoice, [this](const auto& choice) {
      executive_.choose(choice.prompt_id, parse<Answer>(choice.choice), bus_.now());
      flush();
    });
    bus_.subscribe<docent_msgs::AvoidState>(topics::kAvoidState, [this](const auto& state) {
      executive_.obstacle_report({state.path_blocked, state.unmapped_obstacle,
                                  state.path_blocked ? state.reason : std::string{}, state.low_obstacle},
                                 bus_.now());
    });
    bus_.subscribe<docent_msgs::People>(topics::kPeople, [this](const auto& seen) {
      std::vector<task_control::PersonSeen> people;
      for (const docent_msgs::Person& person : seen.people)
        people.push_back({person.id, {person.x, person.y}, std::hypot(person.vx, person.vy)});
      executive_.people_report(people, bus_.now());
    });
    bus_.subscribe<sensor_msgs::BatteryState>(topics::kBattery, [this](const auto& battery) { hear(battery); });
    bus_.subscribe<docent_msgs::Expression>(topics::kExpression, [this](const auto& expression) {
      executive_.mood_report(parse<Mood>(expression.mood).value_or(Mood::neutral), bus_.now());
    });
    bus_.every(kTaskPeriod, [this] {
      goals_.tick(executive_);
      executive_.tick(bus_.now());
      flush();
    });
  }

  [[nodiscard]] ModuleHealth health() const override {
    const std::string fault = fault_.empty() ? goals_.complaint() : fault_;
    return fault.empty() ? ModuleHealth{} : ModuleHealth{"degraded", fault};
  }

 private:
  void hear(const sensor_msgs::BatteryState& battery) {
    if (!goals_.knows_contact()) executive_.charging_report(is_charging(battery));
  }

  [[nodiscard]] task_control::ExecutiveTask to_task(const docent_msgs::Task& task) const {
    task_control::ExecutiveTask result;
    result.order = {
        task.id,       Word<TaskKind>{task.kind}, task.exhibit_id, {task.x, task.y, Angle::radians(task.theta)},
        task.language, task.offer_more,           task.tour_id};
    const auto gaze = parse<GazeStrategy>(task.gaze);
    const auto face = parse<Mood>(task.face);
    const auto speech = parse<SpeechAct>(task.speech);
    if (gaze && face && speech) result.style = interaction::AttractionAction{*gaze, *face, *speech};
    if (result.order.kind == TaskKind::point) result.wait_s = mode_.wait_s(bus_.now());
    if (const museum::Exhibit* exhibit = museum_.find_exhibit(task.exhibit_id)) {
      result.title = museum::translated(exhibit->title, task.language);
      result.short_text = interaction::spoken_text(museum::translated(exhibit->short_text, task.language));
      result.long_text = interaction::spoken_text(museum::translated(exhibit->long_text, task.language));
      result.wait_s = mode_.wait_s(bus_.now());
    }
    return result;
  }

  void flush() {
    task_control::Executive::Actions actions = executive_.take_actions();
    if (actions.must_save) {
      // A robot whose disk is full goes on guiding; only a restart would forget the step.
      auto saved = task_control::save_checkpoint(checkpoint_, executive_.memory(), map_, survives_);
      fault_ = saved ? "" : saved.error().message;
    }
    if (actions.drive) goals_.order(*actions.drive);
    for (task_control::Utterance& line : actions.utterances) {
      say_.publish({std::move(line.id), std::move(line.text), std::move(line.language), to_text(line.mood)});
    }
    const auto stamp = docent::to_message(bus_.now());
    if (actions.report) {
      task_control::TaskReport& report = *actions.report;
      state_.publish({{stamp, "map"},
                      std::move(report.id),
                      to_text(report.state),
                      report.reason.text(),
                      to_message(report.question, museum_),
                      report.took_long,
                      std::move(report.look)});
    }
    if (actions.music) music_.publish({{stamp, "base_link"}, *actions.music});
    for (std::string& reason : actions.horns) horn_.publish({{stamp, "base_link"}, std::move(reason)});
    for (task_control::LadderStep& step : actions.reactions) {
      if (step.rung == Rung::horn) horn_.publish({{stamp, "base_link"}, step.cause});
      reaction_.publish(
          {{stamp, "map"}, actions.reactions_of, to_text(step.rung), std::move(step.cause), step.after_s, step.count});
    }
    for (task_control::Happening& happening : actions.happenings) {
      event_.publish({{stamp, "map"},
                      to_text(happening.kind),
                      std::move(happening.subject),
                      std::move(happening.detail),
                      happening.value});
    }
  }

  transport::Bus& bus_;
  const museum::Museum& museum_;
  MuseumMode mode_;
  std::filesystem::path checkpoint_;
  std::string map_;
  Survives survives_;
  task_control::Executive executive_;
  std::string fault_;
  DriveGoals goals_;
  transport::Publisher<docent_msgs::Say> say_;
  transport::Publisher<docent_msgs::TaskState> state_;
  transport::Publisher<docent_msgs::Event> event_;
  transport::Publisher<docent_msgs::Reaction> reaction_;
  transport::Publisher<docent_msgs::Horn> horn_;
  transport::Publisher<docent_msgs::Music> music_;
};

}  // namespace

Result<std::unique_ptr<Module>> make_executive(const ModuleContext& context) {
  auto params = context.config.section<task_control::ExecutiveParams>("executive");
  if (!params) return tl::unexpected<Error>(params.error());
  auto decomposition = task_control::load_decomposition(context.museum.folder);
  if (!decomposition) return tl::unexpected<Error>(decomposition.error());
  auto memory = task_control::load_checkpoint(context.state / "executive.json", map_hash(context.museum.map));
  // A damaged checkpoint costs the running step, not the robot: the mission's task begins again.
  return std::make_unique<ExecutiveModule>(context, *params, std::move(*decomposition),
                                           memory.value_or(task_control::ExecutiveMemory{}),
                                           memory ? "" : memory.error().message);
}

Result<robot::ParameterRows> parameters_of_executive(const robot::RobotConfig& config) {
  return robot::list_parameters<task_control::ExecutiveParams>(config, "executive");
}

}  // namespace docent::modules
