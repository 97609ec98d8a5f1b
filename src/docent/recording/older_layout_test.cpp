#include "docent/recording/older_layout.h"

#include <gtest/gtest.h>

#include "docent/messages/docent_messages.h"
#include "docent/messages/random_message.h"

namespace docent::recording {
namespace {

/// A message of which more will be said.
struct Past {
  static constexpr const char* kType = "docent_msgs/msg/Past";
  struct Part {
    static constexpr const char* kType = "docent_msgs/msg/Part";
    std::string name;
    std::string gone;
    double value = 0.0;
    template <class Self, class V>
    static void visit(Self& m, V& v) {
      v("name", m.name);
      v("gone", m.gone);
      v("value", m.value);
    }
  };
  bool is_odd = false;
  std::string gone_too;
  Part part;
  std::vector<Part> parts;
  std::array<double, 3> place{};
  std::int32_t count = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("is_odd", m.is_odd);
    v("gone_too", m.gone_too);
    v("part", m.part);
    v("parts", m.parts);
    v("place", m.place);
    v("count", m.count);
  }
};

/// The same one, some years later.
struct Present {
  static constexpr const char* kType = "docent_msgs/msg/Past";
  struct Part {
    static constexpr const char* kType = "docent_msgs/msg/Part";
    std::vector<std::string> names;
    double value = 0.0;
    std::string name;
    std::uint8_t small = 0;
    template <class Self, class V>
    static void visit(Self& m, V& v) {
      v("names", m.names);
      v("value", m.value);
      v("name", m.name);
      v("small", m.small);
    }
  };
  bool is_odd = false;
  Part part;
  double between = 0.0;
  std::vector<Part> parts;
  std::array<double, 3> place{};
  float count = 2.5F;  ///< another type: not the same field
  double more = 7.5;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("is_odd", m.is_odd);
    v("part", m.part);
    v("between", m.between);
    v("parts", m.parts);
    v("place", m.place);
    v("count", m.count);
    v("more", m.more);
  }
};

template <Message T>
std::string schema() {
  return ros2msg_text(message_schemas<T>());
}

TEST(OlderLayout, FieldsAreFoundByTheirNames) {
  const auto layout = OlderLayout::between(schema<Past>(), schema<Present>());
  ASSERT_TRUE(layout);
  const Past past{true, "x", {"a", "lost", 1.5}, {{"bc", "", 2.5}, {"", "way", 3.5}}, {1, 2, 3}, 4};
  const auto bytes = layout->translated(encode_cdr(past));
  ASSERT_TRUE(bytes);
  const auto present = decode_cdr<Present>(*bytes);
  ASSERT_TRUE(present) << present.error().message;
  EXPECT_TRUE(present->is_odd);
  EXPECT_EQ(present->part.name, "a");
  EXPECT_EQ(present->part.value, 1.5);
  EXPECT_TRUE(present->part.names.empty());
  EXPECT_EQ(present->between, 0.0);
  ASSERT_EQ(present->parts.size(), 2U);
  EXPECT_EQ(present->parts[0].name, "bc");
  EXPECT_EQ(present->parts[1].value, 3.5);
  EXPECT_EQ(present->place, past.place);
  EXPECT_EQ(present->count, 2.5F) << "nothing of theirs stands behind it: the default";
  EXPECT_EQ(present->more, 7.5);
}

TEST(OlderLayout, CutBytesAreDamagedAndNothingElse) {
  const auto layout = OlderLayout::between(schema<Past>(), schema<Present>());
  const auto bytes = encode_cdr(Past{true, "x", {"a", "lost", 1.5}, {{"bc", "", 2.5}}, {1, 2, 3}, 4});
  for (std::size_t cut = 0; cut < bytes.size(); ++cut)
    EXPECT_FALSE(layout->translated(std::span{bytes}.first(cut))) << cut;
  for (std::size_t i = 4; i < bytes.size(); ++i) {
    auto spoilt = bytes;
    spoilt[i] = 0xff;
    (void)layout->translated(spoilt);  // ends, and reads nothing beyond its end
  }
}

TEST(OlderLayout, TheSameLayoutNeedsNone) {
  EXPECT_FALSE(OlderLayout::between(schema<Past>(), schema<Past>()));
  EXPECT_FALSE(OlderLayout::between("# as others write it\n" + schema<Past>(), schema<Past>()));
  EXPECT_FALSE(OlderLayout::between("", schema<Past>()));
  EXPECT_FALSE(OlderLayout::between("no schema at all", schema<Past>()));
  EXPECT_FALSE(OlderLayout::between("float64[x] y", schema<Past>()));
}

TEST(OlderLayout, ASchemaThatNamesItselfEnds) {
  const std::string endless = "docent_msgs/Round round\n===\nMSG: docent_msgs/Round\ndocent_msgs/Round round\n";
  const auto layout = OlderLayout::between(endless, schema<Past>());
  ASSERT_TRUE(layout);
  EXPECT_FALSE(layout->translated(std::vector<std::uint8_t>(100)));
  EXPECT_FALSE(
      OlderLayout::between("docent_msgs/Nowhere x\n", schema<Past>())->translated(std::vector<std::uint8_t>(9)));
}

// The mission's state as 0.2.0 began to record it: with a field for each of two languages, and a question in one.
TEST(OlderLayout, TheMissionsStateOfBeforeIsRead) {
  const std::string now = schema<docent_msgs::MissionState>();
  std::string before = now;
  const auto replace = [&](const std::string& a, const std::string& b) {
    const auto at = before.find(a);
    ASSERT_NE(at, std::string::npos) << a;
    before.replace(at, a.size(), b);
  };
  replace("string exhibit_id\n", "string exhibit_id\nstring text_en\nstring text_de\n");
  replace("string language\nstring[] languages\nstring[] texts\n", "string text\n");
  const auto back = OlderLayout::between(now, before);
  const auto forth = OlderLayout::between(before, now);
  ASSERT_TRUE(back && forth);
  auto state = random_message<docent_msgs::MissionState>(3);
  state.prompt = {"t1/more", "", {}, {}, {"more", "next"}, "next", {12, 5}};
  const auto old_bytes = back->translated(encode_cdr(state));
  ASSERT_TRUE(old_bytes);
  const auto bytes = forth->translated(*old_bytes);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(*bytes, encode_cdr(state));
}

}  // namespace
}  // namespace docent::recording
