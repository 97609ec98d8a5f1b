#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "docent/museum/museum.h"
#include "docent/telepresence/inside_documents.h"
#include "docent/vocabulary/vocabulary.h"

// Everything that a page gets, as structs: the one definition of it. Each `visit` names the fields; from it come the
// JSON text (document_json.h) and the page's types (contract/). Times are seconds of the bus's clock, lengths metres,
// angles radians. A number that is not finite becomes null.
//
// `v(name, field)`: an optional is null where there is nothing. `v.maybe(name, optional)`: it is left out.

namespace docent::telepresence {

/// In whose frame the points of a scan are.
enum class ScanFrame { map, base };
[[nodiscard]] constexpr auto words_of(ScanFrame) { return std::array{"map", "base"}; }

}  // namespace docent::telepresence

namespace docent::telepresence::documents {

using Point = std::array<double, 2>;
using Pose = std::array<double, 3>;                ///< x, y, heading, in the map's frame
using Texts = std::map<std::string, std::string>;  ///< by language

/// Why something is as it is, for the page to put into words.
struct Reason {
  static constexpr const char* kName = "Reason";
  ReasonWord word{};
  std::string about;  ///< id of an exhibit or a tour, or several with spaces between them; empty: nothing more
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("word", d.word), v("about", d.about);
  }
};

struct Link {
  static constexpr const char* kName = "Link";
  Texts title;
  std::string url;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("title", d.title), v("url", d.url);
  }
};
struct Exhibit {
  static constexpr const char* kName = "Exhibit";
  std::string id;
  Texts title;
  Pose pose{};
  Point look_at{};
  std::vector<Pose> viewpoints;
  Texts short_text, long_text;
  std::vector<std::string> topics;
  bool web_only = false;
  std::string picture;  ///< where it can be fetched; empty: nowhere
  std::vector<Link> links;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("title", d.title), v("pose", d.pose), v("look_at", d.look_at), v("viewpoints", d.viewpoints);
    v("short", d.short_text), v("long", d.long_text), v("topics", d.topics), v("web_only", d.web_only);
    v("picture", d.picture), v("links", d.links);
  }
};
struct Tour {
  static constexpr const char* kName = "Tour";
  std::string id;
  Texts title;
  std::vector<std::string> exhibits;
  std::optional<double> minutes;
  std::vector<std::string> daily{};  ///< "HH:MM" at which it begins by itself
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("title", d.title), v("exhibits", d.exhibits), v("minutes", d.minutes), v("daily", d.daily);
  }
};
struct Hazard {
  static constexpr const char* kName = "Hazard";
  std::string id;
  museum::HazardKind kind = museum::HazardKind::other;
  std::vector<Point> polygon;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("kind", d.kind), v("polygon", d.polygon);
  }
};
/// Where the robot can be sent, in the order of a walk through all rooms.
struct Room {
  static constexpr const char* kName = "Room";
  std::string id;
  Texts name;
  Point at{};                     ///< where the robot goes in it
  std::vector<std::string> next;  ///< ids of the rooms beside it
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("name", d.name), v("at", d.at), v("next", d.next);
  }
};
struct Door {
  static constexpr const char* kName = "Door";
  Point at{};
  double width = 0.0;
  std::vector<std::string> between;  ///< ids of two rooms
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("at", d.at), v("width", d.width), v("between", d.between);
  }
};
struct Rooms {
  std::vector<Room> rooms;
  std::vector<Door> doors;
};
struct Museum {
  static constexpr const char* kName = "Museum";
  Texts name;
  std::vector<std::string> languages;
  std::vector<Point> area;
  Pose home{};
  std::optional<Pose> charger;
  double robot_radius = 0.0;
  MapPicture map;
  std::vector<Hazard> hazards;
  std::vector<Exhibit> exhibits;
  std::vector<Tour> tours;
  std::vector<Room> rooms;
  std::vector<Door> doors;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("name", d.name), v("languages", d.languages), v("area", d.area), v("home", d.home), v("charger", d.charger);
    v("robot_radius", d.robot_radius), v("map", d.map), v("hazards", d.hazards), v("exhibits", d.exhibits);
    v("tours", d.tours), v("rooms", d.rooms), v("doors", d.doors);
  }
};

