#include "docent/vision/lens/flat_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"

namespace docent::vision::flat_field_test {
namespace {

constexpr int kColumns = 160, kRows = 120;

Lens lens() { return Lens::make({.columns = kColumns, .rows = kRows, .centre_x = 82.0, .centre_y = 58.0}).value(); }

/// Patches of chance on grey, through a lens that loses light towards the rim.
std::vector<std::vector<std::uint8_t>> seen(int count, double loss) {
  std::vector<std::vector<std::uint8_t>> pictures;
  Rng rng{4};
  const double half = 0.5 * std::hypot(kColumns, kRows);
  for (int i = 0; i < count; ++i) {
    auto& bytes = pictures.emplace_back();
    const double gain = rng.uniform(0.6, 1.0);
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        const double r = std::hypot(column - 82.0, row - 58.0) / half;
        const double patch = (column / 20 + row / 20 + i) % 5 == 0 ? 0.5 : 0.8;
        bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0 * gain * patch * (1.0 - loss * r * r))));
      }
  }
  return pictures;
}

std::vector<std::span<const std::uint8_t>> views(const std::vector<std::vector<std::uint8_t>>& pictures) {
  std::vector<std::span<const std::uint8_t>> views;
  for (const auto& bytes : pictures) views.emplace_back(bytes);
  return views;
}

TEST(FlatField, FindsWhatTheLensLoses) {
  const auto pictures = seen(60, 0.3);
  const FlatField field = flat_field_of(views(pictures), lens());
  for (const double r : {0.0, 0.4, 0.8})
    EXPECT_NEAR(field.at(82.0 + r * field.half, 58.0), 1.0 - 0.3 * r * r, 0.02) << r;
  const auto even = flattened(pictures[0], kColumns, field);
  // Two places of one shade, in the middle and at the rim, are alike afterwards.
  const auto of = [&](const std::vector<std::uint8_t>& bytes, int column, int row) {
    return static_cast<double>(bytes[static_cast<std::size_t>(row * kColumns + column)]);
  };
  EXPECT_GT(of(pictures[0], 90, 50) / of(pictures[0], 5, 30), 1.15);
  EXPECT_NEAR(of(even, 90, 50) / of(even, 5, 30), 1.0, 0.03);
}

TEST(FlatField, LeavesEvenAndFewPicturesAlone) {
  const auto even = seen(60, 0.0), few = seen(10, 0.3);
  EXPECT_NEAR(flat_field_of(views(even), lens()).at(0.0, 0.0), 1.0, 0.02);
  EXPECT_EQ(flat_field_of(views(few), lens()).at(0.0, 0.0), 1.0);
  EXPECT_EQ(flat_field_of({}, lens()).at(0.0, 0.0), 1.0);
  std::vector<std::uint8_t> burnt(kColumns * kRows, 255);
  const std::vector<std::uint8_t> still = flattened(burnt, kColumns, {82.0, 58.0, 100.0, -0.3, 0.0});
  EXPECT_EQ(still, burnt) << "burnt out stays so";
}

}  // namespace
}  // namespace docent::vision::flat_field_test
