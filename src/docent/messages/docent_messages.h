#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "docent/messages/standard_messages.h"

// Docent's own messages, package docent_msgs. Messages only grow: add fields at the end (architecture 10.16).

namespace docent::docent_msgs {

/// One entry of the position probability grid: the centre of a cell and its mass.
struct BeliefCell {
  static constexpr const char* kType = "docent_msgs/msg/BeliefCell";
  float x = 0;  ///< [m], map
  float y = 0;
  float theta = 0;  ///< [rad]
  float mass = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("x", m.x);
    v("y", m.y);
    v("theta", m.theta);
    v("mass", m.mass);
  }
};

/// What the listed cells leave out, on a coarse grid in x and y, all headings together; every heading of such a cell is
/// possible.
struct CoarseBelief {
  static constexpr const char* kType = "docent_msgs/msg/CoarseBelief";
  float origin_x = 0;  ///< [m], lower left
  float origin_y = 0;
  float cell_size = 0;  ///< [m]
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::vector<float> mass;  ///< [rows * columns]
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("origin_x", m.origin_x);
    v("origin_y", m.origin_y);
    v("cell_size", m.cell_size);
    v("columns", m.columns);
    v("rows", m.rows);
    v("mass", m.mass);
  }
};

/// One mode of the belief.
struct Hypothesis {
  static constexpr const char* kType = "docent_msgs/msg/Hypothesis";
  double x = 0;  ///< [m], map
  double y = 0;
  double theta = 0;                    ///< [rad]
  std::array<double, 9> covariance{};  ///< row-major x, y, theta
  double mass = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("x", m.x);
    v("y", m.y);
    v("theta", m.theta);
    v("covariance", m.covariance);
    v("mass", m.mass);
  }
};

/// Where the robot may be (architecture 10.5): at most 8,192 cells with at least 99.5 % of the mass, the rest coarse.
struct Belief {
  static constexpr const char* kType = "docent_msgs/msg/Belief";
  std_msgs::Header header;  ///< frame map; stamp of the scan it includes
  std::string map_hash;
  float cell_size = 0;     ///< [m]
  float heading_step = 0;  ///< [rad]
  std::vector<BeliefCell> cells;
  CoarseBelief rest;
  std::vector<Hypothesis> hypotheses;  ///< by falling mass
  double entropy = 0;                  ///< [nat]
  double p_lost = 1;                   ///< probability that the best hypothesis is wrong
  bool localized = false;              ///< false: "I do not know"
  double active_mass = 1;              ///< mass of the cells that are updated
  std::uint32_t active_cells = 0;
  std::uint32_t beams_used = 0;
  std::uint32_t beams_filtered = 0;
  geometry_msgs::Pose odom_pose;  ///< odom_from_base at the stamp, so that others can carry the belief forward
  float agreement = 0;            ///< 0..1: share of the readings that the map explains, lately
  float contradiction = 0;        ///< 0..1: share of the readings that pass through walls of the map, lately
  float surprise = 0;             ///< the same, in the last sweep alone, against the best hypothesis
  float hidden = 0;               ///< 0..1: share of the last sweep that is too short, more than lately
  float confirmation = 0;         ///< 0..1: of the updates and the motion that it takes to say "here"
  float blind_way = 0;            ///< [m] driven since readings last agreed with the map
  float unmapped = 0;             ///< 0..1: share of the straight walls in sight that the map lacks, lately
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("map_hash", m.map_hash);
    v("cell_size", m.cell_size);
    v("heading_step", m.heading_step);
    v("cells", m.cells);
    v("rest", m.rest);
    v("hypotheses", m.hypotheses);
    v("entropy", m.entropy);
    v("p_lost", m.p_lost);
    v("localized", m.localized);
    v("active_mass", m.active_mass);
    v("active_cells", m.active_cells);
    v("beams_used", m.beams_used);
    v("beams_filtered", m.beams_filtered);
    v("odom_pose", m.odom_pose);
    v("agreement", m.agreement);
    v("contradiction", m.contradiction);
    v("surprise", m.surprise);
    v("hidden", m.hidden);
    v("confirmation", m.confirmation);
    v("blind_way", m.blind_way);
    v("unmapped", m.unmapped);
  }
};

