#include "docent/task_control/golog/golog_term.h"

#include <gtest/gtest.h>

namespace docent::task_control {
namespace {

TEST(GologTerm, IsWrittenAsAPersonReadsIt) {
  EXPECT_EQ(to_text({"lost"}), "lost");
  EXPECT_EQ(to_text({"drive", {"tv-sat"}}), "drive(tv-sat)");
  EXPECT_EQ(to_text({"battery", {0.15, "front"}}), "battery(0.15, front)");
}

}  // namespace
}  // namespace docent::task_control
