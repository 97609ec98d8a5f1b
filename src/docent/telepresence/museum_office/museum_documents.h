#pragma once

#include <optional>
#include <string>
#include <vector>

#include "docent/telepresence/documents.h"

// What /api/v1/museum takes and gives: the museum as operators change it. Metres and radians in the map's frame.

namespace docent::telepresence::documents {

struct MuseumDraft {
  static constexpr const char* kName = "MuseumDraft";
  std::vector<Point> area;
  std::vector<Hazard> hazards;
  Pose home{};
  std::optional<Pose> charger;
  std::vector<Exhibit> exhibits;  ///< their pictures are not looked at
  std::vector<Tour> tours;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("area", d.area), v("hazards", d.hazards), v("home", d.home), v("charger", d.charger), v("exhibits", d.exhibits);
    v("tours", d.tours);
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

}  // namespace docent::telepresence::documents