struct Avoid {
  static constexpr const char* kName = "Avoid";
  std::string state;
  std::optional<Reason> reason;
  double cap = 0.0;
  bool blocked = false, person = false;
  std::optional<double> real, virtual_one;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("state", d.state), v("reason", d.reason), v("cap", d.cap), v("blocked", d.blocked), v("person", d.person);
    v("real", d.real), v("virtual", d.virtual_one);
  }
};
struct Scan {
  static constexpr const char* kName = "Scan";
  ScanFrame frame = ScanFrame::base;
  Point from{};
  std::vector<long> points;  ///< x, y, x, y … in whole centimetres
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("frame", d.frame), v("from", d.from), v("points", d.points);
  }
};
struct LiveMessage {
  static constexpr const char* kName = "LiveMessage";
  static constexpr const char* kType = "live";
  double t = 0.0;
  std::optional<Pose> pose;
  double v = 0.0, w = 0.0, p_lost = 0.0;
  std::vector<std::array<double, 4>> hypotheses;  ///< x, y, heading, mass
  Scan scan;
  std::vector<std::tuple<std::uint32_t, double, double, double, double>> people;  ///< id, x, y, vx, vy
  std::optional<Avoid> avoid;
  std::optional<double> battery;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("t", d.t), v("pose", d.pose), v("v", d.v), v("w", d.w), v("p_lost", d.p_lost), v("hypotheses", d.hypotheses);
    v("scan", d.scan), v("people", d.people), v.maybe("avoid", d.avoid), v.maybe("battery", d.battery);
  }
};

/// All that a viewer gets of what moves who wants little, or comes when many are there.
struct PoseMessage {
  static constexpr const char* kName = "PoseMessage";
  static constexpr const char* kType = "pose";
  double t = 0.0;
  std::optional<Pose> pose;
  double v = 0.0, w = 0.0, p_lost = 0.0;
  std::optional<double> battery;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("t", d.t), v("pose", d.pose), v("v", d.v), v("w", d.w), v("p_lost", d.p_lost), v.maybe("battery", d.battery);
  }
};

struct BeliefHypothesis {
  static constexpr const char* kName = "BeliefHypothesis";
  Pose pose{};
  double mass = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("pose", d.pose), v("mass", d.mass), v("xx", d.xx), v("xy", d.xy), v("yy", d.yy);
  }
};
struct BeliefMessage {
  static constexpr const char* kName = "BeliefMessage";
  static constexpr const char* kType = "belief";
  double t = 0.0;
  bool localized = false;
  double p_lost = 0.0, entropy = 0.0;
  std::uint32_t active = 0;
  std::array<std::uint32_t, 2> beams{};  ///< used, filtered
  std::vector<BeliefHypothesis> hypotheses;
  Raster raster;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("t", d.t), v("localized", d.localized), v("p_lost", d.p_lost), v("entropy", d.entropy), v("active", d.active);
    v("beams", d.beams), v("hypotheses", d.hypotheses), v("raster", d.raster);
  }
};
struct PathMessage {
  static constexpr const char* kName = "PathMessage";
  static constexpr const char* kType = "path";
  std::vector<double> points;  ///< x, y, x, y …
  std::string goal, state;
  double remaining = 0.0, blocked = 0.0;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("points", d.points), v("goal", d.goal), v("state", d.state), v("remaining", d.remaining), v("blocked", d.blocked);
  }
};

struct Prompt {
  static constexpr const char* kName = "Prompt";
  std::string id;
  Texts text;
  std::string language;  ///< in which it is spoken
  std::vector<std::string> options;
  std::string default_option;
  double deadline = 0.0;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("text", d.text), v("language", d.language), v("options", d.options);
    v("default", d.default_option), v("deadline", d.deadline);
  }
};
struct MissionMessage {
  static constexpr const char* kName = "MissionMessage";
  static constexpr const char* kType = "mission";
  std::string phase, tour, exhibit;
  Texts text;
  std::vector<std::string> agenda;
  std::uint32_t explained = 0, tours = 0, served = 0;
  std::optional<Prompt> prompt;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("phase", d.phase), v("tour", d.tour), v("exhibit", d.exhibit), v("text", d.text), v("agenda", d.agenda);
    v("explained", d.explained), v("tours", d.tours), v("served", d.served), v("prompt", d.prompt);
  }
};
struct SpeechMessage {
  static constexpr const char* kName = "SpeechMessage";
  static constexpr const char* kType = "speech";
  std::string id, state, text, language;
  double start = 0.0, duration = 0.0;
  std::string audio;  ///< where it can be fetched; empty: nowhere
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("state", d.state), v("text", d.text), v("language", d.language), v("start", d.start);
    v("duration", d.duration), v("audio", d.audio);
  }
};
struct HornMessage {
  static constexpr const char* kName = "HornMessage";
  static constexpr const char* kType = "horn";
  double t = 0.0, duration = 0.0;
  std::string audio;  ///< empty while the robot is muted
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("t", d.t), v("duration", d.duration), v("audio", d.audio);
  }
};
/// How loud a page plays what, and the music that plays now.
struct SoundMessage {
  static constexpr const char* kName = "SoundMessage";
  static constexpr const char* kType = "sound";
  double volume = 1.0;        ///< 0..1, of speech and horn
  std::string music;          ///< where it can be fetched; empty: none plays
  double music_volume = 0.0;  ///< 0..1, less while the robot speaks
  double start = 0.0;         ///< since when it plays round and round
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("volume", d.volume), v("music", d.music), v("music_volume", d.music_volume), v("start", d.start);
  }
};

