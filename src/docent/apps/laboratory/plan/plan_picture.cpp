#include "docent/apps/laboratory/plan/plan_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "docent/pictures/map_picture.h"

namespace docent::apps::plan_command {
namespace {

constexpr double kKnown = 0.25;  // [m]
constexpr double kGoal = 6.0;    // [points] diameter
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// Entropy [nat] that one scan takes from a robot which knows its place to kKnown.
double told(const planning::PoseInformation& place, double heading_scale) {
  double nats = 0.0;
  for (const double eigenvalue : place.eigenvalues(heading_scale))
    nats += 0.5 * std::log1p(kKnown * kKnown * eigenvalue);
  return nats;
}

/// Pale for nothing, dark for the most.
pictures::Color shade(double share) { return pictures::with_alpha(pictures::heat(share), 170); }

void draw_information(pictures::Axes& axes, const planning::InformationMap& information, double heading_scale) {
  std::vector<float> nats;
  for (const planning::PoseInformation& place : information.places) {
    const double here = told(place, heading_scale);
    nats.push_back(here > 0.0 ? static_cast<float>(here) : kNothing);
  }
  double most = 0.0;
  for (const float value : nats) most = value > most ? static_cast<double>(value) : most;
  if (most <= 0.0) return;
  const auto color = [most](double value) { return shade(0.75 * value / most); };
  pictures::draw_cells(axes, information.frame, nats,
                       [color](float value) { return color(static_cast<double>(value)); });
  axes.set_color_bar({"information of a scan at the place [nat]", color, 0.0, most, false});
}

void draw_values(pictures::Axes& axes, const planning::ValueIteration& values) {
  const GridFrame& frame = values.frame();
  std::vector<float> costs(frame.size(), kNothing);
  double most = 1e-6;
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const CellIndex cell{column, row};
      if (values.value(cell) >= planning::ValueIteration::kClosed ||
          values.cost(cell) >= planning::ValueIteration::kClosed)
        continue;
      costs[frame.index(cell)] = values.value(cell);
      most = std::max(most, static_cast<double>(values.value(cell)));
    }
  }
  const auto color = [most](double value) { return shade(value / most); };
  pictures::draw_cells(axes, frame, costs, [color](float value) { return color(static_cast<double>(value)); });
  axes.set_color_bar({"cost to the goal [m of free floor]", color, 0.0, most, false});
}

}  // namespace

pictures::Figure draw_plan(const OccupancyGrid& map, const std::vector<DrawnWay>& ways,
                           const std::vector<Point2>& goals, double radius, const PlanGround& ground) {
  pictures::Figure figure{""};
  pictures::Axes& axes = figure.add(pictures::Axes::metres(map.frame));
  pictures::draw_map(axes, map);
  if (ground.information != nullptr) {
    draw_information(axes, *ground.information, ground.heading_scale);
  } else if (ground.values != nullptr) {
    draw_values(axes, *ground.values);
  }
  pictures::add_map_legend(figure);
  for (const DrawnWay& way : ways) {
    if (way.points.size() < 2) continue;
    pictures::draw_path(axes, way.points, 3.0, pictures::colors::kWhite);
    pictures::draw_path(axes, way.points, 1.8, way.color);
    std::array<char, 32> length{};
    std::snprintf(length.data(), length.size(), " way, %.1f m", way.length);
    figure.add_legend(pictures::legend_line(way.name + length.data(), 1.8, way.color));
  }
  if (ways.empty() || ways.front().points.size() < 2) return figure;
  const Point2 from = ways.front().points[0];
  pictures::draw_robot(axes, {from.x, from.y, direction(from, ways.front().points[1])}, radius, pictures::distinct(1));
  pictures::draw_points(axes, goals, kGoal, pictures::distinct(2));
  figure.add_legend(pictures::legend_disc("start", kGoal, pictures::distinct(1)));
  figure.add_legend(pictures::legend_disc("goal", kGoal, pictures::distinct(2)));
  return figure;
}

}  // namespace docent::apps::plan_command
