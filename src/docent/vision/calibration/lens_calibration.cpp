#include "docent/vision/calibration/lens_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <set>
#include <string>
#include <utility>

namespace docent::vision {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kPartsAcross = 8, kPartsDown = 6;
constexpr int kRounds = 60;
constexpr double kStill = 1e-9;

/// What OpenCV makes of some views.
struct Solved {
  cv::Mat camera, bend, sigmas;
  std::vector<cv::Mat> turns, places;  ///< of the boards
};

std::vector<cv::Point3f> points_of(const Board& board) {
  std::vector<cv::Point3f> points;
  for (int row = 0; row < board.rows; ++row)
    for (int column = 0; column < board.columns; ++column)
      points.emplace_back(static_cast<float>(column * board.square), static_cast<float>(row * board.square), 0.0F);
  return points;
}

std::vector<cv::Point2f> seen_of(const BoardView& view) {
  std::vector<cv::Point2f> seen;
  for (const auto& corner : view.corners)
    seen.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()));
  return seen;
}

Result<Solved> solve(const std::vector<BoardView>& views, const Board& board, cv::Size size, LensParams::Kind kind) {
  const std::vector<std::vector<cv::Point3f>> points(views.size(), points_of(board));
  std::vector<std::vector<cv::Point2f>> seen;
  for (const BoardView& view : views) seen.push_back(seen_of(view));
  const cv::TermCriteria until{cv::TermCriteria::COUNT | cv::TermCriteria::EPS, kRounds, kStill};
  Solved solved;
  cv::Mat board_sigmas, errors;
  try {
    if (kind == LensParams::Kind::pinhole) {
      cv::calibrateCamera(points, seen, size, solved.camera, solved.bend, solved.turns, solved.places, solved.sigmas,
                          board_sigmas, errors, 0, until);
    } else {
      constexpr int kHow = cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW;
      cv::fisheye::calibrate(points, seen, size, solved.camera, solved.bend, solved.turns, solved.places, kHow, until);
    }
  } catch (const cv::Exception& fault) {
    return fail("nothing fits the boards' corners (" + std::string{fault.err} +
                "): is the board's number of corners right, and the kind of the lens?");
  }
  return solved;
}

LensParams lens_of(const Solved& solved, cv::Size size, LensParams::Kind kind) {
  LensParams lens;
  lens.kind = kind;
  lens.columns = size.width, lens.rows = size.height;
  lens.focal_x = solved.camera.at<double>(0, 0), lens.focal_y = solved.camera.at<double>(1, 1);
  lens.centre_x = solved.camera.at<double>(0, 2), lens.centre_y = solved.camera.at<double>(1, 2);
  const std::size_t count = kind == LensParams::Kind::pinhole ? 5 : 4;
  for (std::size_t i = 0; i < count; ++i) lens.bend[i] = solved.bend.at<double>(static_cast<int>(i));
  return lens;
}

/// [pixels] root of the mean square of a view's corners: by our own lens, which is what the robot will use.
double rms_of(const BoardView& view, const Board& board, const Lens& lens, const cv::Mat& turn, const cv::Mat& place,
              double& tilt) {
  cv::Mat matrix;
  cv::Rodrigues(turn, matrix);
  tilt = std::acos(std::min(1.0, std::abs(matrix.at<double>(2, 2)))) / kDegree;
  double squares = 0.0;
  const auto points = points_of(board);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Eigen::Vector3d at;
    for (int k = 0; k < 3; ++k)
      at(k) = matrix.at<double>(k, 0) * static_cast<double>(points[i].x) +
              matrix.at<double>(k, 1) * static_cast<double>(points[i].y) + place.at<double>(k);
    const auto pixel = lens.pixel_of(at);
    constexpr double kOutside = 1e3;  // [pixels] a corner that the lens cannot see
    squares += pixel ? (*pixel - view.corners[i]).squaredNorm() : kOutside * kOutside;
  }
  return std::sqrt(squares / static_cast<double>(points.size()));
}

double coverage_of(const std::vector<BoardView>& views, cv::Size size) {
  std::set<std::pair<int, int>> parts;
  for (const BoardView& view : views)
    for (const auto& corner : view.corners)
      parts.emplace(static_cast<int>(corner.x() * kPartsAcross / size.width),
                    static_cast<int>(corner.y() * kPartsDown / size.height));
  return static_cast<double>(parts.size()) / (kPartsAcross * kPartsDown);
}

