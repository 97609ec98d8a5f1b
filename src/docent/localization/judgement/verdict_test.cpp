#include "docent/localization/judgement/verdict.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace docent::localization {
namespace {

Evidence good() {
  Evidence evidence;
  evidence.mass = 0.998;
  evidence.spread = 0.1;
  evidence.is_same_mode = true;
  evidence.way = 0.25;
  evidence.readings.agrees = 50.0;
  evidence.readings.shorter = 5.0;
  return evidence;
}

Verdict sure() {
  Verdict verdict{{}};
  for (int i = 0; i < 20; ++i) {
    verdict.add(good());
    verdict.look({0.0, 0.1, 0.0, 40});
  }
  return verdict;
}

TEST(Verdict, SaysThatItDoesNotKnowUntilItDoes) {
  Verdict verdict{{}};
  EXPECT_FALSE(verdict.localized());
  EXPECT_EQ(verdict.p_lost(), 1.0);
  verdict.add(good());
  EXPECT_FALSE(verdict.localized());
  EXPECT_TRUE(sure().localized());
}

TEST(Verdict, WhoWasCarriedOffKnowsNothingUntilConfirmedAnew) {
  Verdict verdict = sure();
  verdict.uproot();
  EXPECT_FALSE(verdict.localized());
  EXPECT_FALSE(verdict.keeps_its_place());
  verdict.add(good());
  EXPECT_FALSE(verdict.localized()) << "one update is not enough";
  for (int i = 0; i < 20; ++i) verdict.add(good());
  EXPECT_TRUE(verdict.localized());
}

TEST(Verdict, AScanAfterALongWayConfirmsForSeveral) {
  Evidence sparse = good();
  sparse.way = 2.0;
  sparse.views = 4.0;
  Verdict verdict{{}};
  verdict.add(sparse);
  EXPECT_FALSE(verdict.localized());
  verdict.add(sparse);
  EXPECT_TRUE(verdict.localized());
}

TEST(Verdict, DoubtFallsWithConfirmationAndIsSmallWhenSure) {
  Verdict verdict{{}};
  verdict.add(good());
  const double young = verdict.p_lost();
  EXPECT_GT(young, sure().p_lost());
  EXPECT_LT(sure().p_lost(), 0.01);
}

TEST(Verdict, HereIsPLostBelowOneBoundWithHysteresis) {
  const VerdictParams params;
  Verdict verdict = sure();
  int taken_back = 0, said_again = 0;
  for (int step = 0; step < 200; ++step) {
    Evidence twin = good();
    twin.share = 0.77 + 0.23 * std::cos(step * 2.0 * std::numbers::pi / 100.0);  // two rounds down and up again
    const bool was_here = verdict.localized();
    verdict.add(twin);
    verdict.look({0.0, 0.1, 0.0, 40});
    taken_back += was_here && !verdict.localized() ? 1 : 0;
    said_again += !was_here && verdict.localized() ? 1 : 0;
    if (verdict.localized()) {
      EXPECT_LE(verdict.p_lost(), params.no_longer_here);
    } else {
      EXPECT_GE(verdict.p_lost(), params.here);
    }
  }
  EXPECT_EQ(taken_back, 2);
  EXPECT_EQ(said_again, 2);
}

TEST(Verdict, WhoHasNotSaidHereIsNeverSureOfIt) {
  Verdict verdict{{}};
  for (int i = 0; i < 20 && !verdict.localized(); ++i) {
    EXPECT_GE(verdict.p_lost(), VerdictParams{}.here);
    verdict.add(good());
  }
  EXPECT_LT(verdict.p_lost(), 0.01);
}

TEST(Verdict, AToldPlaceThatTheFirstLookDoesNotBearOutIsMoreLikelyWrongThanRight) {
  Verdict verdict{{}};
  verdict.assume_localized();
  Evidence other = good();
  other.share = 0.9;  // another place looks like it
  verdict.add(other);
  EXPECT_FALSE(verdict.localized());
  EXPECT_GE(verdict.p_lost(), 0.5);
}

TEST(Verdict, AWallMoreOrLessWithinReachIsNobodyWhoHasCome) {
  Verdict verdict = sure();
  for (int i = 0; i < 40; ++i) {
    verdict.look({0.0, 0.0, 0.0, 9});  // too few to tell
    verdict.look({0.0, 0.8, 0.0, 10});
  }
  EXPECT_LT(verdict.hidden(), 0.1);
  EXPECT_TRUE(verdict.localized());
}

TEST(Verdict, ATwinPlaceIsDoubtHoweverWellTheReadingsFit) {
  Verdict verdict = sure();
  Evidence twin = good();
  twin.mass = 0.7;
  twin.share = 0.7;
  verdict.add(twin);
  EXPECT_GE(verdict.p_lost(), 0.15);
}

TEST(Verdict, OneSweepThroughWallsRaisesTheDoubtAtOnce) {
  Verdict verdict = sure();
  const double before = verdict.p_lost();
  verdict.look({0.7, 0.1, 0.0, 40});
  EXPECT_GT(verdict.p_lost(), 20.0 * before);
  EXPECT_GT(verdict.p_lost(), 0.02);  // no longer sure
  verdict.look({0.0, 0.1, 0.0, 40});
  EXPECT_LT(verdict.p_lost(), 2.0 * before);
}

TEST(Verdict, WallsThatTheMapLacksTakeTheKnowledgeBackThoughNothingElseSpeaksAgainstThePlace) {
  Verdict verdict = sure();
  Evidence hidden = good();
  hidden.readings = {0.0, 60.0, 0.0};
  int sweeps = 0;
  for (; verdict.localized() && sweeps < 100; ++sweeps) {
    if (sweeps % 4 == 0) verdict.add(hidden);
    verdict.look({0.0, 0.9, 0.8, 40});
  }
  EXPECT_LT(sweeps, 40);
  EXPECT_GT(verdict.p_lost(), 0.5);
}

TEST(Verdict, AGivenPlaceIsKeptWhileTheRobotStands) {
  Verdict verdict{{}};
  verdict.assume_localized();
  for (int sweep = 0; sweep < 40; ++sweep) verdict.look({0.0, 0.1, 0.0, 40});
  verdict.add(good());
  EXPECT_TRUE(verdict.localized());
}

TEST(Verdict, SomebodyWhoStepsBeforeTheRobotForAMomentIsNoReasonForDoubt) {
  Verdict verdict = sure();
  for (int i = 0; i < 7; ++i) verdict.look({1.0, 0.9, 1.0, 40});
  EXPECT_TRUE(verdict.localized());
  verdict.look({0.0, 0.1, 0.0, 40});
  for (int i = 0; i < 8; ++i) verdict.look({1.0, 0.9, 1.0, 40});
  EXPECT_FALSE(verdict.localized());
  EXPECT_FALSE(verdict.keeps_its_place());
}

TEST(Verdict, BlindItStopsSayingHereKeepsItsPlaceAndGivesItUpAtLast) {
  Verdict verdict = sure();
  Evidence hidden = good();
  hidden.readings = {0.0, 60.0, 0.0};
  double way = 0.0;
  const auto drive_on_while = [&](auto holds) {
    for (; holds() && way < 200.0; way += hidden.way) verdict.add(hidden);
  };
  drive_on_while([&] { return verdict.localized(); });
  EXPECT_NEAR(way, VerdictParams{}.blind_way, 6.0);
  EXPECT_TRUE(verdict.keeps_its_place());
  drive_on_while([&] { return verdict.keeps_its_place(); });
  EXPECT_NEAR(way, 3.0 * VerdictParams{}.blind_way, 6.0);
  EXPECT_TRUE(verdict.contradicted());
}

TEST(Verdict, AnotherModeIsAnotherPlace) {
  Verdict verdict = sure();
  Evidence elsewhere = good();
  elsewhere.is_same_mode = false;
  verdict.add(elsewhere);
  EXPECT_FALSE(verdict.localized());
  EXPECT_FALSE(verdict.keeps_its_place());
}

TEST(Verdict, HardlyAnyMassIsNeverSure) {
  Verdict verdict{{}};
  Evidence scattered = good();
  scattered.mass = 1e-5;
  scattered.spread = 0.05;
  scattered.is_same_mode = false;
  verdict.add(scattered);
  verdict.look({0.0, 0.0, 0.0, 40});
  EXPECT_GT(verdict.p_lost(), 0.01);
}

TEST(Verdict, MoreAgainstThePlaceIsNeverLessDoubt) {
  for (const bool has_said : {false, true}) {
    double before = 0.0;
    for (double through = 0.0; through <= 1.0; through += 0.1) {
      Verdict verdict = has_said ? sure() : Verdict{{}};
      verdict.add(good());
      verdict.look({through, 0.1 + 0.5 * through, through, 40});
      EXPECT_GE(verdict.p_lost(), before);
      before = verdict.p_lost();
    }
  }
}

TEST(Verdict, ACrowdThatHidesEverythingIsNoReasonToGiveAPlaceUpButNobodyIsSureThere) {
  Verdict verdict = sure();
  Evidence hidden = good();
  hidden.readings = {0.0, 60.0, 0.0};
  for (int sweep = 0; sweep < 100; ++sweep) {
    hidden.way = sweep < 60 ? 0.1 : 0.0;
    if (sweep % 4 == 0) verdict.add(hidden);
    verdict.look({0.0, 0.9, 0.0, 40});
  }
  EXPECT_TRUE(verdict.localized());
  EXPECT_LT(verdict.p_lost(), 0.5);
  EXPECT_GT(verdict.p_lost(), 0.01);
}

TEST(Verdict, WhereItStandsWalledInByPeopleItStopsBeingSureWithinSecondsAndIsSureAgainBehindThem) {
  Verdict verdict = sure();
  Evidence standing = good();
  standing.way = 0.0;
  standing.weight = 0.01;  // it has seen this view before
  standing.readings = {0.0, 60.0, 0.0};
  const auto glances = [&](double shorter) {
    for (int sweep = 0; sweep < 40; ++sweep) {
      if (sweep % 4 == 0) verdict.add(standing);
      verdict.look({0.0, shorter, 0.0, 40});
    }
    return verdict.p_lost();
  };
  EXPECT_GT(glances(0.95), 0.03);
  EXPECT_TRUE(verdict.localized()) << "nothing speaks against the place";
  EXPECT_LT(glances(0.3), 0.01);
}

TEST(Verdict, ReadingsThroughWallsTakeTheKnowledgeBack) {
  Verdict verdict = sure();
  Evidence bad = good();
  bad.readings.agrees = 10.0;
  bad.readings.longer = 40.0;
  int updates = 0;
  while (verdict.localized() && updates < 50) verdict.add(bad), ++updates;
  EXPECT_LE(updates, 6);
  EXPECT_TRUE(verdict.contradicted());
}

TEST(Verdict, GivesUpByScansWhereTheyAreFarApart) {
  Verdict verdict = sure();
  Evidence bad = good();
  bad.readings.agrees = 5.0;
  bad.readings.longer = 45.0;
  bad.way = 3.0;
  int contradicting = 0;
  while (!verdict.collapsed() && contradicting < 50) {
    verdict.add(bad);
    contradicting += verdict.contradicted() ? 1 : 0;
  }
  EXPECT_GE(contradicting, 5);  // 15 m, and not the 6 m that a scan every quarter of a metre takes
  EXPECT_LE(contradicting, 10);
}

TEST(Verdict, PeopleAllRoundDoNot) {
  Verdict verdict = sure();
  Evidence crowd = good();
  crowd.readings.agrees = 12.0;
  crowd.readings.shorter = 43.0;
  for (int i = 0; i < 40; ++i) verdict.add(crowd);
  EXPECT_TRUE(verdict.localized());
}

TEST(Verdict, AFoundPlaceOfWhichItDoubtsIsKeptForHindsight) {
  VerdictParams params;
  params.here = 1e-6;  // it is never so sure
  Verdict verdict{params};
  bool was_found = false;
  for (int i = 0; i < 30; ++i) {
    verdict.add(good());
    EXPECT_FALSE(verdict.localized());
    was_found = was_found || verdict.has_found();
  }
  EXPECT_TRUE(was_found);
  Evidence other = good();
  other.is_same_mode = false;
  verdict.add(other);
  EXPECT_FALSE(verdict.has_found());
}

}  // namespace
}  // namespace docent::localization