/// Endpoints of beams that the filters found too short for the map: people and other unmapped things. And the whole
/// sweep that they are of, with what the map says of each beam, so that people can be followed where it says nothing.
struct PersonBeams {
  static constexpr const char* kType = "docent_msgs/msg/PersonBeams";
  std_msgs::Header header;                ///< frame base_link
  std::vector<float> x;                   ///< [m]
  std::vector<float> y;                   ///< [m]
  std::array<double, 3> map_from_base{};  ///< best pose at the stamp: x, y [m], theta [rad]
  bool localized = false;
  std::array<double, 3> odom_from_base{};  ///< at the stamp
  std::vector<float> bearings;             ///< [rad] of all valid beams, base_link
  std::vector<float> ranges;               ///< [m] from base_link; negative: as far at least, nothing came back
  std::vector<std::uint8_t> origins;       ///< 0 nobody knows, 1 the map, 2 likely not the map, 3 surely not the map
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("x", m.x);
    v("y", m.y);
    v("map_from_base", m.map_from_base);
    v("localized", m.localized);
    v("odom_from_base", m.odom_from_base);
    v("bearings", m.bearings);
    v("ranges", m.ranges);
    v("origins", m.origins);
  }
};

/// A tracked person.
struct Person {
  static constexpr const char* kType = "docent_msgs/msg/Person";
  std::uint32_t id = 0;
  float x = 0;  ///< [m], map or odom: see the header of People
  float y = 0;
  float vx = 0;  ///< [m/s]
  float vy = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("x", m.x);
    v("y", m.y);
    v("vx", m.vx);
    v("vy", m.vy);
  }
};

/// Tracked people.
struct People {
  static constexpr const char* kType = "docent_msgs/msg/People";
  std_msgs::Header header;  ///< frame map on docent/people, frame odom on docent/people_odom
  std::vector<Person> people;
  std::vector<std::uint32_t> groups;        ///< [people] the same number: they stand or walk together; 0: alone
  std::array<double, 3> frame_from_base{};  ///< the robot at the stamp, in the message's frame: x, y [m], theta [rad]
  bool localized = false;  ///< places in the map are known; without, `people` on docent/people is empty
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("people", m.people);
    v("groups", m.groups);
    v("frame_from_base", m.frame_from_base);
    v("localized", m.localized);
  }
};

/// Where to go; latched, from executive to plan. An empty id means: stay.
struct DriveGoal {
  static constexpr const char* kType = "docent_msgs/msg/DriveGoal";
  std::string id;
  double x = 0;  ///< [m], map
  double y = 0;
  double theta = 0;                  ///< [rad], heading to take on arrival
  double position_tolerance = 0.25;  ///< [m]
  double heading_tolerance = 0.1;    ///< [rad]
  bool relocalize = false;           ///< turn on the spot until localized; x, y, theta do not matter
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("x", m.x);
    v("y", m.y);
    v("theta", m.theta);
    v("position_tolerance", m.position_tolerance);
    v("heading_tolerance", m.heading_tolerance);
    v("relocalize", m.relocalize);
  }
};

/// What plan says of the goal; latched.
struct GoalState {
  static constexpr const char* kType = "docent_msgs/msg/GoalState";
  std_msgs::Header header;
  std::string id;
  std::string state;       ///< idle, waiting (no pose or no plan yet), driving, turning, arrived, blocked, unreachable
  double remaining_m = 0;  ///< along the path
  double blocked_s = 0;    ///< no progress for so long
  std::string reason;
  std::string detour;       ///< none, local, global: how the way differs from the one that was meant
  double detour_extra = 0;  ///< [m] that it is longer
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("id", m.id);
    v("state", m.state);
    v("remaining_m", m.remaining_m);
    v("blocked_s", m.blocked_s);
    v("reason", m.reason);
    v("detour", m.detour);
    v("detour_extra", m.detour_extra);
  }
};

/// Where the robot wants to go, for the head: it looks there while its way is blocked ([Rhino1999] 5.3). From plan, 5
/// Hz.
struct Gaze {
  static constexpr const char* kType = "docent_msgs/msg/Gaze";
  std_msgs::Header header;  ///< frame odom
  std::string at;           ///< way: the direction it wants to drive; goal: the heading it turns to; none
  double heading = 0;       ///< [rad], odom: the direction itself, good while the robot turns
  double bearing = 0;       ///< [rad], base_link at the header's stamp
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("at", m.at);
    v("heading", m.heading);
    v("bearing", m.bearing);
  }
};