struct ExpressionMessage {
  static constexpr const char* kName = "ExpressionMessage";
  static constexpr const char* kType = "expression";
  Mood mood = Mood::neutral;
  double valence = 0.0;  ///< -1 (angry) .. 1 (happy)
  bool is_speaking = false;
  std::string gaze;
  double pan = 0.0, tilt = 0.0;  ///< to the robot's left, upwards
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("mood", d.mood), v("valence", d.valence), v("is_speaking", d.is_speaking), v("gaze", d.gaze);
    v("pan", d.pan), v("tilt", d.tilt);
  }
};
struct ButtonMessage {
  static constexpr const char* kName = "ButtonMessage";
  static constexpr const char* kType = "button";
  double t = 0.0;
  int number = 0;  ///< 1 red, 2 yellow, 3 green, 4 blue
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("t", d.t), v("number", d.number);
  }
};

struct BoardEntry {
  static constexpr const char* kName = "BoardEntry";
  std::string key;  ///< the last digits of the request's id
  std::string source, visitor, kind, target;
  int viewpoint = -1;
  std::string state;
  std::optional<Reason> reason;
  double created = 0.0, changed = 0.0;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("key", d.key), v("source", d.source), v("visitor", d.visitor), v("kind", d.kind), v("target", d.target);
    v("viewpoint", d.viewpoint), v("state", d.state), v("reason", d.reason), v("created", d.created);
    v("changed", d.changed);
  }
};
struct BoardMessage {
  static constexpr const char* kName = "BoardMessage";
  static constexpr const char* kType = "board";
  std::uint64_t revision = 0;
  std::vector<BoardEntry> open;
  std::size_t open_count = 0;
  std::vector<BoardEntry> closed;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("revision", d.revision), v("open", d.open), v("open_count", d.open_count), v("closed", d.closed);
  }
};

/// Which tour the Web's visitors want next.
struct VotesMessage {
  static constexpr const char* kName = "VotesMessage";
  static constexpr const char* kType = "votes";
  std::string round;  ///< its last digits: another one, and everybody votes anew
  std::vector<std::tuple<std::string, std::uint32_t>> tours;  ///< those that have votes, with their number
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("round", d.round), v("tours", d.tours);
  }
};
/// Whose hours these are.
struct HoursMessage {
  static constexpr const char* kName = "HoursMessage";
  static constexpr const char* kType = "hours";
  std::string mode;       ///< open, web, closed
  bool is_open = false;   ///< the robot takes requests
  std::string next_mode;  ///< comes next by itself, as the museum's hours say; empty: none does
  std::string next_at;    ///< "HH:MM" by the museum's clock
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("mode", d.mode), v("is_open", d.is_open), v("next_mode", d.next_mode), v("next_at", d.next_at);
  }
};

struct Acknowledgement {
  static constexpr const char* kName = "Acknowledgement";
  static constexpr const char* kType = "ack";
  std::string id;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id);
  }
};
struct Refusal {
  static constexpr const char* kName = "Refusal";
  static constexpr const char* kType = "refused";
  std::string id;
  Reason reason;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("reason", d.reason);
  }
};
struct ErrorMessage {
  static constexpr const char* kName = "ErrorMessage";
  static constexpr const char* kType = "error";
  Reason reason;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("reason", d.reason);
  }
};

/// Everything that the live channel carries to a page.
using ServerMessage =
    std::tuple<LiveMessage, PoseMessage, BeliefMessage, PathMessage, MissionMessage, SpeechMessage, HornMessage,
               SoundMessage, ExpressionMessage, ButtonMessage, BoardMessage, VotesMessage, HoursMessage, FieldMessage,
               MapsMessage, ExplorationMessage, LogMessage, OperationMessage, HealthMessage, WindowMessage,
               Acknowledgement, Refusal, ErrorMessage>;

}  // namespace docent::telepresence::documents
