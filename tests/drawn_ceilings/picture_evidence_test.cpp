// What pictures of a drawn ceiling say of 72,000 poses (0.2 m, 6 degrees) from an even belief: where the ceiling is
// unique, where it repeats itself every 2 m, where the lamps are off that were lit for the mosaic, and where the mosaic
// is of another hall. 40 halls of each with $DOCENT_WHOLE_HALLS, else 3.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "docent/vision/ceiling/evidence/ceiling_evidence.h"
#include "docent/vision/ceiling/testing.h"

namespace docent::vision {
namespace {

using ceiling_testing::Hall;

constexpr int kPictures = 4;   // along a metre
constexpr double kSure = 0.9;  // of the mass within 0.5 m and 20 degrees of the likeliest pose

CeilingMosaic mosaic_of(const Hall& hall) {
  CeilingMosaic mosaic{{500, 400, 0.02, {0.0, 0.0}}, {hall.low, hall.high}, {}, {}};
  for (int row = 0; row < 400; ++row)
    for (int column = 0; column < 500; ++column) {
      const Point2 at = mosaic.frame.centre({column, row});
      mosaic.part.push_back(hall.is_high(at) ? 1 : 0);
      mosaic.brightness.push_back(static_cast<float>(hall.brightness(at)));
    }
  return mosaic;
}

bool is_near(const Pose2& a, const Pose2& b, double metres, double degrees) {
  return distance(a.position(), b.position()) < metres && std::abs((a.theta - b.theta).degrees()) < degrees;
}

TEST(PicturesOfDrawnCeilings, AreNotSureAndWrong) {
  std::vector<Pose2> poses;
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 40; ++column)
      for (int turn = 0; turn < 60; ++turn)
        poses.push_back({1.05 + 0.2 * column, 1.05 + 0.2 * row, Angle::degrees(6.0 * turn)});
  const unsigned halls = std::getenv("DOCENT_WHOLE_HALLS") != nullptr ? 40 : 3;
  const CeilingCamera eye = ceiling_testing::camera();
  for (const std::string kind : {"unique", "periodic", "lamps-off", "other-hall"}) {
    Rng rng{77};
    unsigned right = 0, sure = 0, wrong = 0;
    for (std::uint64_t seed = 200; seed < 200 + halls; ++seed) {
      Hall hall{.seed = seed};
      if (kind == "periodic") hall.period = 2.0, hall.size = {0.0, 0.0};
      CeilingEvidence evidence{mosaic_of(hall), eye};
      if (kind == "lamps-off") hall.lamps_are_lit = false;
      if (kind == "other-hall") hall.seed += 5000;
      const Pose2 truth{rng.uniform(2.5, 7.5), rng.uniform(2.2, 5.8), Angle::degrees(rng.uniform(-180.0, 180.0))};
      std::vector<float> nats(poses.size());
      const double gain = rng.uniform(0.5, 1.2);
      for (int i = 0; i < kPictures; ++i) {
        const Pose2 moved{0.35 * i, 0.05 * i, Angle::degrees(20.0 * i)};
        const Time time = time_from_seconds(1.0 + i);
        const auto picture = hall.picture(
            eye, truth * moved, {.gain = gain, .offset = 0.02, .noise = 0.02, .lean = rng.normal(0.0, 0.005)}, rng);
        evidence.see(picture.view(), time, moved);
        if (!evidence.observe({time, moved, {}})) continue;
        std::vector<Pose2> now;
        for (const Pose2& pose : poses) now.push_back(pose * moved);
        evidence.add_costs(now, nats);
      }
      std::size_t best = 0;
      double all = 0.0, near = 0.0;
      for (std::size_t i = 0; i < nats.size(); ++i)
        if (nats[i] < nats[best]) best = i;
      for (std::size_t i = 0; i < nats.size(); ++i) {
        const double mass = std::exp(static_cast<double>(nats[best] - nats[i]));
        all += mass;
        if (is_near(poses[i], poses[best], 0.5, 20.0)) near += mass;
      }
      const bool is_right = is_near(poses[best], truth, 0.3, 10.0);
      right += is_right ? 1U : 0U;
      if (near < kSure * all) continue;
      ++sure;
      wrong += is_right ? 0U : 1U;
    }
    std::printf("pictures %s: %u halls, likeliest pose right %u, sure %u, of these wrong %u\n", kind.c_str(), halls,
                right, sure, wrong);
    EXPECT_EQ(wrong, 0U) << kind;
    if (kind == "unique") {
      EXPECT_GE(right + halls / 20U, halls);
    }
  }
}

}  // namespace
}  // namespace docent::vision
