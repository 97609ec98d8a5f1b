#include "docent/messages/schema.h"

#include <gtest/gtest.h>

#include <set>

#include "docent/messages/topics.h"

namespace docent {
namespace {

TEST(Schema, RosTextNamesNestedTypesInBlocks) {
  const std::string line(80, '=');
  EXPECT_EQ(ros2msg_text(message_schemas<std_msgs::Header>()),
            "builtin_interfaces/Time stamp\nstring frame_id\n" + line +
                "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
  const std::string pose = ros2msg_text(message_schemas<geometry_msgs::PoseWithCovariance>());
  EXPECT_TRUE(pose.starts_with("geometry_msgs/Pose pose\nfloat64[36] covariance\n")) << pose;
  EXPECT_NE(pose.find("MSG: geometry_msgs/Quaternion\n"), std::string::npos);
  EXPECT_NE(ros2msg_text(message_schemas<nav_msgs::Path>()).find("geometry_msgs/PoseStamped[] poses\n"),
            std::string::npos);
}

TEST(Schema, IdlEscapesKeywordsAndNamesArrays) {
  const std::string health = idl_text(message_schemas<docent_msgs::Health>());
  EXPECT_NE(health.find("string _module;"), std::string::npos) << health;
  const std::string odometry = idl_text(message_schemas<nav_msgs::Odometry>());
  EXPECT_NE(odometry.find("typedef double PoseWithCovariance__covariance[36];"), std::string::npos) << odometry;
  EXPECT_EQ(dds_type_name("nav_msgs/msg/Odometry"), "nav_msgs::msg::dds_::Odometry_");
  EXPECT_EQ(dds_type_name("std_msgs/Header"), "std_msgs::msg::dds_::Header_");
  EXPECT_EQ(dds_type_name("irobot_create_msgs/action/Dock_SendGoal_Request"),
            "irobot_create_msgs::action::dds_::Dock_SendGoal_Request_");
}

template <class T>
void expect_complete() {
  std::set<std::string> known;
  const auto schemas = message_schemas<T>();
  EXPECT_EQ(schemas.back().type, T::kType);
  for (const auto& schema : schemas) {
    EXPECT_FALSE(schema.fields.empty()) << schema.type;
    for (const auto& field : schema.fields) {
      EXPECT_TRUE(!field.is_message || known.contains(field.type)) << schema.type << "." << field.name;
    }
    EXPECT_TRUE(known.insert(schema.type).second) << schema.type << " twice";
  }
}

TEST(Schema, WhatIsNestedComesFirstAndOnce) {
  for_each_robot_topic([]<class T>(Topic<T>) { expect_complete<T>(); });
  for_each_truth_topic([]<class T>(Topic<T>) { expect_complete<T>(); });
}

}  // namespace
}  // namespace docent
