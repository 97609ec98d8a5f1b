#include "docent/apps/laboratory/attract/attract_picture.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "docent/apps/laboratory/attract/attract_run.h"

namespace docent::apps::attract_command {
namespace {

/// Pixels of a colour, nearly.
int count_of(const pictures::Image& image, pictures::Color color) {
  const auto near = [](int a, int b) { return std::abs(a - b) <= 2; };
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const pictures::Color pixel = image.at(x, y);
      count += static_cast<int>(near(pixel.red, color.red) && near(pixel.green, color.green) &&
                                near(pixel.blue, color.blue));
    }
  return count;
}

interaction::AttractionTrial trial_of(Mood face, SpeechAct speech, double reward) {
  return {Time{}, 0.08, {GazeStrategy::nearest, face, speech}, {0.2, 0.2, 0.2, 0.2, 0.2}, reward};
}

TEST(AttractPicture, TheBarOfAStyleIsAsHighAsItsReward) {
  const auto bars = [](double friendly, double upset) {
    const interaction::TrialMemory trials{trial_of(Mood::happy, SpeechAct::invite, friendly),
                                          trial_of(Mood::angry, SpeechAct::demand, upset)};
    const auto image = draw_styles(trials, {}, "none").raster();
    return std::pair{count_of(image, pictures::colors::kGreen), count_of(image, pictures::colors::kRed)};
  };
  const auto [green, red] = bars(2.0, 1.0);
  EXPECT_GT(red, 1000);
  EXPECT_NEAR(static_cast<double>(green) / red, 2.0, 0.2);
  const auto [less, more] = bars(1.0, 2.0);
  EXPECT_LT(less, more);
}

TEST(AttractPicture, AnEmptyMemoryIsDrawnToo) {
  const auto image = draw_styles({}, {}, "none").raster();
  EXPECT_EQ(count_of(image, pictures::colors::kRed), 0);
  EXPECT_GT(image.width(), 100);
}

}  // namespace
}  // namespace docent::apps::attract_command
