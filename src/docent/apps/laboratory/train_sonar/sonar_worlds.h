#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/mapping/sonar_network/sonar_network.h"

namespace docent::apps::train_sonar_command {

/// The robot at one place of a known world: what its sonars say, and what is there.
struct SonarPlace {
  Pose2 world_from_base;
  mapping::SonarView view;
};

/// A known world: drawn, or a museum's own simulation.yaml.
class SonarWorld {
 public:
  /// A drawn office building.
  [[nodiscard]] static SonarWorld office(std::uint64_t seed);
  /// CommandFailed where there is none.
  [[nodiscard]] static SonarWorld museum(const std::string& folder);
  SonarWorld(SonarWorld&&) noexcept;
  SonarWorld& operator=(SonarWorld&&) noexcept;
  ~SonarWorld();

  /// Solid, or outside of the building.
  [[nodiscard]] bool is_occupied(Point2 in_world) const;
  /// Lower left and upper right corner [m].
  [[nodiscard]] std::pair<Point2, Point2> bounds() const;
  /// The robot at places drawn from the floor, with any heading; every sonar fires once at each.
  [[nodiscard]] std::vector<SonarPlace> places(std::size_t count, std::uint64_t seed) const;

 private:
  struct Hall;
  explicit SonarWorld(std::unique_ptr<Hall> hall);
  std::unique_ptr<Hall> hall_;
};

/// The simulated ring as its data sheet says.
[[nodiscard]] mapping::SonarRingGeometry ring_of_data_sheet();

/// `cells` places drawn evenly over the disc of `reach` [m] about each of the robot's.
struct SonarTrial {
  std::vector<mapping::SonarExample> examples;
  std::vector<std::size_t> of_place;  ///< index of the robot's place, for each example
  std::vector<Point2> at;             ///< [m], base frame, of each example
};
[[nodiscard]] SonarTrial drawn_trial(const SonarWorld& world, std::span<const SonarPlace> places, std::size_t cells,
                                     double reach, std::uint64_t seed);

}  // namespace docent::apps::train_sonar_command
