#pragma once

#include <memory>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/museum/museum.h"
#include "docent/pictures/map_picture.h"
#include "docent/transport/bus.h"

namespace docent::apps::simulate_command {

/// The way a simulated robot truly drove, over the map that it drove by.
class SimulationPicture {
 public:
  void add(const transport::TopicInfo& topic, const std::shared_ptr<const void>& message);
  /// As SVG, PDF or PNG, by the path's extension.
  [[nodiscard]] Result<void> save(const museum::Museum& museum, const std::string& path) const;

 private:
  std::vector<pictures::TimedPoint> way_;  ///< [m], world; a point every 10 cm
  pictures::TimedPoint last_;              ///< the last state
  std::vector<Point2> contacts_;           ///< [m], world
};

}  // namespace docent::apps::simulate_command
