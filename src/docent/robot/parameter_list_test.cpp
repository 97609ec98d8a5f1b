#include "docent/robot/parameter_list.h"

#include <gtest/gtest.h>

namespace docent::robot {
namespace {

struct Grip {
  double force = 0.1;
  std::vector<std::vector<double>> fingers{{1.0, 0.25}};
  template <class V>
  void visit(V& v) {
    v("force", force);
    v("fingers", fingers);
  }
};

struct Arms {
  int count = 2;
  bool folded = true;
  std::string name;
  std::optional<double> reach;
  Grip grip;
  std::vector<Scanner> sensors{{"front", "elbow", 0.5, 0.0, 90.0, 180.0}};
  template <class V>
  void visit(V& v) {
    v("count", count);
    v("folded", folded);
    v("name", name);
    v("reach", reach);
    v("grip", grip);
    v("sensors", sensors);
  }
};

ParameterRow row_of(const ParameterRows& rows, const std::string& key) {
  for (const auto& row : rows)
    if (row.key == key) return row;
  ADD_FAILURE() << "no key " << key;
  return {};
}

TEST(ParameterList, ListsEveryKeyInOrderWithItsValue) {
  const auto rows = list_parameters<Arms>(RobotConfig{}, "arms");
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  std::vector<std::string> keys;
  for (const auto& row : *rows) keys.push_back(row.key);
  const std::vector<std::string> expected{"arms", "count", "folded",  "name",   "reach",
                                          "grip", "force", "fingers", "sensors"};
  EXPECT_EQ(keys, expected);
  EXPECT_EQ(row_of(*rows, "count").value, "2");
  EXPECT_EQ(row_of(*rows, "folded").value, "true");
  EXPECT_EQ(row_of(*rows, "name").value, "\"\"");
  EXPECT_EQ(row_of(*rows, "reach").value, "~");
  EXPECT_EQ(row_of(*rows, "force").value, "0.1");
  EXPECT_EQ(row_of(*rows, "fingers").value, "[[1, 0.25]]");
  EXPECT_EQ(row_of(*rows, "sensors").value,
            "[{name: front, topic: \"\", frame: elbow, x: 0.5, y: 0, heading: 90, height: 0.38, field: 180, "
            "upside_down: false, "
            "max_range: 0, zero: auto, beams: 0, rate: 10, clockwise: false, no_return: greatest}]");
  EXPECT_EQ(row_of(*rows, "force").depth, 2);
  EXPECT_EQ(row_of(*rows, "force").declared_in, "Grip");
  EXPECT_EQ(row_of(*rows, "grip").holds, "Grip");
}

TEST(ParameterList, ShowsWhatIsSetAndRefusesWhatIsUnknown) {
  RobotConfig config;
  ASSERT_TRUE(config.set("arms.grip.force=0.3").has_value());
  const auto rows = list_parameters<Arms>(config, "arms");
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  EXPECT_EQ(row_of(*rows, "force").value, "0.3");
  ASSERT_TRUE(config.set("arms.grip.farce=1").has_value());
  EXPECT_FALSE(list_parameters<Arms>(config, "arms").has_value());
}

TEST(ParameterList, NumbersReadBackAsThemselves) {
  for (const double value : {1e-7, 1e9, 0.001, 1.0 / 3.0, -2.5}) {
    EXPECT_EQ(YAML::Load(in_one_line(to_yaml(value))).as<double>(), value);
  }
}

}  // namespace
}  // namespace docent::robot