/// What avoid shall steer for; from plan at 4 Hz or more. Via-points only, never a velocity.
struct Target {
  static constexpr const char* kType = "docent_msgs/msg/Target";
  std_msgs::Header header;  ///< frame odom
  std::string goal_id;
  std::string mode;           ///< stop, drive, turn
  std::vector<double> via_x;  ///< [m], odom; the next points of the way, nearest first
  std::vector<double> via_y;  ///< [m]
  bool is_final = false;      ///< the last via-point is the goal itself: slow down and stop there
  double heading = 0;         ///< [rad], odom; for turn: heading to take
  double position_tolerance = 0.25;
  double heading_tolerance = 0.1;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("goal_id", m.goal_id);
    v("mode", m.mode);
    v("via_x", m.via_x);
    v("via_y", m.via_y);
    v("is_final", m.is_final);
    v("heading", m.heading);
    v("position_tolerance", m.position_tolerance);
    v("heading_tolerance", m.heading_tolerance);
  }
};

/// The one velocity command, from avoid to robot (architecture 10.7).
struct Drive {
  static constexpr const char* kType = "docent_msgs/msg/Drive";
  std_msgs::Header header;
  double linear = 0;   ///< [m/s]
  double angular = 0;  ///< [rad/s]
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("linear", m.linear);
    v("angular", m.angular);
  }
};

/// One evaluated velocity pair.
struct Candidate {
  static constexpr const char* kType = "docent_msgs/msg/Candidate";
  float linear = 0;
  float angular = 0;
  float value = 0;  ///< < 0: not admissible
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("linear", m.linear);
    v("angular", m.angular);
    v("value", m.value);
  }
};

/// What avoid does and why; with the live velocity space.
struct AvoidState {
  static constexpr const char* kType = "docent_msgs/msg/AvoidState";
  std_msgs::Header header;
  std::string state;     ///< driving, turning, stopped, blocked
  std::string reason;    ///< why it stands or is slow, for a person
  double speed_cap = 0;  ///< [m/s]
  double linear = 0;     ///< commanded
  double angular = 0;
  bool path_blocked = false;       ///< wants to move, and an obstacle in the wanted direction prevents it
  bool unmapped_obstacle = false;  ///< that obstacle is not in the map: likely a person
  double nearest_real_m = 0;       ///< [m] from the robot's outline
  double nearest_virtual_m = 0;
  std::vector<Candidate> window;
  bool low_obstacle =
      false;  ///< it, or what has touched the robot here, lies below the lasers, which see nobody: a thing
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("state", m.state);
    v("reason", m.reason);
    v("speed_cap", m.speed_cap);
    v("linear", m.linear);
    v("angular", m.angular);
    v("path_blocked", m.path_blocked);
    v("unmapped_obstacle", m.unmapped_obstacle);
    v("nearest_real_m", m.nearest_real_m);
    v("nearest_virtual_m", m.nearest_virtual_m);
    v("window", m.window);
    v("low_obstacle", m.low_obstacle);
  }
};

/// A wish of a visitor. Resent until it is on the request board (architecture 10.8).
struct Request {
  static constexpr const char* kType = "docent_msgs/msg/Request";
  std::string id;  ///< UUIDv7, made at the edge
  builtin_interfaces::Time stamp;
  std::string source;           ///< web, kiosk, visitor, staff
  std::string visitor;          ///< a name to show
  std::string kind;             ///< exhibit, tour, cancel
  std::string target;           ///< exhibit or tour id; for cancel: the request's id
  std::int32_t viewpoint = -1;  ///< index in the exhibit's viewpoints
  std::string language;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("stamp", m.stamp);
    v("source", m.source);
    v("visitor", m.visitor);
    v("kind", m.kind);
    v("target", m.target);
    v("viewpoint", m.viewpoint);
    v("language", m.language);
  }
};

/// An answer to the question on show.
struct Choice {
  static constexpr const char* kType = "docent_msgs/msg/Choice";
  std::string id;  ///< UUIDv7
  std::string prompt_id;
  std::string choice;  ///< one of the prompt's options
  std::string source;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("prompt_id", m.prompt_id);
    v("choice", m.choice);
    v("source", m.source);
  }
};

