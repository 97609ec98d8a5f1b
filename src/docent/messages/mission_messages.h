#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "docent/messages/request_messages.h"
#include "docent/messages/standard_messages.h"

// What the robot is about: the mission, its tasks, and what happened.

namespace docent::docent_msgs {

/// What the robot is about, in words; latched.
struct MissionState {
  static constexpr const char* kType = "docent_msgs/msg/MissionState";
  std_msgs::Header header;
  std::string phase;  ///< waking, relocalizing, idle, driving, explaining, asking, going_home, charging, waiting
  std::string tour_id;
  std::string exhibit_id;  ///< the present or next exhibit
  Prompt prompt;
  std::uint32_t exhibits_explained = 0;  ///< since the start of the deployment
  std::uint32_t tours_completed = 0;
  std::uint32_t requests_served = 0;
  std::vector<std::string> agenda;     ///< exhibit ids still to come, in order
  std::vector<std::string> languages;  ///< codes of the museum's languages, its own first
  std::vector<std::string> texts;      ///< [languages] one sentence for people: what it is doing
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("phase", m.phase);
    v("tour_id", m.tour_id);
    v("exhibit_id", m.exhibit_id);
    v("prompt", m.prompt);
    v("exhibits_explained", m.exhibits_explained);
    v("tours_completed", m.tours_completed);
    v("requests_served", m.requests_served);
    v("agenda", m.agenda);
    v("languages", m.languages);
    v("texts", m.texts);
  }
};

/// One thing to do, from mission to executive; latched. A new id replaces the task before it.
struct Task {
  static constexpr const char* kType = "docent_msgs/msg/Task";
  std::string id;          ///< empty: nothing to do
  std::string kind;        ///< visit, farewell, home, charge, relocalize, mingle, point, or one of a museum's own
  std::string exhibit_id;  ///< for charge: of the visit that is broken off for it
  double x = 0;            ///< [m], map: where to stand
  double y = 0;
  double theta = 0;
  std::string language;
  bool offer_more = true;
  std::string tour_id;
  std::string gaze;    ///< for mingle: nearest, everybody, ahead
  std::string face;    ///< likewise: neutral, happy, sad, angry
  std::string speech;  ///< likewise: invite, ask, silence, demand, complain
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
    v("gaze", m.gaze);
    v("face", m.face);
    v("speech", m.speech);
  }
};

/// How the task goes; latched, from executive.
struct TaskState {
  static constexpr const char* kType = "docent_msgs/msg/TaskState";
  std_msgs::Header header;
  std::string id;
  std::string state;   ///< driving, explaining, asking, done, failed
  std::string reason;  ///< why it failed or does not go on: as in RequestState
  Prompt prompt;
  bool took_long = false;  ///< the visitor asked for more
  std::string look;        ///< where the task wants the head to look: place, visitors, way, nobody, company
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("id", m.id);
    v("state", m.state);
    v("reason", m.reason);
    v("prompt", m.prompt);
    v("took_long", m.took_long);
    v("look", m.look);
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

}  // namespace docent::docent_msgs
