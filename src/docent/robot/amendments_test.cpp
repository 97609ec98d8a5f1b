#include "docent/robot/amendments.h"

#include <gtest/gtest.h>

namespace docent::robot {
namespace {

struct Legs {
  int count = 2;
};
struct LongLegs : Legs {};

TEST(Amendments, ChangeTheirOwnTypeAloneInTheirOrder) {
  Amendments amendments;
  amendments.add<Legs>([](Legs& legs) { legs.count += 1; });
  amendments.add<Legs>([](Legs& legs) { legs.count *= 10; });
  Legs legs;
  LongLegs others;
  amendments.apply(legs);
  amendments.apply(others);
  EXPECT_EQ(legs.count, 30);
  EXPECT_EQ(others.count, 2) << "a derived type is another one";
}

TEST(Amendments, WithoutAnyNothingChanges) {
  Legs legs;
  Amendments{}.apply(legs);
  EXPECT_EQ(legs.count, 2);
}

}  // namespace
}  // namespace docent::robot
