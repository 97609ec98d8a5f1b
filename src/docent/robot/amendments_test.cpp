#include "docent/robot/amendments.h"

#include <gtest/gtest.h>

namespace docent::robot {
namespace {

struct Wheels {
  int count = 2;
};
struct SpareWheels : Wheels {};

TEST(Amendments, ChangeTheirOwnTypeAloneInTheirOrder) {
  Amendments amendments;
  amendments.add<Wheels>([](Wheels& wheels) { wheels.count += 1; });
  amendments.add<Wheels>([](Wheels& wheels) { wheels.count *= 10; });
  Wheels wheels;
  SpareWheels others;
  amendments.apply(wheels);
  amendments.apply(others);
  EXPECT_EQ(wheels.count, 30);
  EXPECT_EQ(others.count, 2) << "a derived type is another one";
}

TEST(Amendments, WithoutAnyNothingChanges) {
  Wheels wheels;
  Amendments{}.apply(wheels);
  EXPECT_EQ(wheels.count, 2);
}

}  // namespace
}  // namespace docent::robot
