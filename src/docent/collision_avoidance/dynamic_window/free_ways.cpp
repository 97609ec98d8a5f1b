#include "docent/collision_avoidance/dynamic_window/free_ways.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {

namespace {

constexpr std::size_t kBuckets = 64;  // of the least way
constexpr double kBucket = FreeWays::kHorizon / kBuckets;

}  // namespace

FreeWays::FreeWays(InstructionSet set) : kernels_{velocity_kernels(set)} {}

int FreeWays::lane_of(double curvature) {
  // Finer near straight on, where a small change moves the far end of the way.
  constexpr double kScale = 0.5 * kLanes * (1.0 + kMaxCurvature) / kMaxCurvature;
  const double place = kScale * curvature / (1.0 + std::abs(curvature)) + 0.5 * kLanes;
  return place >= 0.0 ? static_cast<int>(std::min(place, kLanes - 1.0)) : 0;  // what is no number: in the first
}

void FreeWays::build(std::span<const ReachPoint> points, bool backwards) {
  unsorted_.clear();
  stands_ = false;
  for (const auto& point : points) {
    Contact contact{backwards ? -point.at.x : point.at.x, point.at.y, point.reach};
    const double way2 = contact.x * contact.x + contact.y * contact.y;
    const double reach2 = contact.reach * contact.reach;
    if (way2 <= reach2) {
      stands_ = stands_ || contact.x > 0.0;
      continue;
    }
    contact.least = std::sqrt(way2) - contact.reach;
    if (!(contact.least < kHorizon)) continue;  // far, or no number: it lies nowhere
    contact.power = std::max(0.5 * (way2 - reach2), 1e-12);
    unsorted_.push_back(contact);
  }
  sort();
  fill_lanes();
}

void FreeWays::sort() {
  const auto bucket_of = [](const Contact& contact) {
    return std::min(static_cast<std::size_t>(contact.least / kBucket), kBuckets - 1);
  };
  std::array<std::uint32_t, kBuckets + 1> starts{};
  for (const auto& contact : unsorted_) ++starts[bucket_of(contact) + 1];
  for (std::size_t i = 0; i < kBuckets; ++i) starts[i + 1] += starts[i];
  contacts_.resize(unsorted_.size());
  for (const auto& contact : unsorted_) {
    const std::size_t bucket = bucket_of(contact);
    Contact& sorted = contacts_[starts[bucket]++];
    sorted = contact;
    sorted.least = kBucket * static_cast<double>(bucket);
  }
}

void FreeWays::fill_lanes() {
  starts_.fill(0);
  blocked_.resize(contacts_.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& contact = contacts_[i];
    const int low = lane_of((contact.y - contact.reach) / contact.power);
    const int high = lane_of((contact.y + contact.reach) / contact.power);
    blocked_[i] = {static_cast<std::uint8_t>(low), static_cast<std::uint8_t>(high)};
    for (int lane = low; lane <= high; ++lane) ++starts_[static_cast<std::size_t>(lane) + 1];
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane) starts_[lane + 1] += starts_[lane];
  lists_.resize(starts_[kLanes]);
  std::array<std::uint32_t, kLanes + 1> next = starts_;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    for (std::size_t lane = blocked_[i][0]; lane <= blocked_[i][1]; ++lane) {
      lists_[next[lane]++] = static_cast<std::uint32_t>(i);
    }
  }
}

void FreeWays::along(std::span<const double> curvatures, std::span<double> ways) {
  if (stands_) {
    std::fill(ways.begin(), ways.end(), 0.0);
    return;
  }
  std::array<std::uint32_t, kLanes + 1> starts{};
  lanes_.resize(curvatures.size());
  asked_.resize(curvatures.size());
  for (std::size_t i = 0; i < curvatures.size(); ++i) {
    lanes_[i] = static_cast<std::uint8_t>(lane_of(curvatures[i]));
    ++starts[lanes_[i] + 1U];
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane) starts[lane + 1] += starts[lane];
  std::array<std::uint32_t, kLanes + 1> next = starts;
  for (std::size_t i = 0; i < curvatures.size(); ++i) asked_[next[lanes_[i]]++] = static_cast<std::uint32_t>(i);

  constexpr std::size_t kArcs = VelocityKernels::kLanes;
  std::array<double, kArcs> arcs;
  std::array<double, kArcs> free;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::span<const std::uint32_t> order{lists_.data() + starts_[lane], starts_[lane + 1] - starts_[lane]};
    for (std::uint32_t first = starts[lane]; first < starts[lane + 1]; first += kArcs) {
      const std::size_t count = std::min<std::size_t>(kArcs, starts[lane + 1] - first);
      for (std::size_t i = 0; i < kArcs; ++i) {
        arcs[i] = std::clamp(curvatures[asked_[first + std::min(i, count - 1)]], -kMaxCurvature, kMaxCurvature);
      }
      kernels_.free_ways(contacts_.data(), order, arcs.data(), kHorizon, free.data());
      for (std::size_t i = 0; i < count; ++i) ways[asked_[first + i]] = free[i];
    }
  }
}

}  // namespace docent::collision_avoidance
