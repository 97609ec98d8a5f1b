#include "docent/mapping/mount_calibration/calibration_store.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "docent/base/files.h"
#include "docent/base/text.h"
#include "docent/base/yaml.h"

namespace docent::mapping {
namespace {

/// Nobody knows what was done to it meanwhile: x, y [m], heading [rad], delay [s], scales, veer.
constexpr std::array<double, kMountUnknowns> kOvernight{0.01, 0.01, 0.0087, 0.01, 0.01, 0.01, 0.01};
constexpr double kMost = 1e3;
constexpr std::size_t kMostPairs = 1000;

struct StoredScanner {
  std::string name;
  std::vector<double> nominal;  // x, y [m], heading [rad]
  std::vector<double> found;    // in the order of MountUnknown
  std::vector<double> sigma;    // likewise
  std::int64_t pairs = 0;
  template <class V>
  void visit(V& v) {
    v("name", name);
    v("nominal", nominal);
    v("found", found);
    v("sigma", sigma);
    v("pairs", pairs);
  }
};

struct Stored {
  std::vector<StoredScanner> scanners;
  template <class V>
  void visit(V& v) {
    v("scanners", scanners);
  }
};

std::array<double, 3> numbers_of(const Pose2& pose) { return {pose.x, pose.y, pose.theta.radians()}; }

std::array<double, kMountUnknowns> numbers_of(const MountState& state) {
  return {state.base_from_sensor.x,
          state.base_from_sensor.y,
          state.base_from_sensor.theta.radians(),
          state.delay,
          state.way_scale,
          state.turn_scale,
          state.veer};
}

bool are_fit(const std::vector<double>& values, std::size_t count) {
  return values.size() == count && std::all_of(values.begin(), values.end(), [](double value) {
           return std::isfinite(value) && std::abs(value) < kMost;
         });
}

std::optional<RememberedMount> remembered(const StoredScanner& stored, const NominalScanner& nominal) {
  const auto expected = numbers_of(nominal.base_from_sensor);
  if (stored.name != nominal.name || !are_fit(stored.nominal, 3) || !are_fit(stored.found, kMountUnknowns) ||
      !are_fit(stored.sigma, kMountUnknowns) || stored.pairs < 1)
    return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(stored.nominal[i] - expected[i]) > 1e-6) return std::nullopt;
  RememberedMount mount;
  MountState& state = mount.estimate.state;
  const auto& f = stored.found;
  state = {{f[0], f[1], Angle::radians(f[2])}, f[3], f[4], f[5], f[6]};
  for (std::size_t i = 0; i < kMountUnknowns; ++i) {
    const double sigma = std::max(std::abs(stored.sigma[i]), kOvernight[i]);
    mount.estimate.covariance(static_cast<int>(i), static_cast<int>(i)) = sigma * sigma;
  }
  mount.pairs = std::min(static_cast<std::size_t>(stored.pairs), kMostPairs);
  return mount;
}

}  // namespace

std::optional<std::vector<RememberedMount>> CalibrationStore::load(std::span<const NominalScanner> nominal) const {
  const auto file = YamlFile::load(path_);
  if (!file) return std::nullopt;
  Stored stored;
  if (!read_yaml(*file, file->root(), stored) || stored.scanners.size() != nominal.size()) return std::nullopt;
  std::vector<RememberedMount> mounts;
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    auto mount = remembered(stored.scanners[i], nominal[i]);
    if (!mount) return std::nullopt;
    mounts.push_back(std::move(*mount));
  }
  return mounts;
}

Result<void> CalibrationStore::save(std::span<const NominalScanner> nominal,
                                    std::span<const CalibratedScanner> found) const {
  std::string text =
      "# What the scanners were found to be while the robot drove; remove it to begin anew.\nscanners:\n";
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    std::array<double, kMountUnknowns> sigma{};
    for (std::size_t k = 0; k < kMountUnknowns; ++k) sigma[k] = found[i].estimate.sigma(static_cast<MountUnknown>(k));
    text += "  - name: " + nominal[i].name + "\n    nominal: " + yaml_list(numbers_of(nominal[i].base_from_sensor)) +
            "\n    found: " + yaml_list(numbers_of(found[i].estimate.state)) + "\n    sigma: " + yaml_list(sigma) +
            "\n    pairs: " + std::to_string(found[i].pairs) + "\n";
  }
  return write_file_atomically(path_, text, Survives::process_death);
}

}  // namespace docent::mapping
