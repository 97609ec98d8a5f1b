#include "docent/apps/laboratory/laboratory.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/apps/shared/laboratory_commands.h"

namespace docent::apps::laboratory {
namespace {

TEST(Laboratory, HasTheCommandsThatDocentSaysItHas) {
  std::vector<std::string> names = names_of_commands(docent_lab("0"));
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{kLaboratoryCommands.begin(), kLaboratoryCommands.end()}));
}

}  // namespace
}  // namespace docent::apps::laboratory
