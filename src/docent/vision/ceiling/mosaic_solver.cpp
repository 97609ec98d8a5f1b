#include "docent/vision/ceiling/mosaic_solver.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace docent::vision {
namespace {

constexpr int kAcross = 8, kDown = 6;     // parts of a picture that have their samples each
constexpr double kFirmly = 1e-4;          // [m, rad] of the one pose that is held without priors
constexpr double kNearestPartner = 0.1;   // share of a picture's reach: nearer ones tell nothing of heights
constexpr double kOfSweep = 0.3;          // share of a level's time that its heights take, about
constexpr double kFarthestPartner = 1.3;  // share of it: farther ones hardly overlap

/// What all pictures of a level have in common, and the pictures.
struct Level {
  std::vector<ShrunkPicture> pictures;
  std::vector<std::vector<CeilingSample>> looks;  ///< of each picture
};

struct BlockRay {
  int column = 0, row = 0;
  float slope_x = 0.0F, slope_y = 0.0F;
};

std::vector<BlockRay> rays_of(const CeilingCamera& camera, const ShrunkPicture& picture, double steepest) {
  std::vector<BlockRay> rays;
  for (int row = 1; row + 1 < picture.rows(); ++row) {
    for (int column = 1; column + 1 < picture.columns(); ++column) {
      const auto ray = camera.lens.ray_of({picture.middle(column), picture.middle(row)});
      if (!ray) continue;
      const Eigen::Vector3d up = camera.mount.robot_from_camera * *ray;
      if (up.z() <= 0.0 || std::hypot(up.x(), up.y()) > steepest * up.z()) continue;
      rays.push_back({column, row, static_cast<float>(up.x() / up.z()), static_cast<float>(up.y() / up.z())});
    }
  }
  return rays;
}

/// Where the picture changes most, in each of kAcross x kDown parts of it.
std::vector<CeilingSample> looks_of(const ShrunkPicture& picture, const std::vector<BlockRay>& rays, int samples) {
  struct Rated {
    float change = 0.0F;
    const BlockRay* ray = nullptr;
  };
  std::vector<std::vector<Rated>> fields(static_cast<std::size_t>(kAcross * kDown));
  for (const BlockRay& ray : rays) {
    const float x = picture.at(ray.column + 1, ray.row) - picture.at(ray.column - 1, ray.row);
    const float y = picture.at(ray.column, ray.row + 1) - picture.at(ray.column, ray.row - 1);
    const int field = ray.row * kDown / picture.rows() * kAcross + ray.column * kAcross / picture.columns();
    fields[static_cast<std::size_t>(field)].push_back({x * x + y * y, &ray});
  }
  const auto each = static_cast<std::size_t>(std::max(1, samples / (kAcross * kDown)));
  std::vector<CeilingSample> looks;
  for (auto& field : fields) {
    const std::size_t count = std::min(each, field.size());
    std::stable_sort(field.begin(), field.end(), [](const Rated& a, const Rated& b) { return a.change > b.change; });
    for (std::size_t i = 0; i < count; ++i) {
      const BlockRay& ray = *field[i].ray;
      looks.push_back({ray.slope_x, ray.slope_y, picture.at(ray.column, ray.row)});
    }
  }
  return looks;
}

Level level_of(const CeilingCamera& camera, std::span<const PlacedPicture> pictures, int block,
               const MosaicSolverParams& params) {
  Level level;
  for (const PlacedPicture& placed : pictures) level.pictures.emplace_back(placed.picture, block);
  const std::vector<BlockRay> rays = rays_of(camera, level.pictures.front(), params.steepest);
  for (const ShrunkPicture& picture : level.pictures) level.looks.push_back(looks_of(picture, rays, params.samples));
  return level;
}

/// A first guess: that all pictures are as bright and as lively as one another.
void guess_light(const Level& level, std::vector<PictureUnknowns>& unknowns) {
  std::vector<double> means, deviations;
  double mean_of_all = 0.0, deviation_of_all = 0.0;
  for (const ShrunkPicture& picture : level.pictures) {
    double sum = 0.0, squares = 0.0;
    for (int row = 0; row < picture.rows(); ++row)
      for (int column = 0; column < picture.columns(); ++column) {
        const auto value = static_cast<double>(picture.at(column, row));
        sum += value, squares += value * value;
      }
    const double count = static_cast<double>(picture.columns()) * picture.rows();
    means.push_back(sum / count);
    deviations.push_back(std::sqrt(std::max(1e-6, squares / count - sum / count * (sum / count))));
    mean_of_all += means.back(), deviation_of_all += deviations.back();
  }
  mean_of_all /= static_cast<double>(means.size()), deviation_of_all /= static_cast<double>(means.size());
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const double gain = std::clamp(deviations[i] / deviation_of_all, 0.3, 3.0);
    unknowns[i].light = {std::log(gain), means[i] - gain * mean_of_all};
  }
}

