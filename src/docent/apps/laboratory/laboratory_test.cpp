#include "docent/apps/laboratory/laboratory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "docent/apps/shared/laboratory_commands.h"

namespace docent::apps::laboratory {
namespace {

TEST(Laboratory, HasFourCommandsOfDocentAndThoseThatDocentSaysItHas) {
  std::vector<std::string> names = names_of_commands(docent_lab("0"));
  for (const char* common : {"simulate", "explore", "replay", "run"})
    EXPECT_EQ(std::erase(names, common), 1U) << common;
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{kLaboratoryCommands.begin(), kLaboratoryCommands.end()}));
}

}  // namespace
}  // namespace docent::apps::laboratory
