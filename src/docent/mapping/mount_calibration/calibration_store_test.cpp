#include "docent/mapping/mount_calibration/calibration_store.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/base/files.h"

namespace docent::mapping::calibration_store_test {
namespace {

class CalibrationStoreTest : public ::testing::Test {
 protected:
  ~CalibrationStoreTest() override { std::filesystem::remove(path); }
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("docent_calibration_" + std::to_string(getpid()) + ".yaml");
  CalibrationStore store{path};
  std::vector<NominalScanner> nominal{{"front", {0.1, 0.0, {}}}};
  std::vector<CalibratedScanner> found{1};
};

TEST_F(CalibrationStoreTest, GivesBackWhatItWasGiven) {
  EXPECT_FALSE(store.load(nominal));
  found[0].estimate.state = {{0.15, 0.01, Angle::degrees(7.0)}, 0.05, 1.01, 0.99, 0.001};
  found[0].estimate.covariance = 4e-4 * MountMatrix::Identity();
  found[0].pairs = 33;
  ASSERT_TRUE(store.save(nominal, found));
  const auto loaded = store.load(nominal);
  ASSERT_TRUE(loaded);
  EXPECT_NEAR(loaded->front().estimate.state.base_from_sensor.theta.degrees(), 7.0, 1e-6);
  EXPECT_NEAR(loaded->front().estimate.state.delay, 0.05, 1e-9);
  EXPECT_NEAR(loaded->front().estimate.sigma(kMountHeading), 0.02, 1e-9);
  EXPECT_EQ(loaded->front().pairs, 33U);
}

TEST_F(CalibrationStoreTest, BeginsAnewWithAnotherRobotYamlOrADamagedFile) {
  found[0].pairs = 33;
  found[0].estimate.covariance = MountMatrix::Identity();
  ASSERT_TRUE(store.save(nominal, found));
  auto other = nominal;
  other[0].base_from_sensor.x = 0.2;
  EXPECT_FALSE(store.load(other));
  for (const char* text :
       {"scanners: 3", "scanners: [{name: front, nominal: [0.1, 0], found: [], sigma: [], pairs: 1}]",
        "scanners: [{name: front, nominal: [.nan, 0, 0], found: [1], sigma: [1], pairs: 1}]", "{"}) {
    ASSERT_TRUE(write_file_atomically(path, text));
    EXPECT_FALSE(store.load(nominal)) << text;
  }
}

}  // namespace
}  // namespace docent::mapping::calibration_store_test
