#pragma once

#include <string>
#include <vector>

#include "docent/vocabulary/vocabulary.h"

// What /api/v1/setup takes and gives: a museum that is being set up.

namespace docent::telepresence::documents {

struct SetupState {
  static constexpr const char* kName = "SetupState";
  SetupStep step{};
  std::string name;  ///< of the museum
  std::vector<std::string> languages;
  bool has_explored = false;  ///< the robot has made a map that may be kept
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("step", d.step), v("name", d.name), v("languages", d.languages), v("has_explored", d.has_explored);
  }
};
struct SetupName {
  static constexpr const char* kName = "SetupName";
  std::string name;
  std::vector<std::string> languages;  ///< of ISO 639-1, the first one is that of those who say nothing
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("name", d.name), v("languages", d.languages);
  }
};
struct SetupOrder {
  static constexpr const char* kName = "SetupOrder";
  ExplorationOrder order{};
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("order", d.order);
  }
};
struct SetupWish {
  static constexpr const char* kName = "SetupWish";
  SetupStep step{};
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("step", d.step);
  }
};

}  // namespace docent::telepresence::documents
