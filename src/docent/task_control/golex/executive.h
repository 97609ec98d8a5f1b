#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "docent/base/result.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/task_control/golex/approach_watch.h"
#include "docent/task_control/golex/decomposition.h"
#include "docent/task_control/golex/docking.h"
#include "docent/task_control/golex/executive_params.h"
#include "docent/task_control/golex/executive_task.h"
#include "docent/task_control/golex/somebody_there.h"
#include "docent/task_control/reaction_ladder/reaction_ladder.h"
#include "docent/task_control/tour_scheduler/programme.h"
#include "docent/vocabulary/reason.h"

namespace docent::task_control {

/// How far the executive has come with its task.
enum class Phase { idle, running, done, failed };
[[nodiscard]] constexpr auto words_of(Phase) { return std::array{"idle", "running", "done", "failed"}; }

/// All that must survive a restart of the executive. Ids of goals, utterances and questions follow from the task's id
/// and the directive's name, so doing one again sends the same id, and who has done it already does nothing.
struct ExecutiveMemory {
  ExecutiveTask task;
  Phase phase = Phase::idle;
  int item = 0;                         ///< of the task's action, while it runs
  std::vector<std::string> finished{};  ///< names of the item's directives that are over
  Time item_began;
  Time drive_began;
  Reason reason;
  bool took_long = false;  ///< the visitor asked for more
  bool moved = true;       ///< its last drive led it from one place to another
  std::string look;        ///< where the head shall look; empty: nothing was said of it
  std::string tour;        ///< whose stops it visits; a tour begins at its first one
  bool tour_begins = false;
};

struct DriveOrder {
  std::string id;  ///< empty: stay
  Pose2 map_from_base;
  bool relocalize = false;
  double position_tolerance = 0.25;  ///< [m]
  double heading_tolerance = 0.1;    ///< [rad]
};
struct GoalReport {
  std::string id;
  std::optional<GoalStatus> state;  ///< nullopt: one that is not known
  double remaining_m = 0.0;         ///< of its way
  double straight_m = 0.0;          ///< as the crow flies
  double blocked_s = 0.0;           ///< without progress
  std::string reason;               ///< in English, for logs
  std::string detour;
  bool is_occupied = false;  ///< something that is not in the map stands where the robot would stand
};
/// What the collision avoidance says of the way ahead; counts for a second, for who is silent may be dead.
struct ObstacleReport {
  bool is_hindered = false;  ///< an obstacle in the wanted direction holds the robot up
  bool is_unmapped = false;  ///< that obstacle is not in the map
  std::string reason;        ///< a word of ReasonWord, or a diagnosis in English
  bool is_thing = false;     ///< it, or what has touched the robot here, lies below the lasers, which see nobody there
};
struct Utterance {
  std::string id;
  std::string text;
  std::string language;
  Mood mood = Mood::neutral;
};
struct SpeechReport {
  std::string id;
  std::optional<SpeechStatus> state;  ///< nullopt: one that is not known, and so not speaking
  Time start;
  double duration_s = 0.0;
};
struct Question {
  std::string id;  ///< empty: nothing is asked
  interaction::Sentence sentence = interaction::Sentence::offer_more;
  std::string language{};  ///< in which it is spoken
  int variant = 0;         ///< of the sentence
  std::vector<Answer> options;
  std::optional<Answer> default_option;
  Time deadline;
};
struct TaskReport {
  std::string id;
  std::optional<TaskStatus> state;  ///< nullopt: there is no task
  Reason reason;
  Question question;
  bool took_long = false;
  std::string look;
};

/// GOLEX ([Rhino1999] 4.3): does one task after the other. The decomposition says of which directives each task's
/// action consists; the executive begins them, those of one item at once, watches them, recovers and reports.
///
/// A drive whose way is blocked climbs the reaction ladder. Every directive has a limit, so that a dead module holds
/// nothing up: a drive fails after its patience, a speech counts as spoken 1.5 times its foreseen length plus 5 s after
/// it was sent, a question has its default. Deterministic; knows nothing of messages and files.
class Executive {
 public:
  Executive(const ExecutiveParams& params, Decomposition decomposition, ExecutiveMemory memory, Time now);

  /// The task to work on. The same id again changes nothing; another one replaces the present; an empty one stops it.
  void set_task(ExecutiveTask task, Time now);
  void goal_report(const GoalReport& report, Time now);
  void obstacle_report(const ObstacleReport& report, Time now);
  void speech_report(const SpeechReport& report, Time now);
  /// What the battery says; nullopt: nothing of this.
  void charging_report(std::optional<bool> is_charging) {
    contact_ = !is_charging ? Contact::unknown : *is_charging ? Contact::made : Contact::none;
  }
  /// Likewise of a base that docks by itself, which knows more than its battery.
  void contact_report(Contact contact) { contact_ = contact; }
  /// How docking by the charger's tag goes, of the order named by `tag_order`; ready without one: it could.
  void tag_report(ByTag by_tag) { by_tag_ = by_tag; }
  /// An order to dock by the tag of the charger that stands at `map_from_base`; nullopt: none.
  [[nodiscard]] std::optional<DriveOrder> tag_order() const;
  /// It waits at the charger for a contact, or stands there with one: a base that docks by itself is to be docked.
  [[nodiscard]] bool wants_contact() const;
  /// It is on its way to the charger with a task that is over once it has a contact.
  [[nodiscard]] bool is_on_way_to_charger() const;
  /// Ends that way: the base stands in its dock already.
  void stand_at_charger(Time now);
  /// The mood that the face shows: so the robot asks for the way. Counts for a second, then its own reckoning.
  void mood_report(Mood mood, Time now);
  /// All who are followed now.
  void people_report(std::span<const PersonSeen> people, Time now) { somebody_.see(people, now); }
  void choose(const std::string& question_id, std::optional<Answer> option, Time now);
  /// Several times a second.
  void tick(Time now);