Pose2 pose_of(const PictureUnknowns& unknown) {
  return {unknown.pose[0], unknown.pose[1], Angle::radians(unknown.pose[2])};
}

/// Which pictures each one is laid on: the next, and others from near to far, so that their parallax tells the height.
std::vector<std::vector<std::size_t>> partners_of(const std::vector<PictureUnknowns>& unknowns, double reach,
                                                  int count) {
  std::vector<std::vector<std::size_t>> partners(unknowns.size());
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const double away = distance(pose_of(unknowns[i]).position(), pose_of(unknowns[k]).position());
      if (k != i && away > kNearestPartner * reach && away < kFarthestPartner * reach) near.emplace_back(away, k);
    }
    std::sort(near.begin(), near.end());
    const std::size_t wanted = std::min(near.size(), static_cast<std::size_t>(count));
    for (std::size_t n = 0; n < wanted; ++n) partners[i].push_back(near[n * near.size() / wanted].second);
    if (i + 1 < unknowns.size() && std::find(partners[i].begin(), partners[i].end(), i + 1) == partners[i].end())
      partners[i].push_back(i + 1);
  }
  return partners;
}

std::vector<PartSample> with_parts(const std::vector<CeilingSample>& looks, const CeilingMosaic& mosaic,
                                   const CeilingCamera& camera, const Pose2& map_from_robot) {
  std::vector<PartSample> samples;
  const Eigen::Vector3d& lens = camera.mount.position;
  for (const CeilingSample& look : looks) {
    for (std::size_t part = 0; part < mosaic.heights.size(); ++part) {
      const double above = mosaic.heights[part] - lens.z();
      const CellIndex cell =
          mosaic.frame.cell_at(map_from_robot * Point2{lens.x() + above * static_cast<double>(look.slope_x),
                                                       lens.y() + above * static_cast<double>(look.slope_y)});
      if (!mosaic.frame.holds(cell) || mosaic.part[mosaic.frame.index(cell)] != part) continue;
      samples.push_back({look, static_cast<std::uint8_t>(part)});
      break;
    }
  }
  return samples;
}

/// Those that no lower part hides from the other picture.
std::vector<PartSample> seen_by(const std::vector<PartSample>& samples, const CeilingMosaic& mosaic,
                                const CeilingCamera& camera, const Pose2& map_from_robot, const Pose2& map_from_other) {
  const Eigen::Vector3d& lens = camera.mount.position;
  const Point2 other_lens = map_from_other * Point2{lens.x(), lens.y()};
  std::vector<PartSample> seen;
  for (const PartSample& sample : samples) {
    const double above = mosaic.heights[sample.part] - lens.z();
    const Point2 at = map_from_robot * Point2{lens.x() + above * static_cast<double>(sample.look.slope_x),
                                              lens.y() + above * static_cast<double>(sample.look.slope_y)};
    if (is_visible(mosaic, other_lens, lens.z(), at, sample.part)) seen.push_back(sample);
  }
  return seen;
}

void hold(ceres::Problem& problem, std::span<const double> errors, std::span<const double> at, double* block) {
  const auto size = static_cast<Eigen::Index>(errors.size());
  ceres::Matrix weights = ceres::Matrix::Zero(size, size);
  ceres::Vector mean(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    weights(i, i) = 1.0 / errors[static_cast<std::size_t>(i)];
    mean(i) = at[static_cast<std::size_t>(i)];
  }
  problem.AddResidualBlock(new ceres::NormalPrior(weights, mean), nullptr, block);
}

/// The way from one picture to the next as odometry has it: parameters are both poses, residuals the differences over
/// their standard deviations.
struct OdometryStep {
  Pose2 told;
  double error, turn_error;
  template <class T>
  bool operator()(const T* from, const T* to, T* residuals) const {
    using std::cos, std::sin;
    const T c = cos(from[2]), s = sin(from[2]);
    const T x = to[0] - from[0], y = to[1] - from[1];
    residuals[0] = (c * x + s * y - told.x) / error;
    residuals[1] = (c * y - s * x - told.y) / error;
    const T turn = to[2] - from[2] - told.theta.radians();
    residuals[2] = atan2(sin(turn), cos(turn)) / turn_error;
    return true;
  }
};

