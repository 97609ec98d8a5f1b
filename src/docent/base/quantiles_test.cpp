#include "docent/base/quantiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "docent/base/random.h"

namespace docent {
namespace {

TEST(Quantiles, LieWithinTheirErrorOfTheSortedValues) {
  Rng rng{7};
  for (const double spread : {0.1, 1.0, 4.0}) {
    Quantiles quantiles;
    std::vector<double> values;
    for (int i = 0; i < 20000; ++i) {
      values.push_back(std::exp(spread * rng.normal()));
      quantiles.add(values.back());
    }
    std::sort(values.begin(), values.end());
    for (const double share : {0.0, 0.01, 0.5, 0.9, 0.99, 1.0}) {
      const double exact = values[static_cast<std::size_t>(share * 19999.0)];
      EXPECT_NEAR(quantiles.at(share), exact, 1.0001 * Quantiles::kRelativeError * exact) << share << " of " << spread;
    }
  }
}

TEST(Quantiles, KnowZerosAndNothingAndWhatIsBeyondBounds) {
  Quantiles quantiles;
  EXPECT_EQ(quantiles.at(0.5), 0.0);
  for (const double value : {0.0, 0.0, -1.0, 5.0}) quantiles.add(value);
  EXPECT_EQ(quantiles.count(), 4U);
  EXPECT_EQ(quantiles.at(0.5), 0.0);
  EXPECT_NEAR(quantiles.at(1.0), 5.0, 0.05);
  quantiles.add(1e300);
  EXPECT_NEAR(quantiles.at(1.0), Quantiles::kMost, 0.01 * Quantiles::kMost);
}

}  // namespace
}  // namespace docent
