#pragma once

#include <string>
#include <vector>

#include "docent/apps/doctor/findings.h"
#include "docent/modules/host/process_class.h"
#include "docent/modules/web/web_params.h"

namespace docent::apps::doctor_command {

/// What the computer must offer.
struct ComputerDemand {
  std::string state;  ///< folder
  int port = 8080;    ///< of the page
  bool robot_runs = false;
  modules::ProcessParams processes;
  modules::WebParams web;
};

/// Disk, processors, memory, real-time right, clock, port, accounts and https, as far as this process can see them. It
/// changes nothing.
[[nodiscard]] std::vector<Finding> findings_of_computer(const ComputerDemand& demand);

}  // namespace docent::apps::doctor_command