  /// What is to be published, in this order, after the memory was saved if `must_save`.
  struct Actions {
    bool must_save = false;
    std::optional<DriveOrder> drive;
    std::vector<Utterance> utterances;
    std::optional<TaskReport> report;
    std::vector<Happening> happenings;
    std::vector<LadderStep> reactions;  ///< to a blocked way, of the drive `reactions_of`
    std::string reactions_of;
    std::vector<std::string> horns{};  ///< reasons
    std::optional<bool> music{};       ///< play or stop
  };
  [[nodiscard]] Actions take_actions() { return std::exchange(actions_, {}); }
  [[nodiscard]] const ExecutiveMemory& memory() const { return memory_; }
  [[nodiscard]] const std::string& task_id() const { return memory_.task.order.id; }

 private:
  /// Goes to the item, or the next one whose condition holds; behind the last one the task is done.
  void begin_item(int item, Time now);
  void begin(const Directive& directive, Time now);
  void end(const Directive& directive, Time now);
  void finish(bool is_success, const Reason& reason);
  void resume(Time now);
  [[nodiscard]] bool holds(Condition condition) const;
  /// What the present item consists of; nothing while no task runs.
  [[nodiscard]] const std::vector<Directive>& together() const;
  /// The action leads the robot somewhere.
  [[nodiscard]] bool has_drive() const { return leads_from(0); }
  /// How the words of the present item sound.
  [[nodiscard]] Mood mood() const;
  /// The item's directive of this kind, while it is not over.
  [[nodiscard]] const Directive* under_way(DirectiveKind kind) const;
  /// The drive or the relocalizing under way.
  [[nodiscard]] const Directive* drive_under_way() const;
  /// It has not come to its place yet: a drive is under way or follows.
  [[nodiscard]] bool is_before_drive() const { return drive_under_way() != nullptr || leads_from(memory_.item + 1); }
  /// One of the action's items from `first` on moves the robot.
  [[nodiscard]] bool leads_from(int first) const;
  [[nodiscard]] std::optional<TaskStatus> status() const;
  [[nodiscard]] DriveOrder drive_order() const;
  void send_drive() { actions_.drive = drive_order(); }
  void say(const std::string& name, const std::string& text, Mood mood);
  void send_speech(const Directive& directive, Time now);
  void report();
  void watch_drive(Time now);
  void climb_ladder(Time now);
  void watch_speech(const Directive& directive, Time now);
  /// The next item docks.
  [[nodiscard]] bool docks_next() const;
  /// What holds it up on its way to the charger stands where it would charge.
  [[nodiscard]] bool is_before_occupied_charger() const;
  void begin_docking(Time now);
  void watch_docking(const Directive& directive, Time now);
  /// Ends the task, with a word to whoever can help.
  void fail_to_charge(ReasonWord why);
  void watch_wait(const Directive& directive, Time now);
  void arrive(const Directive& directive, Time now);
  void ask_for_way(Time now, int count);
  void set_note(const Reason& note);
  [[nodiscard]] bool is_asked() const { return memory_.task.order.offer_more && !memory_.task.long_text.empty(); }
  [[nodiscard]] double wait_s(const Directive& directive) const;
  [[nodiscard]] std::string own_id(const std::string& name) const;
  [[nodiscard]] Question question() const;
  [[nodiscard]] Time question_deadline() const;

  ExecutiveParams params_;
  Decomposition decomposition_;
  ExecutiveMemory memory_;
  Actions actions_;

  GoalReport goal_;
  ObstacleReport obstacle_;
  Time obstacle_time_{};  ///< when it was reported
  ReactionLadder ladder_;
  ApproachWatch approach_{{}, {}};
  std::optional<Docking> docking_;  ///< while it docks
  SomebodyThere somebody_;          ///< at the charger
  Contact contact_ = Contact::unheard;
  ByTag by_tag_ = ByTag::none;
  bool drives_to_tag_ = false;  ///< the drive to the charger leads to where its tag is seen
  bool stands_by_tag_ = false;  ///< it has docked by the tag, and stays where it stands
  Mood shown_mood_ = Mood::neutral;
  Time shown_at_{};
  std::optional<SpeechReport> heard_;  ///< of the present utterance
  std::optional<Time> speech_sent_;
  Reason note_;  ///< shown while driving: why it does not go on
};

}  // namespace docent::task_control
