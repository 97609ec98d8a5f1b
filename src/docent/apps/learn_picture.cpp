#include "docent/apps/learn_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "docent/base/random.h"
#include "docent/pictures/drawing.h"
#include "docent/pictures/map_picture.h"
#include "docent/pictures/text.h"
#include "docent/sensor_models/proximity_model.h"

namespace docent {

namespace {

constexpr int kPanel = 380;  // [pixels], a square
constexpr int kMargin = 46;
constexpr int kCut = 200;  // height of a cut

/// Densities over expected (right) and measured (up) range, coloured over three decades.
template <class Density>
void draw_panel(Image& image, Point2 top_left, const RangeBins& bins, const std::string& title, Density density) {
  const double scale = kPanel / bins.max_range();
  for (int x = 0; x < kPanel; ++x) {
    const int expected = bins.bin((x + 0.5) / scale);
    for (int y = 0; y < kPanel; ++y) {
      const int measured = bins.bin((kPanel - y - 0.5) / scale);
      const double value = density(measured, expected);  // [1/m]
      const double shade = value > 0.0 ? 1.0 + std::log10(value / 3.0) / 3.0 : 0.0;
      if (shade > 0.0)
        image.set(static_cast<int>(top_left.x) + x, static_cast<int>(top_left.y) + y, heat(std::min(shade, 1.0)));
    }
  }
  const Point2 bottom_right = top_left + Point2{kPanel, kPanel};
  const std::array<Point2, 4> frame{top_left, {bottom_right.x, top_left.y}, bottom_right, {top_left.x, bottom_right.y}};
  draw_polygon(image, frame, 1.0, colors::kInk);
  draw_text(image, top_left + Point2{0.0, -15.0}, title, colors::kInk);
  draw_text(image, {top_left.x, bottom_right.y + 18.0}, "expected [m] to the right, measured [m] up", colors::kGrey);
  const double step = bins.max_range() > 15.0 ? 5.0 : bins.max_range() > 6.0 ? 2.0 : 1.0;
  for (double range = 0.0; range <= bins.max_range() + 1e-9; range += step) {
    char label[16];
    std::snprintf(label, sizeof label, "%.0f", range);
    draw_text(image, {top_left.x + scale * range - 3.0, bottom_right.y + 4.0}, label, colors::kInk);
    draw_text(image, {top_left.x - 18.0, bottom_right.y - scale * range - 5.0}, label, colors::kInk);
  }
}

double width(const RangeBins& bins, int measured) { return bins.lower_edge(measured + 1) - bins.lower_edge(measured); }

/// The expected bins around `range` whose readings make a cut.
struct Cut {
  int first = 0, last = 0;
};
Cut cut_at(const RangeBins& bins, double range) {
  const int middle = bins.bin(range);
  return {std::max(middle - 2, 0), std::min(middle + 2, kNoReturn - 1)};
}

void draw_cut(Image& image, Point2 top_left, int length, const ReadingCounts& readings, double range,
              const ProximityModel& before, const ProximityModel& learned) {
  const RangeBins& bins = readings.bins();
  const Cut cut = cut_at(bins, range);
  std::array<double, kRangeBins> counted{};
  double all = 0.0;
  for (int expected = cut.first; expected <= cut.last; ++expected)
    for (int measured = 0; measured < kRangeBins; ++measured) {
      counted[static_cast<std::size_t>(measured)] += static_cast<double>(readings.at(measured, expected));
      all += static_cast<double>(readings.at(measured, expected));
    }
  const auto model_density = [&](const ProximityModel& model, int measured) {
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
  for (int measured = 0; measured < kNoReturn; ++measured) {
    if (all > 0.0) most = std::max(most, counted[static_cast<std::size_t>(measured)] / all / width(bins, measured));
    most = std::max(most, model_density(learned, measured));
  }
  // The square root shows the readings in front of the wall beside the peak.
  const auto height = [&](double density) { return kCut * std::sqrt(std::min(density / most, 1.0)); };
  const auto right = [&](double at) { return top_left.x + length * at / bins.max_range(); };
  const double bottom = top_left.y + kCut;
  std::vector<Point2> old_line;
  std::vector<Point2> new_line;
  for (int measured = 0; measured < kNoReturn; ++measured) {
    const double low = right(bins.lower_edge(measured));
    const double high = right(bins.lower_edge(measured + 1));
    if (all > 0.0) {
      const double density = counted[static_cast<std::size_t>(measured)] / all / width(bins, measured);
      fill_rectangle(image, {low, bottom - height(density)}, {high, bottom}, {200, 200, 205});
    }
    old_line.push_back({0.5 * (low + high), bottom - height(model_density(before, measured))});
    new_line.push_back({0.5 * (low + high), bottom - height(model_density(learned, measured))});
  }
  draw_polyline(image, old_line, 1.5, colors::kOrange);
  draw_polyline(image, new_line, 1.8, colors::kBlue);
  draw_line(image, {top_left.x, bottom}, {top_left.x + length, bottom}, 1.0, colors::kInk);
  char title[120];
  std::snprintf(title, sizeof title, "expected %.1f m: %.0f readings", range, all);
  draw_text(image, top_left + Point2{0.0, -15.0}, title, colors::kInk);
}

/// The ranges that cut the readings with a wall in sight into four parts of a size.
std::array<double, 3> cuts_of(const ReadingCounts& readings) {
  double all = 0.0;
  for (int expected = 0; expected < kNoReturn; ++expected) all += static_cast<double>(readings.expected(expected));
  std::array<double, 3> cuts{0.25, 0.5, 0.75};
  for (double& cut : cuts) {
    double left = cut * all;
    int expected = 0;
    while (expected < kNoReturn - 1 && (left -= static_cast<double>(readings.expected(expected))) > 0.0) ++expected;
    cut = readings.bins().centre(expected);
  }
  return cuts;
}

/// Ends of many drives of `way` [m]: half a corridor of 40 m ahead, then to the left.
std::vector<Point2> ends_of(const OdometryModelParams& params, double way, Rng rng) {
  constexpr int kDrives = 3000;
  constexpr double kStep = 0.25;
  std::vector<Point2> ends;
  for (int n = 0; n < kDrives; ++n) {
    Pose2 pose;
    for (double driven = 0.0; driven < way - 1e-9; driven += kStep) {
      const bool corner = std::abs(driven - 40.0) < 1e-9;
      const Pose2 step{kStep, 0.0, corner ? Angle::degrees(90.0) : Angle{}};
      const MotionNoise noise = motion_noise(params, step);
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

Image draw_sensor_model(const ReadingCounts& readings, const ProximityModelParams& before,
                        const ProximityModelParams& learned) {
  const ProximityModel old_model{before};
  const ProximityModel new_model{learned};
  const RangeBins& bins = readings.bins();
  Image image{2 * kPanel + 3 * kMargin, kPanel + 3 * (kCut + kMargin) + 3 * kMargin};
  draw_panel(image, {kMargin, kMargin}, bins, "P(measured | expected), counted", [&](int measured, int expected) {
    const auto all = static_cast<double>(readings.expected(expected));
    return all > 0.0 ? static_cast<double>(readings.at(measured, expected)) / all / width(bins, measured) : 0.0;
  });
  draw_panel(
      image, {2.0 * kMargin + kPanel, kMargin}, bins, "P(measured | expected), learned",
      [&](int measured, int expected) { return new_model.probability(measured, expected) / width(bins, measured); });
  double top = kPanel + 3.0 * kMargin;
  for (const double range : cuts_of(readings)) {
    draw_cut(image, {kMargin, top}, 2 * kPanel + kMargin, readings, range, old_model, new_model);
    top += kCut + kMargin;
  }
  draw_text(image, {kMargin, top - kMargin + 8.0},
            "bars: readings   orange: before   blue: learned   (square root scale)", colors::kInk);
  return image;
}

Image draw_motion_model(const OdometryModelParams& before, const OdometryModelParams& learned, std::uint64_t seed) {
  const MapView view{{-5.0, -22.0}, {75.0, 55.0}, 7.0};
  Image image{2 * view.width() + kMargin, view.height()};
  int left = 0;
  for (const auto& [params, title] : {std::pair{&before, "before"}, std::pair{&learned, "learned"}}) {
    Image half{view.width(), view.height()};
    const std::array<Point2, 3> way{Point2{0.0, 0.0}, Point2{40.0, 0.0}, Point2{40.0, 40.0}};
    draw_path(half, view, way, 1.0, colors::kGrey);
    const Rng rng{seed};
    draw_points(half, view, ends_of(*params, 40.0, rng.stream("40")), 2.0, with_alpha(colors::kBlue, 90));
    draw_points(half, view, ends_of(*params, 80.0, rng.stream("80")), 2.0, with_alpha(colors::kRed, 90));
    draw_text(half, {8.0, 8.0}, std::string{title} + ": after 40 m (blue) and 80 m (red)", colors::kInk);
    image.paste(half, left, 0);
    left += view.width() + kMargin;
  }
  return image;
}

}  // namespace docent
