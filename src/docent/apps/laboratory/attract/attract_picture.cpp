#include "docent/apps/laboratory/attract/attract_picture.h"

#include <algorithm>
#include <array>
#include <optional>

#include "docent/interaction/attract/style_statistics.h"

namespace docent::apps::attract_command {
namespace {

// [points]
constexpr double kPanelWidth = 330.0;
constexpr double kPanelHeight = 130.0;
constexpr double kLine = 1.0;
constexpr double kWhisker = 4.0;
constexpr double kCountSize = 7.0;

constexpr int kEnough = 5;          // phases
constexpr double kBar = 0.36;       // half its width; styles stand 1 apart
constexpr double kHeadroom = 0.12;  // of the panel, above everything and below what is negative

/// From green for the friendly styles to red for the upset.
pictures::Color color_of(std::size_t style) {
  return pictures::mixed(pictures::colors::kGreen, pictures::colors::kRed,
                         static_cast<double>(style) / (interaction::kStyles - 1));
}

struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// Of all bars with nought, and of the intervals of styles with enough phases: that of two phases may be a hundred
/// times as long as any bar, and runs out of the panel.
Range range_of(const interaction::StyleStatistics& statistics) {
  Range range;
  for (const interaction::RewardStatistic& style : statistics) {
    const double half = style.count >= kEnough ? style.half_width.value_or(0.0) : 0.0;
    range.low = std::min(range.low, style.mean - half);
    range.high = std::max(range.high, style.mean + half);
  }
  const double span = std::max(range.high - range.low, 0.1);
  return {range.low - (range.low < 0.0 ? kHeadroom * span : 0.0), range.high + kHeadroom * span};
}

void draw_bar(pictures::Axes& axes, std::size_t i, const interaction::RewardStatistic& style) {
  const auto x = static_cast<double>(i);
  const Point2 top_left = axes.page({x - kBar, std::max(style.mean, 0.0)});
  const Point2 bottom_right = axes.page({x + kBar, std::min(style.mean, 0.0)});
  const double half = style.half_width.value_or(0.0);
  const Point2 upper = axes.page({x, style.mean + half});
  const Point2 lower = axes.page({x, style.mean - half});
  Point2 count_at = axes.page({x, std::max(style.mean + half, 0.0)});
  count_at.y = std::max(count_at.y, kCountSize + kWhisker);
  axes.add([=](pictures::Canvas& canvas) {
    canvas.fill_rectangle(top_left, bottom_right, color_of(i));
    if (half > 0.0) {
      canvas.draw_line(upper, lower, kLine, pictures::colors::kInk);
      for (const Point2 end : {upper, lower})
        canvas.draw_line({end.x - kWhisker, end.y}, {end.x + kWhisker, end.y}, kLine, pictures::colors::kInk);
    }
    canvas.draw_label({count_at.x, count_at.y - 2.0}, std::to_string(style.count),
                      {kCountSize, pictures::colors::kInk, {0.5, 1.0}}, pictures::colors::kWhite);
  });
}

pictures::Axes panel_of(const interaction::TrialMemory& trials, std::optional<interaction::CrowdClass> crowd,
                        const interaction::CrowdClassParams& crowds) {
  const interaction::StyleStatistics statistics = interaction::style_statistics(trials, crowd, crowds);
  const Range range = range_of(statistics);
  pictures::Axes axes{{-0.6, range.low}, {interaction::kStyles - 0.4, range.high}, kPanelWidth, kPanelHeight, "style",
                      "mean reward"};
  std::vector<pictures::Tick> names;
  for (std::size_t i = 0; i < statistics.size(); ++i)
    names.push_back({static_cast<double>(i), interaction::words_of(interaction::Style{}).at(i)});
  axes.set_x_ticks(std::move(names));
  axes.set_title(crowd ? std::string{to_text(*crowd)} + " crowd" : "all crowds");
  const Point2 left = axes.page({-0.6, 0.0});
  const Point2 right = axes.page({interaction::kStyles - 0.4, 0.0});
  axes.add([=](pictures::Canvas& canvas) { canvas.draw_line(left, right, kLine, pictures::colors::kGrey); });
  for (std::size_t i = 0; i < statistics.size(); ++i) draw_bar(axes, i, statistics.at(i));
  return axes;
}

}  // namespace

pictures::Figure draw_styles(const interaction::TrialMemory& trials, const interaction::CrowdClassParams& crowds,
                             const std::string& claim) {
  pictures::Figure figure{"Attracting people, " + std::to_string(trials.size()) + " phases; claim: " + claim};
  figure.add(panel_of(trials, std::nullopt, crowds));
  figure.add(panel_of(trials, interaction::CrowdClass::quiet, crowds));
  figure.add(panel_of(trials, interaction::CrowdClass::busy, crowds), true);
  figure.add(panel_of(trials, interaction::CrowdClass::packed, crowds));
  figure.add_legend(pictures::legend_area("mean of a style's phases, with their number", color_of(0)));
  figure.add_legend(pictures::legend_line("95 % interval of the mean", kLine, pictures::colors::kInk));
  return figure;
}

}  // namespace docent::apps::attract_command
