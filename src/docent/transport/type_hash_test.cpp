#include "docent/transport/type_hash.h"

#include <gtest/gtest.h>

#include "docent/messages/topics.h"
#include "docent/transport/bus.h"

namespace docent::transport {
namespace {

// What ROS 2 Jazzy prints (`ros2 topic info --verbose`, and its generated description sources).
TEST(TypeHash, IsThatOfRos2) {
  const std::pair<const char*, const char*> kKnown[] = {
      {"geometry_msgs/msg/Twist", "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"},
      {"geometry_msgs/msg/TwistStamped", "5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64"},
      {"geometry_msgs/msg/PoseStamped", "10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8"},
      {"geometry_msgs/msg/PoseWithCovarianceStamped",
       "26432f9803e43727d3c8f668d1fdb3c630f548af631e2f4e31382371bfea3b6e"},
      {"sensor_msgs/msg/CameraInfo", "b3dfd68ff46c9d56c80fd3bd4ed22c7a4ddce8c8348f2f59c299e73118e7e275"},
      {"sensor_msgs/msg/CompressedImage", "15640771531571185e2efc8a100baf923961a4d15d5569652e6cb6691e8e371a"},
      {"nav_msgs/msg/OccupancyGrid", "8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7"},
      {"visualization_msgs/msg/MarkerArray", "86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf"},
      {"sensor_msgs/msg/LaserScan", "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828"},
      {"sensor_msgs/msg/Range", "9430b1915b94d4268ff903679e8ecd09b6a67d331bd028738ec1eeb592891ebd"},
      {"sensor_msgs/msg/BatteryState", "4bee5dfce981c98faa6828b868307a0a73f992ed0789f374ee96c8f840e69741"},
      {"sensor_msgs/msg/Image", "d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47"},
      {"sensor_msgs/msg/JointState", "a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e"},
      {"nav_msgs/msg/Odometry", "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0"},
      {"nav_msgs/msg/Path", "1957a5bb3cee5da65c4e52e52b65a93df227efce4c20f8458b36e73066ca334b"},
      {"tf2_msgs/msg/TFMessage", "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"},
      {"diagnostic_msgs/msg/DiagnosticArray", "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e"},
      {"rmw_dds_common/msg/ParticipantEntitiesInfo",
       "91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e"},
  };
  for (const auto& [type, digits] : kKnown) EXPECT_EQ(type_hash_of(type), std::string{"RIHS01_"} + digits) << type;
}

TEST(TypeHash, OfOneThatNestsNothing) {
  const MessageSchemas text{{"std_msgs/msg/String", {{"data", "string", false, FieldSchema::Shape::single, 0}}}};
  EXPECT_EQ(type_hash(text), "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
  EXPECT_EQ(type_hash(message_schemas<builtin_interfaces::Time>()),
            "RIHS01_b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197");
  EXPECT_EQ(type_hash(message_schemas<std_msgs::Header>()),
            "RIHS01_f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01");
}

TEST(TypeHash, EveryTopicHasOneForItsUserData) {
  const auto expect_hash = [](const auto& topic) {
    const std::string data = endpoint_user_data(topic_info(topic).type->name);
    EXPECT_EQ(data.size(), std::string{"typehash=RIHS01_;"}.size() + 64) << topic.name;
    EXPECT_TRUE(data.starts_with("typehash=RIHS01_") && data.ends_with(";")) << data;
  };
  for_each_robot_topic(expect_hash);
  for_each_truth_topic(expect_hash);
  EXPECT_EQ(endpoint_user_data("geometry_msgs/msg/TwistStamped").size(), 81U);
  EXPECT_EQ(endpoint_user_data("no_msgs/msg/Such"), "");
}

}  // namespace
}  // namespace docent::transport