void lay_steps(std::span<const PlacedPicture> pictures, const MosaicSolverParams& params,
               std::vector<PictureUnknowns>& unknowns, ceres::Problem& problem) {
  for (std::size_t i = 0; i + 1 < pictures.size(); ++i) {
    const auto &from = pictures[i].odom_from_robot, &to = pictures[i + 1].odom_from_robot;
    if (!from || !to) continue;
    const Pose2 told = inverse(*from) * *to;
    const double error = params.step_error + params.step_share * norm(told.position());
    const double turn_error = params.step_error + params.step_share * std::abs(told.theta.radians());
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<OdometryStep, 3, 3, 3>{new OdometryStep{told, error, turn_error}}, nullptr,
        unknowns[i].pose.data(), unknowns[i + 1].pose.data());
  }
}

/// Asks after each step of Levenberg-Marquardt whether it shall go on.
class AskedStep final : public ceres::IterationCallback {
 public:
  explicit AskedStep(const std::function<bool(int)>& goes_on) : goes_on_{goes_on} {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    return goes_on_(step.iteration) ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  const std::function<bool(int)>& goes_on_;
};

/// A residual block for each pair of pictures that overlap. @param turn  of the camera
void lay_pairs(const CeilingCamera& camera, const Level& level, const MosaicSolverParams& params, CeilingMosaic& mosaic,
               std::vector<PictureUnknowns>& unknowns, std::array<double, 2>& turn, ceres::Problem& problem) {
  const double reach = params.steepest * (mosaic.heights.front() - camera.mount.position.z());
  const auto partners = partners_of(unknowns, reach, params.partners);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const std::vector<PartSample> samples = with_parts(level.looks[i], mosaic, camera, pose_of(unknowns[i]));
    if (samples.empty()) continue;
    std::vector<std::uint8_t> parts;
    for (const PartSample& sample : samples)
      if (std::find(parts.begin(), parts.end(), sample.part) == parts.end()) parts.push_back(sample.part);
    for (const std::size_t k : partners[i]) {
      const std::vector<PartSample> common =
          seen_by(samples, mosaic, camera, pose_of(unknowns[i]), pose_of(unknowns[k]));
      if (common.empty()) continue;
      std::vector<double*> blocks{unknowns[i].pose.data(), unknowns[i].light.data(), unknowns[k].pose.data(),
                                  unknowns[k].light.data(), turn.data()};
      for (const std::uint8_t part : parts) blocks.push_back(&mosaic.heights[part]);
      problem.AddResidualBlock(new MosaicPair{camera, common, parts, level.pictures[k], params.pair}, nullptr, blocks);
    }
  }
}

/// Poses, light and heights, on one level. @param goes_on  asked after each step, of which it is told the number
void solve_level(const Level& level, std::span<const PlacedPicture> priors, const MosaicSolverParams& params,
                 std::vector<PictureUnknowns>& unknowns, SolvedMosaic& solved,
                 const std::function<bool(int)>& goes_on) {
  ceres::Problem problem;
  const CeilingCamera camera = solved.camera;
  CeilingMosaic& mosaic = solved.mosaic;
  std::array<double, 2> turn{};  // of the camera
  lay_pairs(camera, level, params, mosaic, unknowns, turn, problem);
  const std::array<double, 3> pose_errors{params.position_error, params.position_error, params.heading_error};
  const std::array<double, 3> firmly{kFirmly, kFirmly, kFirmly};
  const std::array<double, 2> light_errors{params.gain_error, params.offset_error}, neutral{};
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const Pose2& prior = priors[i].map_from_robot;
    // The angle that is nearest to the estimate's, which may have gone beyond half a turn.
    const double heading = unknowns[i].pose[2] + (prior.theta - Angle::radians(unknowns[i].pose[2])).radians();
    const std::array<double, 3> at{prior.x, prior.y, heading};
    if (params.use_priors || i == 0)
      hold(problem, params.use_priors ? pose_errors : firmly, at, unknowns[i].pose.data());
    hold(problem, light_errors, neutral, unknowns[i].light.data());
    if (!params.solve_light) problem.SetParameterBlockConstant(unknowns[i].light.data());
  }
  if (params.use_priors) lay_steps(priors, params, unknowns, problem);
  if (problem.HasParameterBlock(turn.data())) {
    const std::array<double, 2> turn_errors{params.mount_error, params.mount_error};
    hold(problem, turn_errors, neutral, turn.data());
    if (!params.solve_mount) problem.SetParameterBlockConstant(turn.data());
  }
  for (double& height : mosaic.heights) {
    if (!problem.HasParameterBlock(&height)) continue;
    if (!params.solve_heights) problem.SetParameterBlockConstant(&height);
    problem.SetParameterLowerBound(&height, 0, camera.mount.position.z() + 0.1);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // others call the BLAS that a machine has
  options.max_num_iterations = params.most_steps;
  options.function_tolerance = 1e-4;
  options.num_threads = 1;  // sums in one order: the same mosaic everywhere
  options.logging_type = ceres::SILENT;
  AskedStep asked{goes_on};
  options.callbacks.push_back(&asked);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  solved.camera.mount.robot_from_camera =
      Eigen::AngleAxisd{std::hypot(turn[0], turn[1]), Eigen::Vector3d{turn[0], turn[1], 1e-12}.normalized()} *
      camera.mount.robot_from_camera;
  solved.unknowns = static_cast<std::size_t>(summary.num_effective_parameters_reduced);
  solved.residuals = static_cast<std::size_t>(summary.num_residuals_reduced);
  solved.squares = 2.0 * summary.final_cost / std::max<double>(1.0, static_cast<double>(solved.residuals));
}