/// One request on the board.
struct RequestState {
  static constexpr const char* kType = "docent_msgs/msg/RequestState";
  Request request;
  std::string state;  ///< queued, active, fulfilled, failed, refused, cancelled
  std::string reason;
  builtin_interfaces::Time created;
  builtin_interfaces::Time changed;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("request", m.request);
    v("state", m.state);
    v("reason", m.reason);
    v("created", m.created);
    v("changed", m.changed);
  }
};

/// All open requests and the last 100 closed ones; latched, the single writer is mission.
struct RequestBoard {
  static constexpr const char* kType = "docent_msgs/msg/RequestBoard";
  std_msgs::Header header;
  std::uint64_t revision = 0;
  std::vector<RequestState> requests;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("revision", m.revision);
    v("requests", m.requests);
  }
};

/// A question with buttons and a default.
struct Prompt {
  static constexpr const char* kType = "docent_msgs/msg/Prompt";
  std::string id;  ///< empty: nothing is asked
  std::string text;
  std::vector<std::string> options;  ///< more, next, yes, no
  std::string default_option;
  builtin_interfaces::Time deadline;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("text", m.text);
    v("options", m.options);
    v("default_option", m.default_option);
    v("deadline", m.deadline);
  }
};

/// What the robot is about, in words; latched.
struct MissionState {
  static constexpr const char* kType = "docent_msgs/msg/MissionState";
  std_msgs::Header header;
  std::string phase;  ///< waking, relocalizing, idle, driving, explaining, asking, going_home, charging, waiting
  std::string tour_id;
  std::string exhibit_id;  ///< the present or next exhibit
  std::string text_en;     ///< one sentence for people: what it is doing
  std::string text_de;
  Prompt prompt;
  std::uint32_t exhibits_explained = 0;  ///< since the start of the deployment
  std::uint32_t tours_completed = 0;
  std::uint32_t requests_served = 0;
  std::vector<std::string> agenda;  ///< exhibit ids still to come, in order
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("phase", m.phase);
    v("tour_id", m.tour_id);
    v("exhibit_id", m.exhibit_id);
    v("text_en", m.text_en);
    v("text_de", m.text_de);
    v("prompt", m.prompt);
    v("exhibits_explained", m.exhibits_explained);
    v("tours_completed", m.tours_completed);
    v("requests_served", m.requests_served);
    v("agenda", m.agenda);
  }
};

/// One thing to do, from mission to executive; latched. A new id replaces the task before it.
struct Task {
  static constexpr const char* kType = "docent_msgs/msg/Task";
  std::string id;          ///< empty: nothing to do
  std::string kind;        ///< visit, home, charge, relocalize
  std::string exhibit_id;  ///< for charge: of the visit that is broken off for it
  double x = 0;            ///< [m], map: where to stand
  double y = 0;
  double theta = 0;
  std::string language;
  bool offer_more = true;
  std::string tour_id;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("kind", m.kind);
    v("exhibit_id", m.exhibit_id);
    v("x", m.x);
    v("y", m.y);
    v("theta", m.theta);
    v("language", m.language);
    v("offer_more", m.offer_more);
    v("tour_id", m.tour_id);
  }
};

/// How the task goes; latched, from executive.
struct TaskState {
  static constexpr const char* kType = "docent_msgs/msg/TaskState";
  std_msgs::Header header;
  std::string id;
  std::string state;  ///< driving, explaining, asking, done, failed
  std::string reason;
  Prompt prompt;
  bool took_long = false;  ///< the visitor asked for more
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("id", m.id);
    v("state", m.state);
    v("reason", m.reason);
    v("prompt", m.prompt);
    v("took_long", m.took_long);
  }
};

/// Something worth a line in the history: for the mission, the interaction and the report.
struct Event {
  static constexpr const char* kType = "docent_msgs/msg/Event";
  std_msgs::Header header;
  std::string kind;     ///< see docs/terminology.md, Events
  std::string subject;  ///< request, exhibit, tour or module it is about
  std::string detail;
  double value = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("kind", m.kind);
    v("subject", m.subject);
    v("detail", m.detail);
    v("value", m.value);
  }
};

/// A step of the reaction ladder ([Rhino1999] 5.3): for the interaction, the mission and the report.
struct Reaction {
  static constexpr const char* kType = "docent_msgs/msg/Reaction";
  std_msgs::Header header;
  std::string goal_id;
  std::string step;        ///< slow, horn, local_detour, global_detour, wait, ask, give_up, free
  std::string cause;       ///< what is in the way, for a person
  double after = 0;        ///< [s] since the way was blocked
  std::int32_t count = 0;  ///< how often this step was taken since then, from 1
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("goal_id", m.goal_id);
    v("step", m.step);
    v("cause", m.cause);
    v("after", m.after);
    v("count", m.count);
  }
};

