#pragma once

#include <filesystem>
#include <string>

#include "docent/interaction/attract/attraction.h"
#include "docent/modules/guide/people_around.h"
#include "docent/modules/shared/module.h"
#include "docent/task_control/mission_service/company.h"

namespace docent::modules {

/// How the robot attracts people between two tours, and learns from it.
struct MinglingParams : interaction::AttractionParams {
  double around_m = 5.0;  ///< [m] > 0: who is farther away is neither company nor counted in the density
  template <class V>
  void visit(V& v) {
    v("around_m", around_m);
    interaction::AttractionParams::visit(v);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// The learner in the robot: phases before the people that the robot sees, remembered in state/attraction.json.
class Mingling final : public task_control::Company {
 public:
  Mingling(const ModuleContext& context, const MinglingParams& params);

  [[nodiscard]] bool is_there() const override;
  [[nodiscard]] interaction::AttractionAction begin() override;
  void observe() override;
  [[nodiscard]] std::optional<interaction::AttractionTrial> finish() override;
  [[nodiscard]] const std::string& fault() const override { return fault_; }

 private:
  [[nodiscard]] std::vector<Point2> near() const;

  const transport::Bus& bus_;
  MinglingParams params_;
  std::filesystem::path file_;
  Survives survives_;
  std::string fault_;
  PeopleAround around_;
  interaction::Attraction attraction_;
};

}  // namespace docent::modules