GridFrame frame_of(std::span<const PlacedPicture> pictures, const MosaicSolverParams& params) {
  Point2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point2 high{-low.x, -low.y};
  for (const PlacedPicture& placed : pictures) {
    low = {std::min(low.x, placed.map_from_robot.x), std::min(low.y, placed.map_from_robot.y)};
    high = {std::max(high.x, placed.map_from_robot.x), std::max(high.y, placed.map_from_robot.y)};
  }
  const auto cells = [&](double length) {
    return static_cast<int>(std::ceil((length + 2.0 * params.margin) / params.resolution));
  };
  return {cells(high.x - low.x), cells(high.y - low.y), params.resolution, low - Point2{params.margin, params.margin}};
}

std::size_t largest_part(const CeilingMosaic& mosaic) {
  std::vector<std::size_t> cells(mosaic.heights.size());
  for (const std::uint8_t part : mosaic.part)
    if (part != CeilingMosaic::kUnknown) ++cells[part];
  return static_cast<std::size_t>(std::max_element(cells.begin(), cells.end()) - cells.begin());
}

/// All of it at the height that most cells have.
void flatten(CeilingMosaic& mosaic) {
  const std::size_t most = largest_part(mosaic);
  mosaic.heights = {mosaic.heights[most]};
  for (std::uint8_t& part : mosaic.part)
    if (part != CeilingMosaic::kUnknown) part = 0;
}

/// Of a first look at heights, by poses and a mount that are not found yet, only the largest part is to be relied upon.
void keep_largest(CeilingMosaic& mosaic) {
  const std::size_t most = largest_part(mosaic);
  mosaic.heights = {mosaic.heights[most]};
  for (std::uint8_t& part : mosaic.part) part = part == most ? std::uint8_t{0} : CeilingMosaic::kUnknown;
}

void take_over(const std::vector<PictureUnknowns>& unknowns, SolvedMosaic& solved) {
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    solved.pictures[i].map_from_robot = pose_of(unknowns[i]);
    solved.pictures[i].gain = std::exp(unknowns[i].light[0]);
    solved.pictures[i].offset = unknowns[i].light[1];
  }
}

}  // namespace

Result<void> MosaicSolverParams::validate() const {
  if (!(resolution > 0.0 && margin >= 0.0 && steepest > 0.0))
    return fail("mosaic.resolution and steepest must be > 0, margin >= 0");
  if (blocks.empty() || *std::min_element(blocks.begin(), blocks.end()) < 1)
    return fail("mosaic.blocks must be > 0, and some");
  if (samples < 1 || partners < 1 || most_steps < 1) return fail("mosaic.samples, partners and most_steps must be > 0");
  if (!(position_error > 0.0 && heading_error > 0.0 && mount_error > 0.0 && gain_error > 0.0 && offset_error > 0.0))
    return fail("mosaic.position_error, heading_error, mount_error, gain_error and offset_error must be > 0");
  if (!(step_error > 0.0 && step_share > 0.0)) return fail("mosaic.step_error and step_share must be > 0");
  return sweep.validate();
}

