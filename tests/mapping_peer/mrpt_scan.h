#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/system/datetime.h>

#include "docent/recording/laser_log.h"

namespace docent::peers {

inline mrpt::poses::CPose2D as_mrpt(const Pose2& pose) { return {pose.x, pose.y, pose.theta.radians()}; }

inline mrpt::obs::CObservation2DRangeScan::Ptr as_mrpt(const recording::LoggedScan& scan, double max_range) {
  auto out = mrpt::obs::CObservation2DRangeScan::Create();
  out->sensorLabel = "laser";
  out->timestamp = mrpt::Clock::fromDouble(to_seconds(scan.time));
  out->aperture = static_cast<float>(scan.bearing_step * static_cast<double>(scan.ranges.size() - 1));
  out->rightToLeft = true;
  out->maxRange = static_cast<float>(max_range);
  out->sensorPose = mrpt::poses::CPose3D{as_mrpt(scan.base_from_laser)};
  out->resizeScan(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const float range = scan.ranges[i];
    out->setScanRange(i, range);
    out->setScanRangeValidity(i, range > 0.02F && static_cast<double>(range) < max_range);
  }
  return out;
}

/// A log as pairs of action and observation, which MRPT's programs ask for and MRPT's own converters do not write.
inline void write_rawlog(const recording::LaserLog& log, mrpt::serialization::CArchive& archive) {
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions noise;  // as MRPT has it
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const auto& scan = log.scans[i];
    mrpt::obs::CActionRobotMovement2D motion;
    const Pose2 step = i == 0 ? Pose2{} : inverse(log.scans[i - 1].odom_from_base) * scan.odom_from_base;
    motion.computeFromOdometry(as_mrpt(step), noise);
    motion.timestamp = mrpt::Clock::fromDouble(to_seconds(scan.time));
    mrpt::obs::CActionCollection actions;
    actions.insert(motion);
    mrpt::obs::CSensoryFrame frame;
    frame.insert(as_mrpt(scan, log.max_range));
    archive << actions << frame;
  }
}

}  // namespace docent::peers
