#pragma once

#include <optional>
#include <string>
#include <vector>

#include "docent/telepresence/documents.h"

// What /api/v1/museum takes and gives: the museum as operators change it. Metres and radians in the map's frame.

namespace docent::telepresence::documents {

/// What a room, or a part of a large one, is called.
struct RoomName {
  static constexpr const char* kName = "RoomName";
  std::string id;
  Texts name;
  Point at{};  ///< where the robot goes in it
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("name", d.name), v("at", d.at);
  }
};
/// The hours of each mode, "HH:MM-HH:MM".
struct OpeningHours {
  static constexpr const char* kName = "OpeningHours";
  std::vector<std::string> open;  ///< without any: all day, but for the others
  std::vector<std::string> web, closed;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("open", d.open), v("web", d.web), v("closed", d.closed);
  }
};
struct MuseumDraft {
  static constexpr const char* kName = "MuseumDraft";
  std::vector<Point> area;
  std::vector<Hazard> hazards;
  Pose home{};
  std::optional<Pose> charger;
  std::vector<Exhibit> exhibits;  ///< `picture` is a file of the museum's folder here
  std::vector<Tour> tours;
  std::vector<RoomName> rooms;
  OpeningHours hours;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("area", d.area), v("hazards", d.hazards), v("home", d.home), v("charger", d.charger), v("exhibits", d.exhibits);
    v("tours", d.tours), v("rooms", d.rooms), v("hours", d.hours);
  }
};
struct MuseumEdition {
  static constexpr const char* kName = "MuseumEdition";
  std::string revision;   ///< of what is published; goes back with every wish to change it
  bool is_trial = false;  ///< the robot is in a trial, which is what the draft says
  MuseumDraft draft;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("revision", d.revision), v("is_trial", d.is_trial), v("draft", d.draft);
  }
};
struct MuseumWish {
  static constexpr const char* kName = "MuseumWish";
  std::string revision;
  MuseumDraft draft;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("revision", d.revision), v("draft", d.draft);
  }
};
struct MuseumFaults {
  static constexpr const char* kName = "MuseumFaults";
  std::vector<std::string> faults;  ///< sentences in English; none: it was done
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("faults", d.faults);
  }
};

/// A picture that an exhibit shall have.
struct MuseumPicture {
  static constexpr const char* kName = "MuseumPicture";
  std::string jpeg;  ///< the file in base64 (RFC 4648)
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("jpeg", d.jpeg);
  }
};
struct KeptPicture {
  static constexpr const char* kName = "KeptPicture";
  std::string picture;              ///< the file that a draft's exhibit may name; empty: it was not kept
  std::vector<std::string> faults;  ///< why not: sentences in English
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("picture", d.picture), v("faults", d.faults);
  }
};
/// What somebody may say instead of the voice.
struct Recording {
  static constexpr const char* kName = "Recording";
  std::string file;  ///< without its ending, in the museum's folder
  std::string language, text;
  bool is_recorded = false;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("file", d.file), v("language", d.language), v("text", d.text), v("is_recorded", d.is_recorded);
  }
};
struct MuseumRecordings {
  static constexpr const char* kName = "MuseumRecordings";
  std::vector<Recording> recordings;  ///< the texts of exhibits, and whatever else is recorded
  std::size_t lines = 0;              ///< that the robot can say, recorded or not
  std::vector<std::string> strays;    ///< files that are recordings of nothing
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("recordings", d.recordings), v("lines", d.lines), v("strays", d.strays);
  }
};

}  // namespace docent::telepresence::documents
