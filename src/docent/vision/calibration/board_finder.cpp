#include "docent/vision/calibration/board_finder.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace docent::vision {

Result<void> Board::validate() const {
  constexpr int kMost = 50;
  if (!(columns >= 3 && rows >= 3 && columns <= kMost && rows <= kMost))
    return fail("a board has 3 to 50 inner corners a side");
  if (columns == rows) return fail("a board that has as many rows as columns looks the same turned by a quarter");
  if (!(square > 0.0)) return fail("the board's squares must be larger than nothing");
  return {};
}

std::optional<std::vector<Eigen::Vector2d>> find_board(std::span<const std::uint8_t> grey, int columns, int rows,
                                                       const Board& board) {
  cv::setNumThreads(1);
  const cv::Mat picture{rows, columns, CV_8UC1, const_cast<std::uint8_t*>(grey.data())};  // only read
  std::vector<cv::Point2f> found;
  constexpr int kHow = cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  if (!cv::findChessboardCorners(picture, {board.columns, board.rows}, found, kHow)) return std::nullopt;
  // A window that reaches the next corner would be drawn to it.
  double nearest = 1e9;
  for (std::size_t i = 1; i < found.size(); ++i)
    if (i % static_cast<std::size_t>(board.columns) != 0)
      nearest = std::min(nearest, std::hypot(static_cast<double>(found[i].x - found[i - 1].x),
                                             static_cast<double>(found[i].y - found[i - 1].y)));
  const int half = std::clamp(static_cast<int>(0.35 * nearest), 2, 11);
  constexpr int kRounds = 60;
  constexpr double kStill = 1e-3;  // [pixels]
  cv::cornerSubPix(picture, found, {half, half}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::MAX_ITER, kRounds, kStill});
  std::vector<Eigen::Vector2d> corners;
  for (const cv::Point2f& corner : found) corners.emplace_back(corner.x, corner.y);
  return corners;
}

}  // namespace docent::vision
