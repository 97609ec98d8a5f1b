#include "docent/messages/definitions/message_comments.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

constexpr const char* kHeader = R"(#pragma once
// Not a doc comment.
namespace docent::docent_msgs {

/// A true touch, at its
/// begin.
struct Touch {
  static constexpr const char* kType = "docent_msgs/msg/Touch";
  std_msgs::Header header;
  double x = 0;  ///< [m], world
  double y = 0;
  /// Of all that moves.
  std::vector<float> speeds;
  std::array<double, 3> from{};  ///< where it came from: x, y [m],
                                 ///< theta [rad]
  bool braked_in_time =
      false;  ///< in time
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("x", m.x);
  }
};
struct Bare {
  double x = 0;
};
}  // namespace docent::docent_msgs
)";

TEST(MessageComments, AreTakenFromStructsAndFields) {
  MessageComments comments;
  add_message_comments(kHeader, comments);
  EXPECT_EQ(comments.at("Touch"), "A true touch, at its begin.");
  EXPECT_EQ(comments.at("Touch.header"), "");
  EXPECT_EQ(comments.at("Touch.x"), "[m], world");
  EXPECT_EQ(comments.at("Touch.y"), "");
  EXPECT_EQ(comments.at("Touch.speeds"), "Of all that moves.");
  EXPECT_EQ(comments.at("Touch.from"), "where it came from: x, y [m], theta [rad]");
  EXPECT_EQ(comments.at("Touch.braked_in_time"), "in time");
  EXPECT_EQ(comments.at("Bare"), "");
  EXPECT_EQ(comments.at("Bare.x"), "");
  EXPECT_EQ(comments.size(), 9U);
}

TEST(MessageComments, StandBehindTheFieldsOfTheirMessageOnly) {
  MessageComments comments;
  add_message_comments(kHeader, comments);
  EXPECT_EQ(commented_msg("float64 x\nfloat64 y\n", "Touch", comments),
            "# A true touch, at its begin.\n\nfloat64 x  # [m], world\nfloat64 y\n");
  EXPECT_EQ(commented_msg("float64 x\n", "Bare", comments), "float64 x\n");
}

}  // namespace
}  // namespace docent
