#include "docent/apps/laboratory/train_sonar/sonar_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "docent/pictures/map_picture.h"

namespace docent::apps::train_sonar_command {
namespace {

/// What a model says of all cells about one view.
OccupancyGrid local_map(const SonarPlace& place, const SonarModel& model, double reach) {
  constexpr double kFine = 0.05;  // [m]
  const int cells = static_cast<int>(std::ceil(2.0 * reach / kFine));
  OccupancyGrid grid{{cells, cells, kFine, {-reach, -reach}}, {}};
  std::vector<Point2> at;
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) at.push_back(grid.frame.centre({column, row}));
  }
  for (const double p : model(place.view, at)) grid.cells.push_back(static_cast<std::int8_t>(std::lround(100.0 * p)));
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (norm(at[i]) > reach) grid.cells[i] = OccupancyGrid::kUnknown;
  }
  return grid;
}

OccupancyGrid grid_of(const SonarMap& map) {
  OccupancyGrid grid{map.frame, {}};
  for (std::size_t i = 0; i < map.log_odds.size(); ++i) {
    const double p = 1.0 / (1.0 + std::exp(-map.log_odds[i]));
    grid.cells.push_back(map.seen[i] ? static_cast<std::int8_t>(std::lround(100.0 * p)) : OccupancyGrid::kUnknown);
  }
  return grid;
}

pictures::Color grey_of(double percent) {
  const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - percent / 100.0)));
  return {grey, grey, grey, 255};
}

void draw_probabilities(pictures::Axes& axes, const OccupancyGrid& grid, const char* title) {
  std::vector<float> values;
  for (const std::int8_t cell : grid.cells) {
    values.push_back(cell < 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(cell));
  }
  pictures::draw_cells(axes, grid.frame, values, [](float percent) { return grey_of(static_cast<double>(percent)); });
  axes.set_title(title);
}

}  // namespace

pictures::Figure draw_sonar_models(const SonarWorld& world, std::uint64_t seed, const SonarModel& network,
                                   double network_prior, const SonarModel& cones, double cones_prior, double reach) {
  const std::vector<SonarPlace> places = world.places(150, seed);
  const SonarPlace& view = places.front();
  pictures::Figure figure{"Sonars: what a model makes of one view, and of " + std::to_string(places.size())};
  for (const auto& [model, title] : {std::pair{&network, "network"}, std::pair{&cones, "cones"}}) {
    const OccupancyGrid grid = local_map(view, *model, reach);
    pictures::Axes& axes = figure.add(pictures::Axes::metres(grid.frame));
    draw_probabilities(axes, grid, title);
    std::vector<Point2> echoes;
    for (int i = 0; i < ring_of_data_sheet().count; ++i) {
      const double range = view.view.ranges[static_cast<std::size_t>(i)];
      if (range + ring_of_data_sheet().radius < reach) {
        echoes.push_back((range + ring_of_data_sheet().radius) * unit(ring_of_data_sheet().bearing(i)));
      }
    }
    pictures::draw_points(axes, echoes, 4.0, pictures::distinct(0));
  }
  const auto add_map = [&](const SonarModel& model, double prior, const char* title, bool in_new_row) {
    const OccupancyGrid grid = grid_of(integrated(world, places, model, prior, reach));
    pictures::Axes& axes = figure.add(pictures::Axes::metres(grid.frame), in_new_row);
    draw_probabilities(axes, grid, title);
    axes.set_color_bar({"P(occupied) [%]", [](double percent) { return grey_of(percent); }, 0.0, 100.0});
  };
  add_map(network, network_prior, "network", true);
  add_map(cones, cones_prior, "cones", false);
  figure.add_legend(pictures::legend_disc("echo", 4.0, pictures::distinct(0)));
  return figure;
}

}  // namespace docent::apps::train_sonar_command