/// Speak.
struct Say {
  static constexpr const char* kType = "docent_msgs/msg/Say";
  std::string id;
  std::string text;
  std::string language;
  std::string mood;  ///< neutral, happy, sad, angry
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("text", m.text);
    v("language", m.language);
    v("mood", m.mood);
  }
};

/// What is being said; latched.
struct SpeechState {
  static constexpr const char* kType = "docent_msgs/msg/SpeechState";
  std_msgs::Header header;
  std::string id;
  std::string state;  ///< speaking, done, failed
  std::string text;
  std::string language;
  builtin_interfaces::Time start;
  double duration = 0;  ///< [s]
  std::string audio;    ///< file name of the audio, its hash; empty where there is none
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("id", m.id);
    v("state", m.state);
    v("text", m.text);
    v("language", m.language);
    v("start", m.start);
    v("duration", m.duration);
    v("audio", m.audio);
  }
};

/// The horn sounds once.
struct Horn {
  static constexpr const char* kType = "docent_msgs/msg/Horn";
  std_msgs::Header header;
  std::string reason;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("reason", m.reason);
  }
};

/// What may change while running; latched.
struct Limits {
  static constexpr const char* kType = "docent_msgs/msg/Limits";
  double max_speed = 0.7;     ///< [m/s]
  double volume = 1;          ///< 0..1
  std::string mode = "open";  ///< open, web, closed; hours: what the museum's hours say
  bool is_open = true;        ///< takes requests
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("max_speed", m.max_speed);
    v("volume", m.volume);
    v("mode", m.mode);
    v("is_open", m.is_open);
  }
};

/// Life of a module, 2 Hz (architecture 10.10).
struct Health {
  static constexpr const char* kType = "docent_msgs/msg/Health";
  std_msgs::Header header;
  std::string module;
  std::string state;  ///< starting, ready, degraded, faulted
  std::string reason;
  std::int32_t pid = 0;
  double step_p99_ms = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("module", m.module);
    v("state", m.state);
    v("reason", m.reason);
    v("pid", m.pid);
    v("step_p99_ms", m.step_p99_ms);
  }
};

/// The tactile ring: one byte a segment, counter-clockwise from the front; 1 = pressed, 255 = no reading.
struct Tactile {
  static constexpr const char* kType = "docent_msgs/msg/Tactile";
  std_msgs::Header header;  ///< frame base_link
  std::vector<std::uint8_t> segments;
  std::uint32_t scan = 0;  ///< count of the ring's own scans, so that a frozen one can be told; 0: it keeps none
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("segments", m.segments);
    v("scan", m.scan);
  }
};

/// A line on the floor that nothing may touch, [m], frame of the message.
struct ObstacleLine {
  static constexpr const char* kType = "docent_msgs/msg/ObstacleLine";
  float x1 = 0, y1 = 0, x2 = 0, y2 = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("x1", m.x1);
    v("y1", m.y1);
    v("x2", m.x2);
    v("y2", m.y2);
  }
};

/// Obstacles that a camera saw. A new message replaces the one before of the same source. Sent at a steady rate, also
/// when nothing is seen: a source that falls silent stops the robot.
struct ObstacleLines {
  static constexpr const char* kType = "docent_msgs/msg/ObstacleLines";
  std_msgs::Header header;  ///< frame base_link, when the picture was taken
  std::string source;       ///< which camera
  double lifetime_s = 1.0;  ///< [s] the lines count for so long after the stamp, at most 5
  std::vector<ObstacleLine> lines;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("source", m.source);
    v("lifetime_s", m.lifetime_s);
    v("lines", m.lines);
  }
};

/// A changed rectangle of the live map. It builds on the full map of stamp `base`; numbers count up from 1 behind each
/// full map. Who misses a number waits for the next full map, at most ten seconds.
struct LiveMapUpdate {
  static constexpr const char* kType = "docent_msgs/msg/LiveMapUpdate";
  std_msgs::Header header;
  builtin_interfaces::Time base;
  std::uint32_t number = 0;
  std::int32_t x = 0;  ///< [cells]
  std::int32_t y = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::int8_t> data;  ///< [height * width], 0..100 or -1
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("base", m.base);
    v("number", m.number);
    v("x", m.x);
    v("y", m.y);
    v("width", m.width);
    v("height", m.height);
    v("data", m.data);
  }
};

