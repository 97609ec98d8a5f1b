#include "docent/apps/plan_picture.h"

#include <algorithm>
#include <cmath>

#include "docent/pictures/drawing.h"
#include "docent/pictures/map_picture.h"
#include "docent/pictures/text.h"

namespace docent {
namespace {

constexpr double kKnown = 0.25;  // [m]

/// Entropy [nat] that one scan takes from a robot which knows its place to kKnown.
double told(const PoseInformation& place, double heading_scale) {
  double nats = 0.0;
  for (const double eigenvalue : place.eigenvalues(heading_scale))
    nats += 0.5 * std::log1p(kKnown * kKnown * eigenvalue);
  return nats;
}

void draw_information(Image& image, const MapView& view, const InformationMap& information, double heading_scale) {
  const GridFrame& frame = information.frame;
  std::vector<double> nats(frame.size(), 0.0);
  for (std::size_t i = 0; i < nats.size(); ++i) nats[i] = told(information.places[i], heading_scale);
  const double most = *std::max_element(nats.begin(), nats.end());
  if (most <= 0.0) return;
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const double share = nats[frame.index({column, row})] / most;
      if (share <= 0.0) continue;
      const Point2 centre = frame.centre({column, row});
      const double half = 0.5 * frame.resolution;
      fill_rectangle(image, view.pixel({centre.x - half, centre.y + half}),
                     view.pixel({centre.x + half, centre.y - half}), with_alpha(heat(0.75 * share), 170));
    }
  }
}

void draw_values(Image& image, const MapView& view, const ValueIteration& values) {
  const GridFrame& frame = values.frame();
  const auto for_cells = [&](const auto& work) {
    for (int row = 0; row < frame.rows; ++row) {
      for (int column = 0; column < frame.columns; ++column) {
        const CellIndex cell{column, row};
        if (values.value(cell) < ValueIteration::kClosed && values.cost(cell) < ValueIteration::kClosed) work(cell);
      }
    }
  };
  float most = 1e-6F;
  for_cells([&](CellIndex cell) { most = std::max(most, values.value(cell)); });
  const double half = 0.5 * frame.resolution;
  for_cells([&](CellIndex cell) {
    const Point2 centre = frame.centre(cell);
    const Color color = heat(static_cast<double>(values.value(cell) / most));
    fill_rectangle(image, view.pixel({centre.x - half, centre.y + half}),
                   view.pixel({centre.x + half, centre.y - half}), with_alpha(color, 170));
  });
}

}  // namespace

Image draw_plan(const OccupancyGrid& map, const std::vector<DrawnWay>& ways, const std::vector<Point2>& goals,
                double radius, const PlanGround& ground) {
  const MapView view = MapView::whole(map.frame);
  Image image = draw_map(map, view);
  if (ground.information != nullptr) {
    draw_information(image, view, *ground.information, ground.heading_scale);
  } else if (ground.values != nullptr) {
    draw_values(image, view, *ground.values);
  }
  double line = 8.0;
  for (const DrawnWay& way : ways) {
    if (way.points.size() < 2) continue;
    draw_path(image, view, way.points, 5.0, colors::kWhite);
    draw_path(image, view, way.points, 3.0, way.color);
    if (ways.size() > 1) draw_label(image, {8.0, line}, way.name, way.color, colors::kWhite, 2);
    line += text_height(2) + 6;
  }
  if (ways.empty() || ways.front().points.size() < 2) return image;
  const Point2 from = ways.front().points[0];
  draw_robot(image, view, {from.x, from.y, direction(from, ways.front().points[1])}, radius, distinct(1));
  for (const Point2& goal : goals) fill_disc(image, view.pixel(goal), 5.0, distinct(2));
  return image;
}

}  // namespace docent
