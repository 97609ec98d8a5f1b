#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "docent/mapping/mount_calibration/mount_calibrator.h"

namespace docent::mapping {

/// What a robot remembers of its scanners over a new start.
struct RememberedMount {
  MountEstimate estimate;
  std::size_t pairs = 0;
};

/// Keeps what was found in a file, with what robot.yaml said then: another robot.yaml begins anew.
class CalibrationStore {
 public:
  explicit CalibrationStore(std::filesystem::path path) : path_{std::move(path)} {}

  /// [scanners], or none: nothing was found before, it is damaged, or robot.yaml has changed. Standard deviations are
  /// not below what a night may do to a mount.
  [[nodiscard]] std::optional<std::vector<RememberedMount>> load(std::span<const NominalScanner> nominal) const;
  [[nodiscard]] Result<void> save(std::span<const NominalScanner> nominal,
                                  std::span<const CalibratedScanner> found) const;

 private:
  std::filesystem::path path_;
};

}  // namespace docent::mapping