std::string rounded(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

void tell_doubts(LensCalibration& made, const LensCalibrationParams& params) {
  if (made.rms > params.good_rms)
    made.doubts.push_back("corners are off by " + rounded(made.rms, 2) +
                          " pixels: is the board flat, the picture sharp, "
                          "the kind of the lens right?");
  if (made.coverage < params.good_coverage)
    made.doubts.push_back("the boards cover " + rounded(100.0 * made.coverage, 0) +
                          " % of the picture: show the board near its edges and corners, too");
  const bool is_tilted = std::any_of(made.views.begin(), made.views.end(), [&](const CalibratedView& view) {
    return view.counts && view.tilt >= params.least_tilt;
  });
  if (!is_tilted)
    made.doubts.push_back("no board is turned by " + rounded(params.least_tilt, 0) +
                          " degrees: focal length and distance cannot be told apart");
}

}  // namespace

Result<void> LensCalibrationParams::validate() const {
  if (!(least_pictures >= 3)) return fail("least_pictures must be >= 3");
  if (!(most_off > 1.0)) return fail("most_off must be > 1");
  if (!(good_rms > 0.0 && good_coverage >= 0.0 && good_coverage <= 1.0 && least_tilt >= 0.0))
    return fail("good_rms must be > 0, good_coverage 0..1, least_tilt >= 0");
  return {};
}

Result<LensCalibration> calibrate_lens(std::span<const BoardView> views, const Board& board, int columns, int rows,
                                       const LensCalibrationParams& params) {
  if (auto valid = board.validate(); !valid) return tl::unexpected<Error>(valid.error());
  if (auto valid = params.validate(); !valid) return tl::unexpected<Error>(valid.error());
  cv::setNumThreads(1);
  for (const BoardView& view : views)
    if (view.corners.size() != board.corners()) return fail(view.name + ": not the corners of this board");
  std::vector<BoardView> kept{views.begin(), views.end()};
  const cv::Size size{columns, rows};
  LensCalibration made;
  for (int round = 0; round < 2; ++round) {
    if (static_cast<int>(kept.size()) < params.least_pictures)
      return fail("a board was found in " + std::to_string(kept.size()) + " pictures that fit: it takes " +
                  std::to_string(params.least_pictures) + ", from near and far, turned and near the edges");
    const auto solved = solve(kept, board, size, params.kind);
    if (!solved) return tl::unexpected<Error>(solved.error());
    made.lens = lens_of(*solved, size, params.kind);
    const auto lens = Lens::make(made.lens);
    if (!lens) return fail("what fits is no lens (" + lens.error().message + "): are there enough boards, and turned?");
    if (params.kind == LensParams::Kind::pinhole) {
      made.focal_sigma = {solved->sigmas.at<double>(0), solved->sigmas.at<double>(1)};
      made.centre_sigma = {solved->sigmas.at<double>(2), solved->sigmas.at<double>(3)};
    }
    std::vector<CalibratedView> fits;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      CalibratedView fit{kept[i].name};
      fit.rms = rms_of(kept[i], board, *lens, solved->turns[i], solved->places[i], fit.tilt);
      fits.push_back(fit);
    }
    std::vector<double> sorted;
    for (const CalibratedView& fit : fits) sorted.push_back(fit.rms);
    std::sort(sorted.begin(), sorted.end());
    const double most = params.most_off * sorted[sorted.size() / 2];
    std::erase_if(made.views, [](const CalibratedView& view) { return view.counts; });
    double squares = 0.0;
    std::vector<BoardView> good;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      fits[i].counts = round == 1 || fits[i].rms <= most;
      squares += fits[i].rms * fits[i].rms;
      if (fits[i].counts) good.push_back(kept[i]);
      made.views.push_back(fits[i]);
    }
    made.rms = std::sqrt(squares / static_cast<double>(kept.size()));
    made.coverage = coverage_of(kept, size);
    if (good.size() == kept.size()) break;
    kept = std::move(good);
  }
  tell_doubts(made, params);
  return made;
}

}  // namespace docent::vision
