#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "docent/base/result.h"
#include "docent/vocabulary/vocabulary.h"

// What a browser may say to the robot, as JSON text of at most a few kilobytes. Everything is checked here, so that
// nothing behind this line has to doubt it. From each `visit` come the page's types (contract/).

namespace docent::telepresence {

/// {"type":"request","id":UUIDv7,"kind":"exhibit"|"tour","target":…,"viewpoint"?:n,"name"?:…,"language"?:…}
struct RequestMessage {
  static constexpr const char* kName = "RequestMessage";
  static constexpr const char* kType = "request";
  std::string id;
  RequestKind kind = RequestKind::exhibit;  ///< or tour, or point
  std::string target;
  int viewpoint = -1;
  std::string name;  ///< at most 40 characters on one line, nothing that is not printed
  std::string language;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id), v("kind", m.kind), v("target", m.target), v("viewpoint", m.viewpoint), v("name", m.name),
        v("language", m.language);
  }
};
/// {"type":"cancel","id":UUIDv7,"request":UUIDv7}
struct CancelMessage {
  static constexpr const char* kName = "CancelMessage";
  static constexpr const char* kType = "cancel";
  std::string id;
  std::string request;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id), v("request", m.request);
  }
};
/// {"type":"choice","id":UUIDv7,"prompt":…,"choice":…}
struct ChoiceMessage {
  static constexpr const char* kName = "ChoiceMessage";
  static constexpr const char* kType = "choice";
  std::string id;
  std::string prompt;
  std::string choice;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id), v("prompt", m.prompt), v("choice", m.choice);
  }
};
/// {"type":"vote","id":UUIDv7,"voter":UUIDv7,"tour":…}: the tour that the voter wants next; a later vote replaces it.
struct VoteMessage {
  static constexpr const char* kName = "VoteMessage";
  static constexpr const char* kType = "vote";
  std::string id;
  std::string voter;  ///< an id that the browser keeps
  std::string tour;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id), v("voter", m.voter), v("tour", m.tour);
  }
};
/// {"type":"watch","details":true|false,"thin":true|false}: also send what only specialists look at; of what moves send
/// the pose alone.
struct WatchMessage {
  static constexpr const char* kName = "WatchMessage";
  static constexpr const char* kType = "watch";
  bool details = false;
  bool thin = false;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("details", m.details), v("thin", m.thin);
  }
};

// Of the robot's own screen alone:

/// {"type":"lamps","lit":[1,4]}: the buttons that lead somewhere now.
struct LampsMessage {
  static constexpr const char* kName = "LampsMessage";
  static constexpr const char* kType = "lamps";
  std::vector<int> lit;  ///< of 1 to 4, rising
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("lit", m.lit);
  }
};
/// {"type":"help","id":UUIDv7,"language":…}: the robot is to say what it can do.
struct HelpMessage {
  static constexpr const char* kName = "HelpMessage";
  static constexpr const char* kType = "help";
  std::string id;
  std::string language;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id), v("language", m.language);
  }
};
/// {"type":"skip","id":UUIDv7,"exhibit":…}: the tour is to go on without the stop under way.
struct SkipMessage {
  static constexpr const char* kName = "SkipMessage";
  static constexpr const char* kType = "skip";
  std::string id;
  std::string exhibit;  ///< of the stop that is not wanted: a press that comes late skips no other
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id), v("exhibit", m.exhibit);
  }
};
/// {"type":"answer","id":UUIDv7,"question":…,"answer":…,"language":…}: to the poll after a tour.
struct AnswerMessage {
  static constexpr const char* kName = "AnswerMessage";
  static constexpr const char* kType = "answer";
  std::string id;
  PollQuestion question = PollQuestion::liked;
  PollAnswer answer = PollAnswer::undecided;  ///< fits the question
  std::string language;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id), v("question", m.question), v("answer", m.answer), v("language", m.language);
  }
};

// Of an operator alone, on /operate:

/// {"type":"lease","id":UUIDv7,"wants":true}: they want to steer, or no longer.
struct LeaseMessage {
  static constexpr const char* kName = "LeaseMessage";
  static constexpr const char* kType = "lease";
  std::string id;
  bool wants = false;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id), v("wants", m.wants);
  }
};
/// {"type":"steer","pressed":true,"forward":0.5,"turn":-0.2}: ten times a second, by whoever holds the lease.
struct SteerMessage {
  static constexpr const char* kName = "SteerMessage";
  static constexpr const char* kType = "steer";
  bool pressed = false;  ///< the dead man's switch
  double forward = 0.0;  ///< -1..1
  double turn = 0.0;     ///< -1..1, to the left
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("pressed", m.pressed), v("forward", m.forward), v("turn", m.turn);
  }
};
/// {"type":"stop","id":UUIDv7,"stopped":true,"number":n}: the stop button; nobody needs the lease for it. A release
/// names the stop that it is for, as `operation` shows it.
struct StopMessage {
  static constexpr const char* kName = "StopMessage";
  static constexpr const char* kType = "stop";
  std::string id;
  bool stopped = false;
  int number = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id), v("stopped", m.stopped), v("number", m.number);
  }
};
/// {"type":"set_hours","id":UUIDv7,"mode":"web"}: whose requests are taken from now on; hours: as the museum's hours
/// say.
struct SetHoursMessage {
  static constexpr const char* kName = "SetHoursMessage";
  static constexpr const char* kType = "set_hours";
  std::string id;
  OperatingMode mode = OperatingMode::hours;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id), v("mode", m.mode);
  }
};
using ClientMessage =
    std::variant<RequestMessage, CancelMessage, ChoiceMessage, VoteMessage, WatchMessage, LampsMessage, HelpMessage,
                 SkipMessage, AnswerMessage, LeaseMessage, SteerMessage, StopMessage, SetHoursMessage>;

/// Error: what is wrong with it, for the close frame (at most 120 bytes, ASCII).
[[nodiscard]] Result<ClientMessage> parse_client_message(std::string_view text);

/// A UUID of version 7 in lower-case hexadecimal digits.
[[nodiscard]] bool is_uuid7(std::string_view text);
/// An id of museum.yaml: 1 to 64 of a-z, A-Z, 0-9, '_', '-', '.'.
[[nodiscard]] bool is_identifier(std::string_view text);
/// An id of a question: such ids with '/' between them, 1 to 64 characters together.
[[nodiscard]] bool is_prompt_id(std::string_view text);
/// One line of at most `limit` characters: control, format and bidirectional characters and outer blanks are dropped.
/// @pre `text` is valid UTF-8
[[nodiscard]] std::string clean_name(std::string_view text, std::size_t limit = 40);
/// Likewise of several lines with '\n' between them, never more than one of them empty in a row.
[[nodiscard]] std::string clean_text(std::string_view text, std::size_t limit);

}  // namespace docent::telepresence