Result<SolvedMosaic> solve_mosaic(const CeilingCamera& camera, std::span<const PlacedPicture> pictures,
                                  const MosaicSolverParams& params, const MosaicProgress& progress) {
  if (const auto valid = params.validate(); !valid) return tl::unexpected<Error>(valid.error());
  if (pictures.size() < 3) return fail("a ceiling needs three pictures at least");
  for (const PlacedPicture& placed : pictures)
    if (placed.picture.columns != camera.lens.params().columns || placed.picture.rows != camera.lens.params().rows)
      return fail("a picture has not the size of the lens");
  SolvedMosaic solved{camera, {}, {}, {}};
  std::vector<std::span<const std::uint8_t>> views;
  for (const PlacedPicture& placed : pictures) views.push_back(placed.picture.bytes);
  if (params.solve_light) solved.field = flat_field_of(views, camera.lens);
  std::vector<std::vector<std::uint8_t>> even;
  std::vector<PlacedPicture> evened{pictures.begin(), pictures.end()};
  for (PlacedPicture& placed : evened) {
    even.push_back(flattened(placed.picture.bytes, placed.picture.columns, solved.field));
    placed.picture.bytes = even.back();
  }
  solved.pictures.assign(pictures.begin(), pictures.end());
  std::vector<PictureUnknowns> unknowns;
  for (const PlacedPicture& placed : pictures)
    unknowns.push_back(
        {{placed.map_from_robot.x, placed.map_from_robot.y, placed.map_from_robot.theta.radians()}, {0.0, 0.0}});
  const GridFrame frame = frame_of(pictures, params);
  const auto levels = static_cast<double>(params.blocks.size());
  const auto say = [&](const std::string& stage, double share, bool is_end) {
    return !progress || progress({stage, share, is_end, solved});
  };
  const std::size_t sweeps_again = params.blocks.size() > 1 ? 1 : 0;  // before it the poses are good to a coarse pixel
  bool goes_on = true;
  for (std::size_t i = 0; i < params.blocks.size() && goes_on; ++i) {
    const Level level = level_of(solved.camera, evened, params.blocks[i], params);
    const std::string pixels = ", blocks of " + std::to_string(params.blocks[i]) + " pixels";
    const auto share = [&](double of_level) { return (static_cast<double>(i) + of_level) / levels; };
    if (i == 0 || i == sweeps_again) {
      if (i == 0 && params.solve_light) guess_light(level, unknowns);
      if (!say("heights" + pixels, share(0.0), false) && i > 0) break;
      solved.mosaic = sweep_heights(frame, solved.camera, level.pictures, unknowns, params.sweep);
      if (!params.solve_heights && !solved.mosaic.heights.empty()) flatten(solved.mosaic);
      if (i == 0 && sweeps_again == 1 && !solved.mosaic.heights.empty()) keep_largest(solved.mosaic);
      if (solved.mosaic.heights.empty())
        return fail("the ceiling is too plain, or its pictures are too few, to tell its height");
      take_over(unknowns, solved);
      goes_on = say("heights" + pixels, share(kOfSweep), true);
    }
    const std::string stage = "poses, heights and light" + pixels;
    solve_level(level, pictures, params, unknowns, solved, [&](int step) {
      goes_on = goes_on && say(stage, share(kOfSweep + (1.0 - kOfSweep) * step / (params.most_steps + 1.0)), false);
      return goes_on;
    });
    take_over(unknowns, solved);
    goes_on = say(stage, share(1.0), true) && goes_on;
  }
  solved.mosaic = drawn(solved, params);
  return solved;
}

CeilingMosaic drawn(const SolvedMosaic& solved, const MosaicSolverParams& params, double resolution) {
  CeilingMosaic mosaic = solved.mosaic;
  if (resolution > mosaic.frame.resolution) {
    const GridFrame fine = mosaic.frame;
    const double share = fine.resolution / resolution;
    mosaic.frame = {std::max(1, static_cast<int>(fine.columns * share)),
                    std::max(1, static_cast<int>(fine.rows * share)), resolution, fine.origin};
    mosaic.part.assign(mosaic.frame.size(), CeilingMosaic::kUnknown);
    for (int row = 0; row < mosaic.frame.rows; ++row)
      for (int column = 0; column < mosaic.frame.columns; ++column) {
        const CellIndex cell = fine.cell_at(mosaic.frame.centre({column, row}));
        if (fine.holds(cell)) mosaic.part[mosaic.frame.index({column, row})] = solved.mosaic.part[fine.index(cell)];
      }
  }
  MosaicDrawing drawing{std::move(mosaic), solved.camera, params.steepest};
  for (PlacedPicture placed : solved.pictures) {
    const std::vector<std::uint8_t> even = flattened(placed.picture.bytes, placed.picture.columns, solved.field);
    placed.picture.bytes = even;
    drawing.add(placed);
  }
  return drawing.mosaic();
}

}  // namespace docent::vision
