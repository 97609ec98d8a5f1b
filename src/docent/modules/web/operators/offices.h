#pragma once

#include <memory>

#include "docent/modules/web/operators/museum_desk.h"
#include "docent/modules/web/operators/robot_desk.h"
#include "docent/modules/web/operators/setup_desk.h"
#include "docent/telepresence/site.h"

namespace docent::modules {

/// What operators do through the desk of /api/v1, and the site that shows it.
struct Offices {
  explicit Offices(const ModuleContext& context)
      : site{std::make_shared<telepresence::Site>()},
        museum{std::make_unique<MuseumDesk>(context)},
        robot{std::make_unique<RobotDesk>(context.bus)},
        setup{std::make_unique<SetupDesk>(context, *site)} {}
  std::shared_ptr<telepresence::Site> site;
  std::unique_ptr<MuseumDesk> museum;
  std::unique_ptr<RobotDesk> robot;
  std::unique_ptr<SetupDesk> setup;
};

}  // namespace docent::modules
