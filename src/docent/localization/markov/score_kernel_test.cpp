#include "docent/localization/markov/score_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/localization/markov/testing.h"

namespace docent::localization {
namespace {

constexpr std::size_t kTile = RangeTable::kTile;
constexpr std::size_t kBlock = TileScorer::kBlock;

struct Lines {
  std::vector<TileScorer::Line> lines;
  [[nodiscard]] const std::uint8_t* data() const { return lines.front().bytes.data(); }
};
Lines any_tile(Rng& rng, std::size_t headings) {
  Lines tile{std::vector<TileScorer::Line>(headings)};
  for (auto& line : tile.lines)
    for (auto& value : line.bytes) value = static_cast<std::uint8_t>(rng.integer(0, 127));
  return tile;
}

/// What TileScorer promises, word for word.
std::vector<std::size_t> obvious(const std::uint8_t* tile, std::span<const BeamCosts> beams, std::size_t headings,
                                 std::size_t sectors, std::size_t cap, std::size_t place) {
  std::vector<std::size_t> costs(headings, 0);
  for (std::size_t h = 0; h < headings; ++h) {
    std::vector<std::size_t> of_sector(sectors, 0);
    for (const BeamCosts& beam : beams)
      of_sector[beam.direction * sectors / headings] +=
          beam.costs[tile[(h + beam.direction) % headings * kTile + place]];
    for (const std::size_t sum : of_sector) costs[h] += std::min(sum, cap);
  }
  return costs;
}

struct Case {
  std::size_t headings;
  int beams;
  std::size_t sectors;
  int cap;
};

void expect_right(const Case& c, InstructionSet set) {
  Rng rng{7};
  const Lines tile = any_tile(rng, c.headings);
  const auto beams = testing::any_beams(rng, c.beams, static_cast<int>(c.headings));
  const std::size_t blocks = (c.headings + kBlock - 1) / kBlock;
  std::vector<std::uint8_t> lanes{1, 8, 9, 10, 11, 12, 13, 14, 15, 16, 40, 63};
  std::vector<std::uint16_t> costs(lanes.size() * blocks * kBlock, 9);
  std::vector<std::uint16_t*> rows;
  for (std::size_t i = 0; i < lanes.size(); ++i) rows.push_back(costs.data() + i * blocks * kBlock);
  TileScorer scorer{beams, c.headings, c.sectors, static_cast<std::uint16_t>(c.cap), set};
  scorer.score(tile.data(), ~std::uint64_t{0}, lanes, rows);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const auto expected = obvious(tile.data(), beams, c.headings, c.sectors, static_cast<std::size_t>(c.cap), lanes[i]);
    for (std::size_t h = 0; h < c.headings; ++h) ASSERT_EQ(rows[i][h], expected[h]) << i << ' ' << h;
  }
}

class EverySet : public ::testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    const auto sets = instruction_sets();
    if (std::find(sets.begin(), sets.end(), GetParam()) == sets.end())
      GTEST_SKIP() << "not run: this processor has no " << name_of(GetParam());
  }
};
INSTANTIATE_TEST_SUITE_P(TileScorer, EverySet,
                         ::testing::Values(InstructionSet::plain, InstructionSet::avx2, InstructionSet::avx512),
                         [](const auto& test) { return std::string{name_of(test.param)}; });

TEST_P(EverySet, SumsWhatIsCappedInBytes) {
  for (const int cap : {1, 20, 32, 127, 128, 255}) {
    SCOPED_TRACE(cap);
    expect_right({180, 180, 12, cap}, GetParam());
  }
}

TEST_P(EverySet, SumsWhatNeedsSixteenBits) {
  for (const int cap : {256, 1000, 60000}) {
    SCOPED_TRACE(cap);
    expect_right({180, 179, 12, cap}, GetParam());
    expect_right({180, 61, 1, cap}, GetParam());
  }
}

TEST_P(EverySet, AnyNumberOfHeadingsAndBeams) {
  for (const std::size_t headings : {12U, 16U, 60U, 72U, 180U, 360U, 720U}) {
    SCOPED_TRACE(headings);
    for (const int beams : {0, 1, 2, 59, 60}) expect_right({headings, beams, 7, 100}, GetParam());
  }
}

TEST_P(EverySet, ScoresOnlyTheBlocksThatAreAsked) {
  Rng rng{3};
  const Lines tile = any_tile(rng, 180);
  const auto beams = testing::any_beams(rng, 1, 180);
  std::vector<std::uint16_t> costs(192, 999);
  std::uint16_t* const row = costs.data();
  const std::uint8_t lane = 5;
  TileScorer{beams, 180, 1, 200, GetParam()}.score(tile.data(), 0b100, {&lane, 1}, {&row, 1});
  for (std::size_t h = 0; h < costs.size(); ++h) {
    if (h / kBlock == 2) {
      EXPECT_LT(costs[h], 128);
    } else {
      EXPECT_EQ(costs[h], 999);
    }
  }
}

/// Some blocks of many beams, one sector or several, also across the end of the circle: what is scored is right, and
/// the rest is left alone.
TEST_P(EverySet, AnyBlocksOfAnyBeams) {
  Rng rng{11};
  constexpr std::size_t kHeadings = 180;
  const Lines tile = any_tile(rng, kHeadings);
  const auto beams = testing::any_beams(rng, 90, static_cast<int>(kHeadings));
  for (const std::size_t sectors : {1U, 5U, 12U}) {
    for (const std::uint64_t blocks : {0b1ULL, 0b100000000000ULL, 0b111000000111ULL, 0b011011110101ULL}) {
      for (const std::uint8_t lane : {std::uint8_t{3}, std::uint8_t{45}}) {
        SCOPED_TRACE(std::to_string(sectors) + ' ' + std::to_string(blocks) + ' ' + std::to_string(lane));
        std::vector<std::uint16_t> costs(192, 65535);
        std::uint16_t* const row = costs.data();
        TileScorer{beams, kHeadings, sectors, 250, GetParam()}.score(tile.data(), blocks, {&lane, 1}, {&row, 1});
        const auto expected = obvious(tile.data(), beams, kHeadings, sectors, 250, lane);
        for (std::size_t h = 0; h < kHeadings; ++h)
          ASSERT_EQ(costs[h], (blocks >> (h / kBlock) & 1U) != 0 ? expected[h] : 65535U) << h;
      }
    }
  }
}

}  // namespace
}  // namespace docent::localization
