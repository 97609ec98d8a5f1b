#include "docent/interaction/kiosk/button_stream.h"

#include <gtest/gtest.h>
#include <linux/input.h>

#include <cstring>

#include "docent/base/random.h"

namespace docent::interaction {
namespace {

constexpr ButtonCodes kCodes{{KEY_1, KEY_2, KEY_3, KEY_4}, KEY_ESC};
const Duration kDebounce = seconds(0.05);

std::string event(int type, int code, int value) {
  input_event one{};
  one.type = static_cast<std::uint16_t>(type);
  one.code = static_cast<std::uint16_t>(code);
  one.value = value;
  std::string bytes(sizeof one, '\0');
  std::memcpy(bytes.data(), &one, sizeof one);
  return bytes;
}
/// As a keyboard says it: scan code, key, report.
std::string key(int code, int value) {
  return event(EV_MSC, MSC_SCAN, 458782) + event(EV_KEY, code, value) + event(EV_SYN, SYN_REPORT, 0);
}

TEST(ButtonStream, APressIsAPressAndAReleaseIsNone) {
  ButtonStream stream{kCodes, kDebounce};
  EXPECT_EQ(stream.take(key(KEY_3, 1), time_from_seconds(1)), std::vector<int>{3});
  EXPECT_EQ(stream.take(key(KEY_3, 0), time_from_seconds(1.2)), std::vector<int>{});
  EXPECT_EQ(stream.take(key(KEY_1, 1) + key(KEY_4, 1), time_from_seconds(2)), (std::vector<int>{1, 4}));
}

TEST(ButtonStream, TheStopKeyIsNoButton) {
  ButtonStream stream{kCodes, kDebounce};
  EXPECT_EQ(stream.take(key(KEY_ESC, 1) + key(KEY_2, 1), time_from_seconds(1)), (std::vector<int>{kStopKey, 2}));
  ButtonStream without{{kCodes.buttons, {}}, kDebounce};
  EXPECT_TRUE(without.take(key(KEY_ESC, 1), time_from_seconds(1)).empty());
}

TEST(ButtonStream, AHeldButtonIsOnePress) {
  ButtonStream stream{kCodes, kDebounce};
  EXPECT_EQ(stream.take(key(KEY_2, 1), time_from_seconds(1)), std::vector<int>{2});
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(stream.take(key(KEY_2, 2), time_from_seconds(1.3 + 0.03 * i)).empty());
}

TEST(ButtonStream, AContactThatBouncesIsOnePress) {
  ButtonStream stream{kCodes, kDebounce};
  int presses = 0;
  for (const double begin : {1.0, 1.3}) {  // closes, is held for 0.1 s, opens
    for (const auto& [after, value] : std::vector<std::pair<double, int>>{
             {0.0, 1}, {0.004, 0}, {0.006, 1}, {0.01, 0}, {0.013, 1}, {0.1, 0}, {0.103, 1}, {0.106, 0}}) {
      presses += static_cast<int>(stream.take(key(KEY_1, value), time_from_seconds(begin + after)).size());
    }
  }
  EXPECT_EQ(presses, 2);
  // The others are not held up.
  EXPECT_EQ(stream.take(key(KEY_2, 1), time_from_seconds(1.41)), std::vector<int>{2});
}

TEST(ButtonStream, OtherEventsAreNone) {
  ButtonStream stream{kCodes, kDebounce};
  EXPECT_TRUE(stream.take(key(KEY_5, 1), time_from_seconds(1)).empty());
  EXPECT_TRUE(stream.take(event(EV_REL, KEY_1, 1), time_from_seconds(1)).empty());
  EXPECT_TRUE(stream.take(event(EV_SYN, SYN_DROPPED, 0), time_from_seconds(1)).empty());
  EXPECT_TRUE(stream.take(event(EV_KEY, KEY_1, -1), time_from_seconds(1)).empty());
  EXPECT_TRUE(stream.take(event(EV_KEY, KEY_1, 1 << 20), time_from_seconds(1)).empty());
  EXPECT_EQ(stream.take(key(KEY_1, 1), time_from_seconds(1)), std::vector<int>{1});
}

TEST(ButtonStream, EventsMayComeInPieces) {
  const std::string bytes = key(KEY_1, 1) + key(KEY_1, 0) + key(KEY_4, 1) + key(KEY_2, 1);
  for (std::size_t size = 1; size < bytes.size(); ++size) {
    ButtonStream stream{kCodes, kDebounce};
    std::vector<int> pressed;
    for (std::size_t at = 0; at < bytes.size(); at += size)
      for (const int number : stream.take(std::string_view{bytes}.substr(at, size), time_from_seconds(1)))
        pressed.push_back(number);
    EXPECT_EQ(pressed, (std::vector<int>{1, 4, 2})) << "in pieces of " << size;
  }
}

TEST(ButtonStream, AnEventThatWasCutOffSpoilsNothingAfterAReset) {
  ButtonStream stream{kCodes, kDebounce};
  EXPECT_TRUE(stream.take(key(KEY_1, 1).substr(0, 31), time_from_seconds(1)).empty());
  stream.reset();
  EXPECT_EQ(stream.take(key(KEY_2, 1), time_from_seconds(1)), std::vector<int>{2});
}

TEST(ButtonStream, NonsenseNamesNoOtherButtons) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Rng rng{seed};
    ButtonStream stream{kCodes, kDebounce};
    std::string bytes;
    for (int i = 0; i < 5000; ++i) bytes += static_cast<char>(rng.integer(0, 255));
    for (const int number : stream.take(bytes, time_from_seconds(1))) {
      EXPECT_GE(number, 1);
      EXPECT_LE(number, 4);
    }
  }
}

}  // namespace
}  // namespace docent::interaction