/// What was run; written once at the start of a recording.
struct RunInfo {
  static constexpr const char* kType = "docent_msgs/msg/RunInfo";
  std::string museum;
  std::string mode;
  std::uint64_t seed = 0;
  std::string crowd;
  std::string config_hash;
  std::string simd;
  std::string crippled;  ///< empty, or how the robot was crippled
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("museum", m.museum);
    v("mode", m.mode);
    v("seed", m.seed);
    v("crowd", m.crowd);
    v("config_hash", m.config_hash);
    v("simd", m.simd);
    v("crippled", m.crippled);
  }
};

/// Truth channel only.
struct TruePerson {
  static constexpr const char* kType = "docent_msgs/msg/TruePerson";
  std::uint32_t id = 0;
  float x = 0;  ///< [m], world
  float y = 0;
  float vx = 0;
  float vy = 0;
  float radius = 0;
  bool visible = false;  ///< within 10 m and in sight of a laser
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("x", m.x);
    v("y", m.y);
    v("vx", m.vx);
    v("vy", m.vy);
    v("radius", m.radius);
    v("visible", m.visible);
  }
};

/// Ground truth, 10 Hz. Only the evaluation reads it.
struct TrueState {
  static constexpr const char* kType = "docent_msgs/msg/TrueState";
  std_msgs::Header header;  ///< frame world = map
  double x = 0;
  double y = 0;
  double theta = 0;
  double linear = 0;      ///< [m/s]
  double angular = 0;     ///< [rad/s]
  double distance_m = 0;  ///< driven so far
  bool inside_area = true;
  double battery = 1;           ///< 0..1
  double nearest_person_m = 0;  ///< outline to outline
  double blocked_beams = 0;     ///< fraction of the last laser sweep that ended on people
  std::vector<TruePerson> people;
  double contact_seconds = 0;              ///< so far: time in which something was touched and the wheels turned
  std::uint32_t visitors = 0;              ///< different people so far
  std::vector<std::uint8_t> person_beams;  ///< [people] beams of the last sweep that ended on each, 255 or more as 255
  double nearest_solid_m = 0;              ///< from the outline to the nearest wall, furniture or hazard
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("x", m.x);
    v("y", m.y);
    v("theta", m.theta);
    v("linear", m.linear);
    v("angular", m.angular);
    v("distance_m", m.distance_m);
    v("inside_area", m.inside_area);
    v("battery", m.battery);
    v("nearest_person_m", m.nearest_person_m);
    v("blocked_beams", m.blocked_beams);
    v("people", m.people);
    v("contact_seconds", m.contact_seconds);
    v("visitors", m.visitors);
    v("person_beams", m.person_beams);
    v("nearest_solid_m", m.nearest_solid_m);
  }
};

/// Ground truth of one touch, at its begin (section 9 says which count).
struct TrueContact {
  static constexpr const char* kType = "docent_msgs/msg/TrueContact";
  std_msgs::Header header;
  std::string kind;  ///< people, furniture, walls, hazards
  std::string what;  ///< id of what was touched
  double x = 0;      ///< [m], world
  double y = 0;
  double robot_speed = 0;  ///< [m/s], the robot's own velocity towards the touched point
  double other_speed = 0;  ///< [m/s], of the touched person towards the robot
  double wheel_speed = 0;  ///< [m/s]
  bool braked_in_time =
      false;  ///< full braking had begun within 0.3 s of the person first being visible inside the stopping distance
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("kind", m.kind);
    v("what", m.what);
    v("x", m.x);
    v("y", m.y);
    v("robot_speed", m.robot_speed);
    v("other_speed", m.other_speed);
    v("wheel_speed", m.wheel_speed);
    v("braked_in_time", m.braked_in_time);
  }
};

/// A simulated visitor made a wish (exposure for the success rate), or a scenario event happened.
struct TrueOffer {
  static constexpr const char* kType = "docent_msgs/msg/TrueOffer";
  std_msgs::Header header;
  std::string kind;  ///< request, kidnap, fault, restart, ...
  std::string subject;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("kind", m.kind);
    v("subject", m.subject);
  }
};

}  // namespace docent::docent_msgs
