#include "docent/apps/laboratory/ablations/ablation_params.h"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>
#include <utility>

#include "docent/base/files.h"

namespace docent::apps::ablations {
namespace {

TEST(AblationParams, EverySwitchIsNamedWhenItIsNotAsByDefault) {
  AblationParams params;
  EXPECT_EQ(params.crippled(), "");
  int switches = 0;
  const auto change_and_back = [&](const char* name, auto& value) {
    const auto before = std::exchange(value, static_cast<std::remove_reference_t<decltype(value)>>(1));
    EXPECT_EQ(params.crippled(), name);
    value = before;
    ++switches;
  };
  params.visit(change_and_back);
  EXPECT_GE(switches, 21);
  params.best_pose_error_x = -0.5;
  params.without_ladder = true;
  EXPECT_EQ(params.crippled(), "best_pose_error_x, without_ladder");
}

TEST(AblationParams, TheReadmeExplainsEverySwitch) {
  const auto readme = read_file("src/docent/apps/laboratory/ablations/README.md");
  ASSERT_TRUE(readme);
  const auto is_explained = [&](const char* name, auto&) {
    EXPECT_NE(readme->find("| `" + std::string{name} + "` | "), std::string::npos) << name;
  };
  AblationParams params;
  params.visit(is_explained);
}

}  // namespace
}  // namespace docent::apps::ablations
