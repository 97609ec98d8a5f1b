#include "docent/simulator/eye_drivers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/messages/conversions.h"

namespace docent::simulator {
namespace {

constexpr double kEyeStep = 0.01;  // [s]

std::uint64_t period_of(double rate) {
  return static_cast<std::uint64_t>(std::max(1L, std::lround(1.0 / (rate * kEyeStep))));
}

RobotEyesParams with_seed(RobotEyesParams params, const Rng& rng) {
  Rng own = rng.stream("eyes");
  params.seed = own();
  return params;
}

/// By half a turn: the first pixel becomes the last.
void turn_round(std::vector<std::uint8_t>& bytes, std::uint32_t pixel_bytes) {
  const std::size_t pixels = bytes.size() / pixel_bytes;
  for (std::size_t i = 0; i < pixels / 2; ++i)
    std::swap_ranges(bytes.begin() + static_cast<std::ptrdiff_t>(i * pixel_bytes),
                     bytes.begin() + static_cast<std::ptrdiff_t>((i + 1) * pixel_bytes),
                     bytes.begin() + static_cast<std::ptrdiff_t>((pixels - 1 - i) * pixel_bytes));
}

}  // namespace

EyeDrivers::EyeDrivers(transport::Bus& bus, const EyeOptions& options, const Rng& rng)
    : options_{options},
      eyes_{with_seed(options.eyes, rng)},
      rng_{rng.stream("noise")},
      up_{eye_of(bus, topics::kCeilingImage, topics::kCeilingInfo, eyes_.told().up, "ceiling_camera")},
      depth_{eye_of(bus, topics::kDepthImage, topics::kDepthInfo, eyes_.told().depth, "depth_camera")},
      front_{eye_of(bus, topics::kFrontImage, topics::kFrontInfo, eyes_.told().front, "front_camera")} {}

EyeDrivers::Eye& EyeDrivers::which(EyeFault::Eye eye) {
  if (eye == EyeFault::Eye::front) return front_;
  return eye == EyeFault::Eye::depth ? depth_ : up_;
}

EyeDrivers::Eye EyeDrivers::eye_of(transport::Bus& bus, const Topic<sensor_msgs::Image>& images,
                                   const Topic<sensor_msgs::CameraInfo>& infos, const simulator::Eye& told,
                                   const char* frame) {
  // A driver calls the middle of the first pixel 0, 0; here its corner is.
  constexpr double kHalfPixel = 0.5;
  const LensModel& lens = told.lens;
  sensor_msgs::CameraInfo info;
  info.header.frame_id = frame;
  info.width = static_cast<std::uint32_t>(lens.width);
  info.height = static_cast<std::uint32_t>(lens.height);
  const double cx = lens.centre_x - kHalfPixel, cy = lens.centre_y - kHalfPixel;
  info.k = {lens.focal_x, 0.0, cx, 0.0, lens.focal_y, cy, 0.0, 0.0, 1.0};
  info.r = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.p = {lens.focal_x, 0.0, cx, 0.0, 0.0, lens.focal_y, cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  if (lens.kind == LensKind::fisheye) {
    info.distortion_model = "equidistant";
    info.d.assign(lens.fisheye.begin(), lens.fisheye.end());
  } else {
    info.distortion_model = "plumb_bob";
    info.d.assign(lens.brown.begin(), lens.brown.end());
  }
  return {bus.publisher(images), bus.publisher(infos), info, std::nullopt};
}

void EyeDrivers::set_fault(const EyeFault& fault, Time now) {
  constexpr double kForEver = 1e9;  // [s]
  Eye& eye = which(fault.eye);
  eye.fault = fault;
  eye.fault_ends = now + seconds(fault.duration > 0.0 ? fault.duration : kForEver);
}

bool EyeDrivers::has(const Eye& eye, EyeFault::Kind kind, Time now) {
  return eye.fault && eye.fault->kind == kind && now < eye.fault_ends;
}

bool EyeDrivers::is_due(std::uint64_t step) const {
  return (options_.up && step % period_of(options_.up_rate) == 0) ||
         (options_.depth && step % period_of(options_.depth_rate) == 0) ||
         (options_.front && step % period_of(options_.front_rate) == 0);
}

void EyeDrivers::look(const Renderer& renderer, Time now, std::uint64_t step, const Pose2& world_from_base) {
  Glimpse glimpse{.time = to_seconds(now - Time{}), .world_from_base = world_from_base};
  const double since = to_seconds(now - last_look_);
  constexpr double kLongest = 1.0;  // [s] since the last picture, for its blur
  if (last_pose_ && since > 0.0 && since < kLongest) {
    const Pose2 moved = inverse(*last_pose_) * world_from_base;
    glimpse.linear = moved.x / since, glimpse.angular = moved.theta.radians() / since;
  }
  last_pose_ = world_from_base;
  last_look_ = now;
  const std::string moment = std::to_string(step);
  using Kind = EyeFault::Kind;
  if (options_.up && step % period_of(options_.up_rate) == 0) {
    if (has(up_, Kind::exposure, now)) glimpse.gain = up_.fault->gain;
    if (has(up_, Kind::lamps_off, now) || has(depth_, Kind::lamps_off, now)) glimpse.lighting.circuits = {};
    Rng noise = rng_.stream("up " + moment);
    keep(up_, now, eyes_.look_up(renderer, glimpse, noise), "mono8", 1);
  }
  if (options_.depth && step % period_of(options_.depth_rate) == 0) {
    Rng noise = rng_.stream("depth " + moment);
    std::vector<std::uint8_t> bytes;
    for (const std::uint16_t depth : eyes_.measure_depths(renderer, glimpse, noise)) {
      bytes.push_back(static_cast<std::uint8_t>(depth & 0xFFU));
      bytes.push_back(static_cast<std::uint8_t>(depth >> 8U));
    }
    keep(depth_, now, std::move(bytes), "16UC1", 2);
  }
  if (options_.front && step % period_of(options_.front_rate) == 0) {
    if (has(front_, Kind::exposure, now)) glimpse.gain = front_.fault->gain;
    Rng noise = rng_.stream("front " + moment);
    const pictures::Image seen = eyes_.look_ahead(renderer, glimpse, noise);
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i < seen.bytes().size(); ++i)
      if (i % 4 != 3) bytes.push_back(seen.bytes()[i]);
    keep(front_, now, std::move(bytes), "rgb8", 3);
  }
}

void EyeDrivers::keep(Eye& eye, Time now, std::vector<std::uint8_t> bytes, const char* encoding,
                      std::uint32_t pixel_bytes) {
  using Kind = EyeFault::Kind;
  if (has(eye, Kind::gone, now)) return;
  if (has(eye, Kind::black, now)) std::fill(bytes.begin(), bytes.end(), std::uint8_t{0});
  if (has(eye, Kind::upside_down, now)) turn_round(bytes, pixel_bytes);
  if (has(eye, Kind::frozen, now) && !eye.last.empty()) bytes = eye.last;
  eye.last = bytes;
  sensor_msgs::Image image{{to_message(now), eye.info.header.frame_id},
                           eye.info.height,
                           eye.info.width,
                           encoding,
                           0,
                           eye.info.width * pixel_bytes,
                           std::move(bytes)};
  const double delay = has(eye, Kind::late, now) ? eye.fault->delay : 0.0;
  waiting_.push_back({now + seconds(delay), &eye, std::move(image)});
}

void EyeDrivers::send(Time now) {
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    if (it->due > now) {
      ++it;
      continue;
    }
    it->eye->info.header.stamp = it->image.header.stamp;
    it->eye->infos.publish(it->eye->info);
    it->eye->images.publish(std::move(it->image));
    it = waiting_.erase(it);
  }
}

}  // namespace docent::simulator
