#include "docent/apps/laboratory/ablations/ablation_params.h"

namespace docent::apps::ablations {

std::string AblationParams::crippled() const {
  std::string names;
  const auto name_unless_default = [&names](const char* name, auto value) {
    if (value != decltype(value){}) names += (names.empty() ? "" : ", ") + std::string{name};
  };
  AblationParams values = *this;
  values.visit(name_unless_default);
  return names;
}

}  // namespace docent::apps::ablations
