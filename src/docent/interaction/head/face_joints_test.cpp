#include "docent/interaction/head/face_joints.h"

#include <gtest/gtest.h>

namespace docent::interaction {
namespace {

HeadShown shown(Mood mood, double valence) {
  HeadShown shown;
  shown.mood = mood;
  shown.valence = valence;
  return shown;
}

TEST(FaceJoints, BrowsAndMouthShowTheMood) {
  const FaceParams params;
  const FaceJoints happy = face_joints(shown(Mood::happy, 1.0), Time{}, params);
  EXPECT_EQ(happy.left_brow, 0.0);
  EXPECT_EQ(happy.mouth, params.mouth_bend);
  const FaceJoints angry = face_joints(shown(Mood::angry, -1.0), Time{}, params);
  EXPECT_EQ(angry.left_brow, params.angry_brow);
  EXPECT_EQ(angry.right_brow, params.angry_brow);
  EXPECT_EQ(angry.mouth, -params.mouth_bend);
  const FaceJoints sad = face_joints(shown(Mood::sad, -0.4), Time{}, params);
  EXPECT_EQ(sad.left_brow, -params.sad_brow);
  EXPECT_LT(sad.mouth, 0.0);
  const FaceJoints neutral = face_joints(shown(Mood::neutral, 0.0), Time{}, params);
  EXPECT_EQ(neutral.left_brow, 0.0);
  EXPECT_EQ(neutral.mouth, 0.0);
}

TEST(FaceJoints, TheMouthMovesWhileItSpeaksAndOnlyThen) {
  const FaceParams params;
  HeadShown face = shown(Mood::neutral, 0.0);
  double most = 0.0, least = 1.0;
  for (int i = 0; i < 20; ++i) {
    const Time now = time_from_seconds(100.0 + 0.1 * i);
    face.is_speaking = false;
    EXPECT_EQ(face_joints(face, now, params).jaw, 0.0);
    face.is_speaking = true;
    const double jaw = face_joints(face, now, params).jaw;
    EXPECT_GE(jaw, 0.0);
    EXPECT_LE(jaw, params.mouth_opening);
    most = std::max(most, jaw);
    least = std::min(least, jaw);
  }
  EXPECT_GT(most, 0.8 * params.mouth_opening);
  EXPECT_LT(least, 0.2 * params.mouth_opening);
}

TEST(FaceParams, RefuseWhatNoFaceDoes) {
  EXPECT_TRUE(FaceParams{}.validate().has_value());
  EXPECT_FALSE((FaceParams{.angry_brow = -0.1}).validate().has_value());
  EXPECT_FALSE((FaceParams{.mouth_opening = 3.0}).validate().has_value());
  EXPECT_FALSE((FaceParams{.openings_a_second = 0.0}).validate().has_value());
}

}  // namespace
}  // namespace docent::interaction
