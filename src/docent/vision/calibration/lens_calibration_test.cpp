#include "docent/vision/calibration/lens_calibration.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "docent/vision/calibration/board_pictures_for_test.h"

namespace docent::vision {
namespace {

using board_pictures::Held;
using board_pictures::TrueLens;

const Board kBoard{9, 6, 0.025};

TrueLens wide_lens() {
  TrueLens lens;
  lens.is_fisheye = true;
  lens.focal_x = 265.0, lens.focal_y = 265.6, lens.centre_x = 322.0, lens.centre_y = 243.0;
  lens.bend = {-0.03, 0.006, -0.002, 0.0002};
  return lens;
}

std::vector<BoardView> views_of(const TrueLens& lens, const std::vector<Held>& boards, std::uint64_t seed) {
  Rng rng{seed};
  std::vector<BoardView> views;
  for (std::size_t i = 0; i < boards.size(); ++i) {
    const auto grey = board_pictures::picture_of(lens, kBoard, boards[i], 3.0, rng);
    auto corners = find_board(grey, lens.columns, lens.rows, kBoard);
    if (corners) views.push_back({std::to_string(i), std::move(*corners)});
  }
  return views;
}

/// As if corners were found where they are, but for some noise.
std::vector<BoardView> exact_views(const TrueLens& lens, const std::vector<Held>& boards, Rng& rng) {
  std::vector<BoardView> views;
  for (const Held& at : boards) {
    BoardView view{std::to_string(views.size()), {}};
    for (int row = 0; row < kBoard.rows; ++row)
      for (int column = 0; column < kBoard.columns; ++column) {
        const Eigen::Vector3d point = at.turn * Eigen::Vector3d{0.025 * column, 0.025 * row, 0.0} + at.place;
        view.corners.push_back(lens.pixel_of(point) + 0.05 * Eigen::Vector2d{rng.normal(), rng.normal()});
      }
    views.push_back(std::move(view));
  }
  return views;
}

/// [pixels] the farthest that a direction within the picture falls from where it truly does.
double farthest_off(const TrueLens& truth, const LensParams& found) {
  const Lens lens = Lens::make(found).value();
  double most = 0.0;
  for (double x = -0.95; x <= 0.95; x += 0.05)
    for (double y = -0.95; y <= 0.95; y += 0.05) {
      const Eigen::Vector3d ray{x * (truth.is_fisheye ? 1.6 : 0.7), y * (truth.is_fisheye ? 1.2 : 0.5), 1.0};
      const Eigen::Vector2d is = truth.pixel_of(ray);
      constexpr double kRim = 25.0;  // [pixels]: no board reaches the very edge
      if (is.x() < kRim || is.y() < kRim || is.x() > truth.columns - kRim || is.y() > truth.rows - kRim) continue;
      const auto at = lens.pixel_of(ray);
      most = std::max(most, at ? (*at - is).norm() : 1e3);
    }
  return most;
}

TEST(BoardFinder, FindsCornersToATenthOfAPixelOrNone) {
  const TrueLens lens;
  Rng rng{3};
  const Held at = board_pictures::held(kBoard, {0.03, -0.02, 0.4}, 0.3, -0.2, 0.1);
  const auto corners = find_board(board_pictures::picture_of(lens, kBoard, at, 3.0, rng), 640, 480, kBoard);
  ASSERT_TRUE(corners);
  double squares = 0.0;
  for (int row = 0; row < kBoard.rows; ++row)
    for (int column = 0; column < kBoard.columns; ++column) {
      const Eigen::Vector3d point = at.turn * Eigen::Vector3d{0.025 * column, 0.025 * row, 0.0} + at.place;
      squares +=
          ((*corners)[static_cast<std::size_t>(row * kBoard.columns + column)] - lens.pixel_of(point)).squaredNorm();
    }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(kBoard.corners())), 0.1);
  EXPECT_FALSE(find_board(std::vector<std::uint8_t>(640 * 480, 120), 640, 480, kBoard));
}

