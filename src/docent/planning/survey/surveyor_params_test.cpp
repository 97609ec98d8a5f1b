#include "docent/planning/survey/surveyor_params.h"

#include <gtest/gtest.h>

#include <string>

namespace docent::planning::surveyor_params_test {
namespace {

std::string fault_of(const SurveyorParams& params) {
  const auto valid = params.validate();
  return valid ? "" : valid.error().message;
}

TEST(SurveyorParams, SaysWhichPartIsWrong) {
  EXPECT_EQ(fault_of({}), "");
  SurveyorParams params;
  params.least_sigma = 0.1;
  EXPECT_EQ(fault_of(params), "0 < least_sigma <= most_sigma must hold");
  params = {};
  params.sigma_heading = 0.0;
  EXPECT_EQ(fault_of(params), "sigma_heading must be > 0");
  params = {};
  params.stray_floor = -1.0;
  EXPECT_EQ(fault_of(params), "stray_floor must be >= 0");
  params = {};
  params.keyframes.way = 0.0;
  EXPECT_EQ(fault_of(params), "keyframes.way must be > 0 m");
  params = {};
  params.drive.horizon = 0.0;
  EXPECT_EQ(fault_of(params), "drive.horizon must be > 0 m");
  params = {};
  params.explorer.coarsening = 0;
  EXPECT_EQ(fault_of(params).rfind("explorer.", 0), 0U) << fault_of(params);
  params = {};
  params.mapping.chain.scans = 0;
  EXPECT_EQ(fault_of(params), "mapping.chain.scans must be > 0");
  params = {};
  params.map.resolution = 0.0;
  EXPECT_EQ(fault_of(params).rfind("map.", 0), 0U) << fault_of(params);
}

}  // namespace
}  // namespace docent::planning::surveyor_params_test
