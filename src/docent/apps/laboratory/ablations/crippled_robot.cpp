#include "docent/apps/laboratory/ablations/crippled_robot.h"

#include "docent/apps/laboratory/ablations/ablations.h"

namespace docent::apps::ablations {

Result<void> CrippledRobot::read(robot::RobotConfig& config) {
  const auto params = config.section<AblationParams>("evaluation");
  if (!params) return tl::unexpected<Error>(params.error());
  params_ = *params;
  config.set_amendments(amendments_of(params_));
  return {};
}

Result<std::unique_ptr<modules::ModuleHost>> CrippledRobot::make(const modules::ModuleEntry& entry,
                                                                 std::unique_ptr<transport::Bus> bus,
                                                                 const museum::Museum& museum,
                                                                 const robot::RobotConfig& config,
                                                                 const modules::ModuleHost::Options& options) {
  BusAlterations alterations = alterations_of(params_, entry.name);
  if (!alterations.empty()) bus = std::make_unique<AlteredBus>(std::move(bus), std::move(alterations));
  const bool knows_hazards = !ignores_hazards(params_, entry.name);
  if (!knows_hazards && !without_hazards_) without_hazards_ = without_hazards(museum);
  return modules::ModuleHost::create(entry, std::move(bus), knows_hazards ? museum : *without_hazards_, config,
                                     options);
}

}  // namespace docent::apps::ablations