TEST(LensCalibration, FindsAPinholesBendFromDrawnBoards) {
  const TrueLens truth;
  Rng rng{1};
  const auto views = views_of(truth, board_pictures::held_all_over(truth, kBoard, 20, rng), 7);
  ASSERT_GE(views.size(), 14U);
  const auto made = calibrate_lens(views, kBoard, 640, 480);
  ASSERT_TRUE(made) << made.error().message;
  std::printf("pinhole: %zu boards, %.3f pixels RMS, focal length off by %.2f +- %.2f, farthest off %.2f pixels\n",
              views.size(), made->rms, made->lens.focal_x - truth.focal_x, made->focal_sigma[0],
              farthest_off(truth, made->lens));
  EXPECT_LT(made->rms, 0.15);
  EXPECT_NEAR(made->lens.focal_x, truth.focal_x, 0.005 * truth.focal_x);
  EXPECT_NEAR(made->lens.centre_x, truth.centre_x, 2.0);
  EXPECT_NEAR(made->lens.centre_y, truth.centre_y, 2.0);
  EXPECT_NEAR(made->lens.focal_x, truth.focal_x, 4.0 * made->focal_sigma[0] + 0.3) << "it knows how sure it is";
  EXPECT_LT(farthest_off(truth, made->lens), 1.0);
  EXPECT_GT(made->coverage, 0.6);
  EXPECT_TRUE(made->doubts.empty()) << made->doubts.front();
}

TEST(LensCalibration, FindsAFisheyesBendFromDrawnBoards) {
  const TrueLens truth = wide_lens();
  Rng rng{2};
  const auto views = views_of(truth, board_pictures::held_all_over(truth, kBoard, 20, rng), 8);
  ASSERT_GE(views.size(), 12U);
  LensCalibrationParams params;
  params.kind = LensParams::Kind::fisheye;
  const auto made = calibrate_lens(views, kBoard, 640, 480, params);
  ASSERT_TRUE(made) << made.error().message;
  std::printf("fisheye: %zu boards, %.3f pixels RMS, focal length off by %.2f, farthest off %.2f pixels\n",
              views.size(), made->rms, made->lens.focal_x - truth.focal_x, farthest_off(truth, made->lens));
  EXPECT_LT(made->rms, 0.2);
  EXPECT_NEAR(made->lens.focal_x, truth.focal_x, 0.01 * truth.focal_x);
  EXPECT_LT(farthest_off(truth, made->lens), 2.0);
}

TEST(LensCalibration, LeavesOutAPictureThatFitsFarWorse) {
  const TrueLens truth;
  Rng rng{1};
  auto views = exact_views(truth, board_pictures::held_all_over(truth, kBoard, 14, rng), rng);
  for (std::size_t i = 0; i < views[3].corners.size(); ++i) views[3].corners[i].x() += i % 2 == 0 ? 4.0 : -4.0;
  const auto made = calibrate_lens(views, kBoard, 640, 480);
  ASSERT_TRUE(made) << made.error().message;
  for (const CalibratedView& view : made->views) EXPECT_EQ(view.counts, view.name != views[3].name) << view.name;
  EXPECT_LT(made->rms, 0.15);
}

TEST(LensCalibration, RefusesTooFewAndDoubtsWhatTellsLittle) {
  const TrueLens truth;
  Rng rng{1};
  const auto views = exact_views(truth, board_pictures::held_all_over(truth, kBoard, 8, rng), rng);
  const auto few = calibrate_lens(std::span{views}.first(3), kBoard, 640, 480);
  ASSERT_FALSE(few);
  EXPECT_NE(few.error().message.find("3 pictures"), std::string::npos) << few.error().message;
  std::vector<Held> flat;
  for (int i = 0; i < 9; ++i)
    flat.push_back(board_pictures::held(kBoard, {0.01 * i - 0.04, 0.0, 0.4 + 0.02 * i}, 0.01 * i, 0.0, 0.0));
  const auto made = calibrate_lens(exact_views(truth, flat, rng), kBoard, 640, 480);
  if (!made) return;  // no lens at all fits: said, too
  bool is_said = false;
  for (const std::string& doubt : made->doubts) is_said = is_said || doubt.find("turned") != std::string::npos;
  EXPECT_TRUE(is_said);
}

}  // namespace
}  // namespace docent::vision
