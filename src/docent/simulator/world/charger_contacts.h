#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"

namespace docent::simulator {

/// What of a charger gives current: springs that a base must meet.
struct ChargerContacts {
  Pose2 at;              ///< world, of a base that stands right
  double across = 0.02;  ///< [m] it may stand beside that,
  double before = 0.01;  ///< [m] short of it,
  double beyond = 0.05;  ///< [m] on past it, for the springs give way,
  double turned = 10.0;  ///< [deg] or turned

  /// Whether a base there has current.
  [[nodiscard]] bool reach(const Pose2& world_from_base) const;
};

/// What simulation.yaml says of them: `contacts: {x: 7, y: 1.5, heading: -90, across: 0.02}`. nullopt: nothing; then a
/// base that stands within 0.4 m of the charger has current.
[[nodiscard]] Result<std::optional<ChargerContacts>> load_contacts(const std::filesystem::path& simulation_yaml);
/// From memory; `name` stands where the file's name would.
[[nodiscard]] Result<std::optional<ChargerContacts>> parse_contacts(const std::string& text, const std::string& name);

}  // namespace docent::simulator
