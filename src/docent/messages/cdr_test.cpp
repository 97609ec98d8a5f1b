#include "docent/messages/cdr.h"

#include <gtest/gtest.h>

#include "docent/base/random.h"
#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"

namespace docent {
namespace {

/// Fills any message with random content.
struct Filler {
  Rng rng;
  template <class T>
  void operator()(const char* /*name*/, T& field) {
    fill(field);
  }
  template <class T>
  void fill(T& field) {
    if constexpr (Message<T>) {
      T::visit(field, *this);
    } else if constexpr (std::is_same_v<T, bool>) {
      field = rng.chance(0.5);
    } else {
      field = static_cast<T>(rng.integer(0, 100));
    }
  }
  void fill(std::string& text) { text = std::string(static_cast<std::size_t>(rng.integer(0, 9)), 'a'); }
  template <class T>
  void fill(std::vector<T>& items) {
    items.resize(static_cast<std::size_t>(rng.integer(0, 4)));
    for (auto& item : items) fill(item);
  }
  template <class T, std::size_t N>
  void fill(std::array<T, N>& items) {
    for (auto& item : items) fill(item);
  }
};

template <class T>
void check_round_trip(Topic<T> topic) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Filler filler{Rng{seed}};
    T message;
    filler.fill(message);
    const auto bytes = encode_cdr(message);
    const auto back = decode_cdr<T>(bytes);
    ASSERT_TRUE(back.has_value()) << topic.name << " seed " << seed;
    EXPECT_EQ(encode_cdr(*back), bytes) << topic.name << " seed " << seed;
    for (std::size_t cut = 0; cut + 1 < bytes.size(); cut += 1 + bytes.size() / 16) {
      EXPECT_FALSE(decode_cdr<T>(std::span{bytes}.first(cut)).has_value()) << topic.name << " cut at " << cut;
    }
  }
}

TEST(Cdr, EveryMessageComesBackAsItWent) {
  for_each_robot_topic([](auto topic) { check_round_trip(topic); });
  for_each_truth_topic([](auto topic) { check_round_trip(topic); });
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
