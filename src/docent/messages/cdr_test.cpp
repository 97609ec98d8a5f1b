#include "docent/messages/cdr.h"

#include <gtest/gtest.h>

#include "docent/messages/conversions.h"
#include "docent/messages/random_message.h"
#include "docent/messages/topics.h"

namespace docent {
namespace {

template <class T>
void check_round_trip(Topic<T> topic) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const T message = random_message<T>(seed);
    const auto bytes = encode_cdr(message);
    const auto back = decode_cdr<T>(bytes);
    ASSERT_TRUE(back.has_value()) << topic.name << " seed " << seed;
    EXPECT_EQ(encode_cdr(*back), bytes) << topic.name << " seed " << seed;
    for (std::size_t cut = 0; cut + 1 < bytes.size(); cut += 1 + bytes.size() / 16) {
      const auto older = decode_cdr<T>(std::span{bytes}.first(cut));
      if (!older) continue;
      // What an older Docent wrote, and nothing else: the rest is as it is without a message.
      EXPECT_TRUE(std::string_view{T::kType}.starts_with("docent_msgs/")) << topic.name << " cut at " << cut;
      const auto grown = encode_cdr(*older);
      EXPECT_TRUE(std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(cut), grown.begin()))
          << topic.name << " cut at " << cut;
    }
  }
}

TEST(Cdr, EveryMessageComesBackAsItWent) {
  for_each_robot_topic([](auto topic) { check_round_trip(topic); });
  for_each_truth_topic([](auto topic) { check_round_trip(topic); });
}

TEST(Cdr, ReadsWhatAnOlderDocentWrote) {
  docent_msgs::TrueState state = random_message<docent_msgs::TrueState>(3);
  state.nearest_solid_m = 0.0;
  auto bytes = encode_cdr(state);
  // Without its last field, and without the padding before that.
  std::size_t end = bytes.size() - sizeof(double);
  while (!decode_cdr<docent_msgs::TrueState>(std::span{bytes}.first(end)) && end > bytes.size() - 16) --end;
  const auto older = decode_cdr<docent_msgs::TrueState>(std::span{bytes}.first(end));
  ASSERT_TRUE(older.has_value());
  EXPECT_EQ(encode_cdr(*older), bytes);
  EXPECT_FALSE(decode_cdr<docent_msgs::TrueState>(std::span{bytes}.first(4)).has_value()) << "nothing at all";
}

TEST(Cdr, AlignsAsTheStandardSays) {
  std_msgs::Header header{{1, 2}, "ab"};
  const std::vector<std::uint8_t> wanted{0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 'a', 'b', 0};
  EXPECT_EQ(encode_cdr(header), wanted);
  geometry_msgs::PoseStamped stamped{header, {}};
  EXPECT_EQ(encode_cdr(stamped).size(), 4U + 16U + 7U * 8U) << "doubles begin at a multiple of 8 behind the header";
}

TEST(Conversions, PosesAndTimesComeBack) {
  const Pose2 pose{1.5, -2.0, Angle::degrees(170)};
  const Pose2 back = from_message(to_message(pose));
  EXPECT_NEAR(back.x, pose.x, 1e-12);
  EXPECT_NEAR(back.theta.degrees(), 170.0, 1e-9);
  EXPECT_EQ(from_message(to_message(Time{1234567890123456789})).nanoseconds, 1234567890123456789);
  EXPECT_EQ(from_message(to_message(Time{-5})).nanoseconds, -5);
}

}  // namespace
}  // namespace docent
