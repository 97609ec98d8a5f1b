#include "docent/planning/detour/detour.h"

#include <gtest/gtest.h>

namespace docent::planning {
namespace {

TEST(Detour, TextsRoundTrip) {
  for (const Detour detour : {Detour::none, Detour::local, Detour::global})
    EXPECT_EQ(detour_of(to_text(detour)), detour);
  EXPECT_EQ(detour_of("somewhere"), Detour::none);
}

}  // namespace
}  // namespace docent::planning
