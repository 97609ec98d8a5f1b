#include "docent/apps/doctor/findings.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace docent::apps::doctor_command {

const char* to_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::fine:
      return "fine";
    case Verdict::note:
      return "note";
    case Verdict::wrong:
      break;
  }
  return "wrong";
}

Verdict worst_of(const std::vector<Finding>& findings) {
  Verdict worst = Verdict::fine;
  for (const Finding& finding : findings) worst = std::max(worst, finding.verdict);
  return worst;
}

std::string page_of(const std::vector<Finding>& findings) {
  std::size_t width = 0;
  for (const Finding& finding : findings) width = std::max(width, finding.name.size());
  std::string page;
  std::string section;
  for (const Finding& finding : findings) {
    if (finding.section != section) page += (page.empty() ? "" : "\n") + finding.section + "\n";
    section = finding.section;
    std::string name = finding.name;
    name.resize(width, ' ');
    std::string verdict = finding.verdict == Verdict::wrong ? "WRONG" : to_text(finding.verdict);
    verdict.resize(5, ' ');
    page += "  " + verdict + "  " + name + "  " + finding.text + "\n";
  }
  const auto count = [&](Verdict verdict) {
    return std::to_string(std::count_if(findings.begin(), findings.end(),
                                        [verdict](const Finding& finding) { return finding.verdict == verdict; }));
  };
  return page + "\n" + count(Verdict::fine) + " fine, " + count(Verdict::note) + " to note, " + count(Verdict::wrong) +
         " wrong\n";
}

std::string json_of(const std::vector<Finding>& findings) {
  nlohmann::ordered_json all;
  all["verdict"] = to_text(worst_of(findings));
  all["findings"] = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    nlohmann::ordered_json one{{"section", finding.section},
                               {"name", finding.name},
                               {"verdict", to_text(finding.verdict)},
                               {"text", finding.text}};
    for (const auto& [name, value] : finding.figures) one["figures"][name] = value;
    all["findings"].push_back(std::move(one));
  }
  return all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace docent::apps::doctor_command
