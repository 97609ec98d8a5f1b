#pragma once

#include <optional>

#include "docent/apps/laboratory/ablations/ablation_params.h"
#include "docent/apps/shared/robot_maker.h"

namespace docent::apps::ablations {

/// Makes a robot that is crippled as section `evaluation` of robot.yaml says. Without the section it is whole.
class CrippledRobot final : public RobotMaker {
 public:
  [[nodiscard]] std::vector<std::string> sections() const override { return {"evaluation"}; }
  [[nodiscard]] Result<void> read(robot::RobotConfig& config) override;
  [[nodiscard]] std::string crippled() const override { return params_.crippled(); }
  [[nodiscard]] Result<std::unique_ptr<modules::ModuleHost>> make(const modules::ModuleEntry& entry,
                                                                  std::unique_ptr<transport::Bus> bus,
                                                                  const museum::Museum& museum,
                                                                  const robot::RobotConfig& config,
                                                                  const modules::ModuleHost::Options& options) override;

 private:
  AblationParams params_;
  std::optional<museum::Museum> without_hazards_;  ///< the modules' museum, where some are to know no hazards
};

}  // namespace docent::apps::ablations
