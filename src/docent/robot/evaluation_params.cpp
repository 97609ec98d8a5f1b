#include "docent/robot/evaluation_params.h"

namespace docent::robot {

std::string EvaluationParams::crippled() const {
  std::string names;
  const auto name_unless_default = [&names](const char* name, auto value) {
    if (value != decltype(value){}) names += (names.empty() ? "" : ", ") + std::string{name};
  };
  EvaluationParams values = *this;
  values.visit(name_unless_default);
  return names;
}

}  // namespace docent::robot
