#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace docent::apps::localize_command {

/// What a run of `docent localize` found, in sentences, from its report (architecture 9). What the report lacks is left
/// out.
[[nodiscard]] std::string summary_of_run(const nlohmann::json& report);
/// How two runs over one log agree, from `agreement` of a report.
[[nodiscard]] std::string summary_of_agreement(const nlohmann::json& agreement);

}  // namespace docent::apps::localize_command
