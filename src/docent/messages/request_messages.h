#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "docent/messages/standard_messages.h"

// What visitors ask for and what becomes of it.

namespace docent::docent_msgs {

/// A wish of a visitor. Resent until it is on the request board (architecture 10.8).
struct Request {
  static constexpr const char* kType = "docent_msgs/msg/Request";
  std::string id;  ///< UUIDv7, made at the edge
  builtin_interfaces::Time stamp;
  std::string source;   ///< web, kiosk, visitor, staff, vote
  std::string visitor;  ///< a name to show
  std::string kind;     ///< exhibit, tour, cancel, point, room
  std::string target;   ///< exhibit or tour id; for cancel: the request's id; for point: "x,y" [m], map; for room: its
                        ///< id or "next"
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
  std::string state;   ///< queued, active, fulfilled, failed, refused, cancelled
  std::string reason;  ///< a word of ReasonWord (vocabulary/reason.h), alone or with what it is about; empty: none
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

/// How the Web's visitors vote which tour comes next; latched, from web.
struct Votes {
  static constexpr const char* kType = "docent_msgs/msg/Votes";
  std_msgs::Header header;
  std::string round;  ///< UUIDv7: the id of the request that the robot makes of the most voted tour
  std::vector<std::string> tours;
  std::vector<std::uint32_t> counts;  ///< [tours]
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("round", m.round);
    v("tours", m.tours);
    v("counts", m.counts);
  }
};

/// A question with buttons and a default.
struct Prompt {
  static constexpr const char* kType = "docent_msgs/msg/Prompt";
  std::string id;                      ///< empty: nothing is asked
  std::string language;                ///< code of the one in which it is spoken
  std::vector<std::string> languages;  ///< codes of the museum's languages, its own first
  std::vector<std::string> texts;      ///< [languages] the question
  std::vector<std::string> options;    ///< more, next, yes, no
  std::string default_option;
  builtin_interfaces::Time deadline;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("language", m.language);
    v("languages", m.languages);
    v("texts", m.texts);
    v("options", m.options);
    v("default_option", m.default_option);
    v("deadline", m.deadline);
  }
};

}  // namespace docent::docent_msgs
