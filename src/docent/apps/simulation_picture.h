#pragma once

#include <memory>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"
#include "docent/museum/museum.h"
#include "docent/transport/bus.h"

namespace docent {

/// The way a simulated robot truly drove, over the map that it drove by.
class SimulationPicture {
 public:
  void add(const TopicInfo& topic, const std::shared_ptr<const void>& message);
  [[nodiscard]] Result<void> save(const Museum& museum, const std::string& png) const;

 private:
  std::vector<Point2> way_;       ///< [m], world; a point every 10 cm
  std::vector<Point2> contacts_;  ///< [m], world
};

}  // namespace docent
