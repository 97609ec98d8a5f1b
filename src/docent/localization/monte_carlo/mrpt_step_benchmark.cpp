#include <benchmark/benchmark.h>
#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "docent/localization/monte_carlo/benchmark_hall.h"
#include "docent/localization/particles/particle_motion.h"
#include "docent/localization/particles/particle_weights.h"
#include "docent/localization/particles/resampling.h"

/// One step of a particle filter, motion, weights and resampling, of 10,000 particles x 180 beams: MRPT's, as Debian
/// ships it, and ours with every instruction set, on the same map and scan and from the same cloud. Both use a
/// likelihood field, ready before the clock starts, and resample at every step; `off_cm` says how far the mean lies
/// from the truth afterwards.
namespace docent::localization {
namespace {

const Pose2 kStep{0.05, 0.0, Angle::degrees(1.0)};

struct Bench {
  OccupancyGrid map = testing::hall_map();
  sensor_models::RayCaster caster{map};
  LikelihoodField field{caster, {}, 30.0};
  std::vector<double> scan = testing::hall_scan(caster);
  ParticleSet cloud = [] {  // one step behind the scan
    ParticleSet particles = testing::hall_cloud(0.15);
    for (std::size_t i = 0; i < particles.size(); ++i) particles.set(i, particles.pose(i) * inverse(kStep), 1e-4F);
    return particles;
  }();
};
const Bench& bench() {
  static const Bench instance;
  return instance;
}

void ours(benchmark::State& state, FieldKernel kernel) {
  const FieldBeams beams = testing::hall_beams(bench().field, bench().scan);
  NoiseStreams noise{1};
  Rng rng{1};
  ParticleSet particles;
  ParticleSet next;
  std::vector<std::uint32_t> costs(bench().cloud.padded_size());
  FieldPoses poses;
  ParticleEvidence evidence;
  evidence.nats_per_cost = 0.2 / kScorePerNat;
  for (auto _ : state) {
    state.PauseTiming();
    particles = bench().cloud;
    state.ResumeTiming();
    move_particles(particles, {}, kStep, {}, {0.0F, 0.0F, 50.0F, 50.0F}, noise);
    poses.fill(bench().field.view(), particles);
    kernel(bench().field.view(), beams, poses, costs.data());
    reweigh(particles, costs, evidence);
    next.clear();
    resample(particles, 0, particles.size(), particles.size(), rng.uniform(), next);
    benchmark::DoNotOptimize(next.x.data());
  }
  double x = 0.0;
  double y = 0.0;
  for (std::size_t i = 0; i < next.size(); ++i) {
    x += static_cast<double>(next.x[i]) / static_cast<double>(next.size());
    y += static_cast<double>(next.y[i]) / static_cast<double>(next.size());
  }
  state.counters["off_cm"] = 100.0 * distance(Point2{x, y}, testing::kHallPose.position());
}

mrpt::maps::COccupancyGridMap2D::Ptr mrpt_map() {
  const GridFrame& frame = bench().map.frame;
  auto grid = mrpt::maps::COccupancyGridMap2D::Create(0.0F, 50.0F, 0.0F, 50.0F, 0.05F);
  for (int row = 0; row < frame.rows; ++row)
    for (int column = 0; column < frame.columns; ++column)
      grid->setCell(column, row, bench().map.is_occupied({column, row}) ? 0.0F : 1.0F);
  auto& options = grid->likelihoodOptions;
  options.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
  options.LF_decimation = 1;  // all beams
  options.LF_stdHit = 0.2F;
  options.LF_maxRange = 30.0F;
  options.LF_maxCorrsDistance = 1.0F;
  options.enableLikelihoodCache = true;
  return grid;
}

void mrpts(benchmark::State& state) {
  const auto grid = mrpt_map();
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->aperture = static_cast<float>(2.0 * std::numbers::pi * (testing::kHallBeams - 1) / testing::kHallBeams);
  scan->rightToLeft = true;
  scan->maxRange = 30.0F;
  // Its first bearing is minus half the aperture; ours is -180 degrees.
  scan->sensorPose = mrpt::poses::CPose3D(0.0, 0.0, 0.0, -std::numbers::pi / testing::kHallBeams, 0.0, 0.0);
  scan->resizeScan(testing::kHallBeams);
  for (std::size_t i = 0; i < testing::kHallBeams; ++i) {
    scan->setScanRange(i, static_cast<float>(bench().scan[i]));
    scan->setScanRangeValidity(i, true);
  }
  mrpt::obs::CSensoryFrame frame;
  frame.insert(scan);
  mrpt::obs::CActionRobotMovement2D movement;
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions motion;
  motion.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
  movement.computeFromOdometry({kStep.x, kStep.y, kStep.theta.radians()}, motion);
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);

  mrpt::bayes::CParticleFilter filter;
  filter.m_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
  filter.m_options.resamplingMethod = mrpt::bayes::CParticleFilter::prSystematic;
  filter.m_options.adaptiveSampleSize = false;
  filter.m_options.BETA = 1.0;  // resamples always
  mrpt::slam::CMonteCarloLocalization2D particles{testing::kHallParticles};
  particles.options.metricMap = grid;
  const auto set_back = [&] {
    for (std::size_t i = 0; i < testing::kHallParticles; ++i) {
      const Pose2 pose = bench().cloud.pose(i);
      particles.m_particles[i].d = {pose.x, pose.y, pose.theta.radians()};
      particles.m_particles[i].log_w = 0.0;
    }
  };
  // Its likelihoods of cells are found at the first look and kept: that is the map's doing, as our field is.
  for (int warming = 0; warming < 3; ++warming) {
    set_back();
    filter.executeOn(particles, &actions, &frame);
  }
  for (auto _ : state) {
    state.PauseTiming();
    set_back();
    state.ResumeTiming();
    filter.executeOn(particles, &actions, &frame);
  }
  mrpt::poses::CPose2D mean;
  particles.getMean(mean);
  state.counters["off_cm"] = 100.0 * distance(Point2{mean.x(), mean.y()}, testing::kHallPose.position());
}

[[maybe_unused]] const int kRegistered = [] {
  benchmark::RegisterBenchmark("step/mrpt", &mrpts)->Unit(benchmark::kMicrosecond);
  for (const auto& [name, kernel] : field_kernels())
    benchmark::RegisterBenchmark(("step/docent/" + name).c_str(), [k = kernel](benchmark::State& state) {
      ours(state, k);
    })->Unit(benchmark::kMicrosecond);
  return 0;
}();

}  // namespace
}  // namespace docent::localization
