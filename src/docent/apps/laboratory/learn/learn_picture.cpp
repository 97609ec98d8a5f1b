#include "docent/apps/laboratory/learn/learn_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "docent/base/random.h"
#include "docent/pictures/map_picture.h"
#include "docent/sensor_models/proximity_model.h"

namespace docent::apps::learn_command {

namespace {

// [points]
constexpr double kPanel = 190.0;
constexpr double kCutWidth = 500.0;
constexpr double kCutHeight = 100.0;
constexpr double kHeadroom = 1.05;  // of the axes above the highest bar
constexpr double kLine = 1.0;
constexpr double kDot = 1.0;

constexpr double kMostDensity = 3.0;  // [1/m] of the colours, over three decades
constexpr double kLeastDensity = 3e-3;

constexpr pictures::Color kBars{200, 200, 205};
constexpr pictures::Color kBefore = pictures::colors::kOrange;
constexpr pictures::Color kLearned = pictures::colors::kBlue;

pictures::Color color_of_density(double value) { return pictures::heat(1.0 + std::log10(value / kMostDensity) / 3.0); }

/// Densities [1/m] of the measured range (up) for each expected one (to the right).
template <class Density>
pictures::Axes density_axes(const sensor_models::RangeBins& bins, const std::string& title, Density density) {
  pictures::Axes axes{{0.0, 0.0},          {bins.max_range(), bins.max_range()}, kPanel, kPanel, "expected range [m]",
                      "measured range [m]"};
  axes.set_title(title);
  const int pixels = static_cast<int>(kPanel * pictures::kPixelsPerPoint);
  const GridFrame frame{pixels, pixels, bins.max_range() / pixels, {0.0, 0.0}};
  std::vector<float> values;
  for (int row = 0; row < pixels; ++row) {
    for (int column = 0; column < pixels; ++column) {
      const Point2 centre = frame.centre({column, row});
      const double value = density(bins.bin(centre.y), bins.bin(centre.x));
      values.push_back(value > kLeastDensity ? static_cast<float>(value) : std::numeric_limits<float>::quiet_NaN());
    }
  }
  pictures::draw_cells(axes, frame, values, [](float value) { return color_of_density(static_cast<double>(value)); });
  return axes;
}

double width(const sensor_models::RangeBins& bins, int measured) {
  return bins.lower_edge(measured + 1) - bins.lower_edge(measured);
}

/// The expected bins around `range` whose readings make a cut.
struct Cut {
  int first = 0, last = 0;
};
Cut cut_at(const sensor_models::RangeBins& bins, double range) {
  const int middle = bins.bin(range);
  return {std::max(middle - 2, 0), std::min(middle + 2, sensor_models::kNoReturn - 1)};
}

/// Densities [1/m] over the measured range where one is expected. The square root shows the readings in front of the
/// wall beside the peak.
pictures::Axes cut_axes(const sensor_models::ReadingCounts& readings, double range,
                        const sensor_models::ProximityModel& before, const sensor_models::ProximityModel& learned) {
  const sensor_models::RangeBins& bins = readings.bins();
  const Cut cut = cut_at(bins, range);
  std::array<double, sensor_models::kRangeBins> counted{};
  double all = 0.0;
  for (int expected = cut.first; expected <= cut.last; ++expected)
    for (int measured = 0; measured < sensor_models::kRangeBins; ++measured) {
      counted[static_cast<std::size_t>(measured)] += static_cast<double>(readings.at(measured, expected));
      all += static_cast<double>(readings.at(measured, expected));
    }
  const auto model_density = [&](const sensor_models::ProximityModel& model, int measured) {
    double sum = 0.0;
    double weight = 0.0;
    for (int expected = cut.first; expected <= cut.last; ++expected) {
      const double share = all > 0.0 ? static_cast<double>(readings.expected(expected)) / all : 1.0;
      sum += share * model.probability(measured, expected);
      weight += share;
    }
    return sum / weight / width(bins, measured);
  };
  double most = 0.1;
  for (int measured = 0; measured < sensor_models::kNoReturn; ++measured) {
    if (all > 0.0) most = std::max(most, counted[static_cast<std::size_t>(measured)] / all / width(bins, measured));
    most = std::max(most, model_density(learned, measured));
  }
  pictures::Axes axes{
      {0.0, 0.0},     {bins.max_range(), kHeadroom * std::sqrt(most)}, kCutWidth, kCutHeight, "measured range [m]",
      "density [1/m]"};
  std::vector<pictures::Tick> ticks;
  for (const pictures::Tick& tick : pictures::round_ticks(0.0, most, 5))
    ticks.push_back({std::sqrt(tick.at), tick.label});
  axes.set_y_ticks(std::move(ticks));
  std::vector<Point2> old_line;
  std::vector<Point2> new_line;
  for (int measured = 0; measured < sensor_models::kNoReturn; ++measured) {
    const double low = bins.lower_edge(measured);
    const double high = bins.lower_edge(measured + 1);
    if (all > 0.0) {
      const double density = counted[static_cast<std::size_t>(measured)] / all / width(bins, measured);
      const Point2 top_left = axes.page({low, std::sqrt(density)});
      const Point2 bottom_right = axes.page({high, 0.0});
      axes.add([=](pictures::Canvas& canvas) { canvas.fill_rectangle(top_left, bottom_right, kBars); });
    }
    old_line.push_back({0.5 * (low + high), std::sqrt(model_density(before, measured))});
    new_line.push_back({0.5 * (low + high), std::sqrt(model_density(learned, measured))});
  }
  pictures::draw_path(axes, old_line, kLine, kBefore);
  pictures::draw_path(axes, new_line, kLine, kLearned);
  std::array<char, 120> title{};
  std::snprintf(title.data(), title.size(), "expected range %.1f m: %.0f readings (square root scale)", range, all);
  axes.set_title(title.data());
  return axes;
}

/// The ranges that cut the readings with a wall in sight into four parts of a size.
std::array<double, 3> cuts_of(const sensor_models::ReadingCounts& readings) {
  double all = 0.0;
  for (int expected = 0; expected < sensor_models::kNoReturn; ++expected)
    all += static_cast<double>(readings.expected(expected));
  std::array<double, 3> cuts{0.25, 0.5, 0.75};
  for (double& cut : cuts) {
    double left = cut * all;
    int expected = 0;
    while (expected < sensor_models::kNoReturn - 1 && (left -= static_cast<double>(readings.expected(expected))) > 0.0)
      ++expected;
    cut = readings.bins().centre(expected);
  }
  return cuts;
}

/// Ends of many drives of `way` [m]: half a corridor of 40 m ahead, then to the left.
std::vector<Point2> ends_of(const motion_models::OdometryModelParams& params, double way, Rng rng) {
  constexpr int kDrives = 3000;
  constexpr double kStep = 0.25;
  std::vector<Point2> ends;
  for (int n = 0; n < kDrives; ++n) {
    Pose2 pose;
    for (double driven = 0.0; driven < way - 1e-9; driven += kStep) {
      const bool corner = std::abs(driven - 40.0) < 1e-9;
      const Pose2 step{kStep, 0.0, corner ? Angle::degrees(90.0) : Angle{}};
      const motion_models::MotionNoise noise = motion_models::motion_noise(params, step);
      const double shift = std::sqrt(noise.position_variance);
      pose = pose * (corner ? Pose2{0.0, 0.0, step.theta} * Pose2{kStep, 0.0, {}} : step) *
             Pose2{rng.normal(0.0, shift), rng.normal(0.0, shift),
                   Angle::radians(rng.normal(0.0, std::sqrt(noise.heading_variance)))};
    }
    ends.push_back(pose.position());
  }
  return ends;
}

}  // namespace

pictures::Figure draw_sensor_model(const sensor_models::ReadingCounts& readings,
                                   const sensor_models::ProximityModelParams& before,
                                   const sensor_models::ProximityModelParams& learned, const std::string& sensor) {
  const sensor_models::ProximityModel old_model{before};
  const sensor_models::ProximityModel new_model{learned};
  const sensor_models::RangeBins& bins = readings.bins();
  pictures::Figure figure{"p(measured range | expected range) of the " + sensor};
  figure.add(density_axes(bins, "counted", [&](int measured, int expected) {
    const auto all = static_cast<double>(readings.expected(expected));
    return all > 0.0 ? static_cast<double>(readings.at(measured, expected)) / all / width(bins, measured) : 0.0;
  }));
  pictures::Axes& model = figure.add(density_axes(bins, "learned", [&](int measured, int expected) {
    return new_model.probability(measured, expected) / width(bins, measured);
  }));
  model.set_color_bar({"density [1/m]", color_of_density, kLeastDensity, kMostDensity, true});
  for (const double range : cuts_of(readings)) figure.add(cut_axes(readings, range, old_model, new_model), true);
  figure.add_legend(pictures::legend_area("readings", kBars));
  figure.add_legend(pictures::legend_line("model before", kLine, kBefore));
  figure.add_legend(pictures::legend_line("model learned", kLine, kLearned));
  return figure;
}

pictures::Figure draw_motion_model(const motion_models::OdometryModelParams& before,
                                   const motion_models::OdometryModelParams& learned, std::uint64_t seed) {
  constexpr pictures::Color kAfter40 = pictures::with_alpha(pictures::colors::kBlue, 120);
  constexpr pictures::Color kAfter80 = pictures::with_alpha(pictures::colors::kRed, 120);
  pictures::Figure figure{"Where the robot may be by odometry alone"};
  for (const auto& [params, title] : {std::pair{&before, "model before"}, std::pair{&learned, "model learned"}}) {
    pictures::Axes& axes = figure.add(pictures::Axes::metres({-5.0, -22.0}, {75.0, 55.0}, 280.0));
    axes.set_title(title);
    const std::array<Point2, 3> way{Point2{0.0, 0.0}, Point2{40.0, 0.0}, Point2{40.0, 40.0}};
    pictures::draw_path(axes, way, kLine, pictures::colors::kGrey);
    const Rng rng{seed};
    pictures::draw_points(axes, ends_of(*params, 40.0, rng.stream("40")), kDot, kAfter40);
    pictures::draw_points(axes, ends_of(*params, 80.0, rng.stream("80")), kDot, kAfter80);
  }
  figure.add_legend(pictures::legend_line("way as odometry has it", kLine, pictures::colors::kGrey));
  figure.add_legend(pictures::legend_disc("after 40 m", 4.0, kAfter40));
  figure.add_legend(pictures::legend_disc("after 80 m", 4.0, kAfter80));
  return figure;
}

}  // namespace docent::apps::learn_command
