#include "docent/simulator/world/charger_contacts.h"

#include <gtest/gtest.h>

namespace docent::simulator::charger_contacts_test {
namespace {

TEST(ChargerContacts, GiveCurrentToWhoStandsRight) {
  const ChargerContacts contacts{{7.0, 1.5, Angle::degrees(-90.0)}};
  const auto reach = [&](double x, double y, double heading) {
    return contacts.reach({x, y, Angle::degrees(heading)});
  };
  EXPECT_TRUE(reach(7.0, 1.5, -90.0));
  EXPECT_TRUE(reach(7.015, 1.46, -95.0)) << "the springs give way";
  EXPECT_FALSE(reach(7.025, 1.5, -90.0)) << "beside them";
  EXPECT_FALSE(reach(7.0, 1.52, -90.0)) << "short of them";
  EXPECT_FALSE(reach(7.0, 1.44, -90.0)) << "through them";
  EXPECT_FALSE(reach(7.0, 1.5, -75.0));
  EXPECT_FALSE(reach(7.0, 1.5, 90.0));
}

TEST(ChargerContacts, AreReadWhereTheFileHasThem) {
  const auto read = parse_contacts("contacts: {x: 7, y: 1.5, heading: -90, across: 0.03}", "s.yaml");
  ASSERT_TRUE(read && *read);
  EXPECT_NEAR((*read)->at.theta.degrees(), -90.0, 1e-9);
  EXPECT_DOUBLE_EQ((*read)->across, 0.03);
  EXPECT_FALSE(*parse_contacts("home: {x: 1, y: 2}", "s.yaml"));
  const auto wrong = parse_contacts("contacts: {x: 7, y: 1.5, heading: 0, across: 0}", "s.yaml");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().message, "s.yaml:1: across must be > 0");
}

}  // namespace
}  // namespace docent::simulator::charger_contacts_test
