#pragma once

#include <array>
#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

// Kinds, states and phases that are words in messages, files and on the page, and enumerations inside the program.
// Whoever takes such a word from outside or gives one out converts it at that place.

namespace docent {

/// What a visitor wishes for; cancel and skip take something back: a request, and the stop under way of a tour.
enum class RequestKind { exhibit, tour, cancel, point, room, skip };
constexpr auto words_of(RequestKind) { return std::array{"exhibit", "tour", "cancel", "point", "room", "skip"}; }
/// The target of a wish for the room after that in which the robot is.
inline constexpr const char* kNextRoom = "next";
/// Such a wish takes the robot to a place of the floor, where it shows nothing.
[[nodiscard]] constexpr bool is_place(RequestKind kind) {
  return kind == RequestKind::point || kind == RequestKind::room;
}

/// Where a request was made; vote: a tour for which the Web's visitors voted.
enum class RequestSource { web, kiosk, visitor, staff, vote };
constexpr auto words_of(RequestSource) { return std::array{"web", "kiosk", "visitor", "staff", "vote"}; }

/// The life of a request: queued -> active -> fulfilled, with ways back to queued (a visit that failed and is tried
/// again, or was suspended) and out to failed and cancelled. refused is a first and last state.
enum class RequestStatus { queued, active, fulfilled, failed, refused, cancelled };
constexpr auto words_of(RequestStatus) {
  return std::array{"queued", "active", "fulfilled", "failed", "refused", "cancelled"};
}
[[nodiscard]] constexpr bool is_open(RequestStatus status) {
  return status == RequestStatus::queued || status == RequestStatus::active;
}

/// Whose requests are taken: everybody's, those from the Web alone, those of the staff alone; hours: as the museum's
/// hours say.
enum class OperatingMode { open, web, closed, hours };
constexpr auto words_of(OperatingMode) { return std::array{"open", "web", "closed", "hours"}; }

/// What a technician has a robot do that maps a building; finish: the map is made of what it has seen.
enum class ExplorationOrder { wait, by_itself, by_hand, finish };
constexpr auto words_of(ExplorationOrder) { return std::array{"wait", "by_itself", "by_hand", "finish"}; }

/// How far the setting up of a museum has come: its name, its map, what no sensor sees, what it shows, the check, and
/// its first tour.
enum class SetupStep { name, map, hazards, exhibits, check, tour, done };
constexpr auto words_of(SetupStep) { return std::array{"name", "map", "hazards", "exhibits", "check", "tour", "done"}; }

/// What the mission is about.
enum class MissionPhase { waking, relocalizing, idle, driving, explaining, asking, going_home, charging, waiting };
constexpr auto words_of(MissionPhase) {
  return std::array{"waking", "relocalizing", "idle",     "driving", "explaining",
                    "asking", "going_home",   "charging", "waiting"};
}

/// What the executive is to do.
enum class TaskKind { visit, farewell, home, charge, relocalize, mingle, point };
constexpr auto words_of(TaskKind) {
  return std::array{"visit", "farewell", "home", "charge", "relocalize", "mingle", "point"};
}

/// How a task goes.
enum class TaskStatus { driving, explaining, asking, done, failed };
constexpr auto words_of(TaskStatus) { return std::array{"driving", "explaining", "asking", "done", "failed"}; }

/// How the drive to a goal goes; waiting: no pose or no plan yet.
enum class GoalStatus { idle, waiting, driving, turning, arrived, blocked, unreachable };
constexpr auto words_of(GoalStatus) {
  return std::array{"idle", "waiting", "driving", "turning", "arrived", "blocked", "unreachable"};
}

/// What the collision avoidance steers for: nothing, via-points, a heading.
enum class DriveMode { stop, drive, turn };
constexpr auto words_of(DriveMode) { return std::array{"stop", "drive", "turn"}; }

/// Where the head looks: along the way, to the heading that the robot turns to, nowhere.
enum class GazeAt { way, goal, none };
constexpr auto words_of(GazeAt) { return std::array{"way", "goal", "none"}; }

/// A step of the reaction to a blocked way.
enum class Rung { slow, horn, local_detour, global_detour, wait, ask, give_up, free };
constexpr auto words_of(Rung) {
  return std::array{"slow", "horn", "local_detour", "global_detour", "wait", "ask", "give_up", "free"};
}

/// How an utterance goes.
enum class SpeechStatus { speaking, done, failed };
constexpr auto words_of(SpeechStatus) { return std::array{"speaking", "done", "failed"}; }

/// How the voice sounds and the face looks.
enum class Mood { neutral, happy, sad, angry };
constexpr auto words_of(Mood) { return std::array{"neutral", "happy", "sad", "angry"}; }

/// At what the head looks: the next exhibit, a person who stands where the robot wants to go, a visitor who is spoken
/// to, the direction in which it wants to go, nothing.
enum class LookAt { goal, person, visitor, way, none };
constexpr auto words_of(LookAt) { return std::array{"goal", "person", "visitor", "way", "none"}; }

/// Where an action wants the head to look: at the exhibit, at visitors, along the way, at nobody, or at the people whom
/// it wants to attract, as its style says.
enum class LookFor { place, visitors, way, nobody, company };
constexpr auto words_of(LookFor) { return std::array{"place", "visitors", "way", "nobody", "company"}; }

/// Whom the robot looks at while it attracts people: the nearest person, one person after the other, nobody.
enum class GazeStrategy { nearest, everybody, ahead };
constexpr auto words_of(GazeStrategy) { return std::array{"nearest", "everybody", "ahead"}; }

/// What the robot says while it attracts people: "come over", "do you like robots?", nothing, that people stay behind
/// it, that nobody listens.
enum class SpeechAct { invite, ask, silence, demand, complain };
constexpr auto words_of(SpeechAct) { return std::array{"invite", "ask", "silence", "demand", "complain"}; }

/// What visitors may answer to a question.
enum class Answer { more, next, yes, no };
constexpr auto words_of(Answer) { return std::array{"more", "next", "yes", "no"}; }

/// Coloured buttons beside the robot's screen: 1 red, 2 yellow, 3 green, 4 blue ([Rhino1999] 5.1).
inline constexpr int kButtons = 4;

/// What visitors are asked after a tour ([Minerva2000] 7): whether they like the robot, whether they were satisfied
/// with it, whether they would pay 1,000 dollars or more for one at home, and whose intelligence its own is most like.
enum class PollQuestion { liked, satisfied, price, intelligence };
constexpr auto words_of(PollQuestion) { return std::array{"liked", "satisfied", "price", "intelligence"}; }

/// What they may answer; the last five are for the last question.
enum class PollAnswer { yes, undecided, no, human, monkey, dog, fish, amoeba };
constexpr auto words_of(PollAnswer) {
  return std::array{"yes", "undecided", "no", "human", "monkey", "dog", "fish", "amoeba"};
}
[[nodiscard]] constexpr bool answers(PollAnswer answer, PollQuestion question) {
  return (question == PollQuestion::intelligence) == (answer >= PollAnswer::human);
}

/// What the robot touched.
enum class ContactKind { people, furniture, walls, hazards };
constexpr auto words_of(ContactKind) { return std::array{"people", "furniture", "walls", "hazards"}; }

/// Why a request is refused, waits or has come to its end, why the robot stands. People read them in their own
/// language: each page has words for every one of them (`reason_WORD` in web/src/words). `Reason` says what each is
/// about.
enum class ReasonWord {
  no_such_exhibit,    ///< about its id
  no_such_viewpoint,  ///< of that exhibit
  no_such_tour,       ///< about its id
  no_such_request,    ///< as is open
  not_understood,     ///< about the word that is no kind of wish
  for_web_only,       ///< an exhibit that is shown to Web visitors only
  web_only_now,       ///< the hours of the Web visitors
  closed,
  too_many_wait,
  too_many_points,    ///< on the map are wished for already
  only_in_web_hours,  ///< points on the map, and rooms for visitors on the Web
  no_such_room,       ///< about its id
  not_on_free_floor,  ///< where the robot cannot stand, or cannot get to
  not_stored,         ///< the disk is full or gone
  question_over,      ///< the question is no longer open
  no_such_answer,     ///< to the question
  busy,               ///< with something else
  too_fast,           ///< more messages than anybody can mean
  charging_first,
  on_the_way,  ///< there already: who asks takes part
  joins_tour,  ///< that is under way: what was missed comes at its end
  tour_begun,
  cancelled,
  gone,           ///< the museum no longer has it
  not_reached,    ///< about the ids of exhibits, with spaces between them
  battery_low,    ///< the robot must charge
  took_too_long,  ///< to get there
  no_way,         ///< leads there
  way_blocked,    ///< for too long
  unknown_task,   ///< the executive does not know the task; about its kind
  person_in_way,
  obstacle_in_way,
  hazard_in_way,
  border_in_way,  ///< of the robot's area
  people_near,
  touched,          ///< somebody or something touches the robot
  felt_thing_near,  ///< something that only touch finds
  braking,
  border_near,  ///< so the robot drives slowly; likewise the next two
  hazard_near,
  obstacle_near,
  stopped_by_hand,  ///< by an operator's stop button
  steered_by_hand,
  no_lease,            ///< to steer, or no longer; about the name of whoever has it
  stop_unconfirmed,    ///< the robot has not said in time that it holds the order; it is repeated for ever
  another_stop,        ///< somebody has pressed again since: about their name; a release is for the stop it names
  charger_occupied,    ///< something stands where the robot charges
  charger_no_current,  ///< it stands at its charger, and the battery does not charge
};
constexpr auto words_of(ReasonWord) {
  return std::array{"no_such_exhibit",
                    "no_such_viewpoint",
                    "no_such_tour",
                    "no_such_request",
                    "not_understood",
                    "for_web_only",
                    "web_only_now",
                    "closed",
                    "too_many_wait",
                    "too_many_points",
                    "only_in_web_hours",
                    "no_such_room",
                    "not_on_free_floor",
                    "not_stored",
                    "question_over",
                    "no_such_answer",
                    "busy",
                    "too_fast",
                    "charging_first",
                    "on_the_way",
                    "joins_tour",
                    "tour_begun",
                    "cancelled",
                    "gone",
                    "not_reached",
                    "battery_low",
                    "took_too_long",
                    "no_way",
                    "way_blocked",
                    "unknown_task",
                    "person_in_way",
                    "obstacle_in_way",
                    "hazard_in_way",
                    "border_in_way",
                    "people_near",
                    "touched",
                    "felt_thing_near",
                    "braking",
                    "border_near",
                    "hazard_near",
                    "obstacle_near",
                    "stopped_by_hand",
                    "steered_by_hand",
                    "no_lease",
                    "stop_unconfirmed",
                    "another_stop",
                    "charger_occupied",
                    "charger_no_current"};
}

/// What is worth a line in the history (docs/terminology.md, Events).
enum class EventKind {
  request_queued,
  request_refused,
  request_active,
  request_fulfilled,
  request_failed,
  request_cancelled,
  visit_started,
  explained,
  visit_failed,
  visit_dropped,
  point_reached,
  tour_started,
  tour_completed,
  tour_failed,
  tour_broken_off,
  tour_cancelled,
  farewell,
  plan_inserted,
  plan_removed,
  plan_rescheduled,
  plan_shortened,
  order_chosen,
  attraction_trial,
  relocalizing,
  localized,
  home,
  home_failed,
  charger,
  charger_failed,
  battery_low,
  battery_full,
  arrived,
  drive_blocked,
  asked_for_way,
  prompt_shown,
  choice,
  staff_called,
};
constexpr auto words_of(EventKind) {
  return std::array{"request_queued",   "request_refused",
                    "request_active",   "request_fulfilled",
                    "request_failed",   "request_cancelled",
                    "visit_started",    "explained",
                    "visit_failed",     "visit_dropped",
                    "point_reached",    "tour_started",
                    "tour_completed",   "tour_failed",
                    "tour_broken_off",  "tour_cancelled",
                    "farewell",         "plan_inserted",
                    "plan_removed",     "plan_rescheduled",
                    "plan_shortened",   "order_chosen",
                    "attraction_trial", "relocalizing",
                    "localized",        "home",
                    "home_failed",      "charger",
                    "charger_failed",   "battery_low",
                    "battery_full",     "arrived",
                    "drive_blocked",    "asked_for_way",
                    "prompt_shown",     "choice",
                    "staff_called"};
}

/// An enumeration of the above.
template <class E>
concept Worded = requires {
  words_of(E{});
};

template <Worded E>
[[nodiscard]] constexpr const char* to_text(E value) {
  constexpr auto kWords = words_of(E{});
  return kWords.at(static_cast<std::size_t>(value));
}
/// The empty text for nothing.
template <Worded E>
[[nodiscard]] constexpr const char* to_text(const std::optional<E>& value) {
  return value ? to_text(*value) : "";
}

/// nullopt: the text is no word of this enumeration.
template <Worded E>
[[nodiscard]] constexpr std::optional<E> parse(std::string_view text) {
  constexpr auto kWords = words_of(E{});
  for (std::size_t i = 0; i < kWords.size(); ++i) {
    if (text == kWords.at(i)) return static_cast<E>(i);
  }
  return std::nullopt;
}

/// A word from outside: one of the enumeration, or another, which equals none of them and is kept as it came, so that
/// it can be refused by its name and given back.
template <Worded E>
class Word {
 public:
  Word() = default;                 ///< the empty text
  Word(E value) : value_{value} {}  // NOLINT(google-explicit-constructor): each value is a word
  explicit Word(std::string text) : value_{parse<E>(text)} {
    if (!value_) unknown_ = std::move(text);
  }
  [[nodiscard]] std::optional<E> value() const { return value_; }
  [[nodiscard]] std::string text() const { return value_ ? to_text(*value_) : unknown_; }
  friend bool operator==(const Word&, const Word&) = default;
  friend auto operator<=>(const Word&, const Word&) = default;

 private:
  std::optional<E> value_;
  std::string unknown_;
};

}  // namespace docent
