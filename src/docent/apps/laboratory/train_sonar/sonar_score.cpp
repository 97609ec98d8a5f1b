#include "docent/apps/laboratory/train_sonar/sonar_score.h"

#include <algorithm>
#include <cmath>

namespace docent::apps::train_sonar_command {
namespace {

constexpr std::size_t kPlaces = 150;  // of a world: one each one or two square metres
constexpr std::size_t kCells = 60;    // about each, for single views
constexpr double kCell = 0.1;         // [m], of the map

}  // namespace

SonarModel by_network(const mapping::SonarNetwork& network) {
  return [&network](const mapping::SonarView& view, std::span<const Point2> places) {
    std::vector<mapping::SonarCell> cells;
    cells.reserve(places.size());
    for (const Point2 place : places) cells.push_back(sonar_cell(network.ring(), view, place));
    return network.probabilities(cells);
  };
}

SonarModel by_cones(const mapping::ConeModelParams& params) {
  return [params](const mapping::SonarView& view, std::span<const Point2> places) {
    std::vector<double> probabilities;
    for (const Point2 place : places) {
      probabilities.push_back(probability_by_cones(params, ring_of_data_sheet(), view, place));
    }
    return probabilities;
  };
}

SonarMap integrated(const SonarWorld& world, std::span<const SonarPlace> places, const SonarModel& model, double prior,
                    double reach) {
  constexpr double kLeast = 1e-3;  // no single view is surer
  const auto [low, high] = world.bounds();
  SonarMap map;
  map.frame = {static_cast<int>(std::ceil((high.x - low.x) / kCell)),
               static_cast<int>(std::ceil((high.y - low.y) / kCell)), kCell, low};
  map.log_odds.assign(map.frame.size(), 0.0);
  map.seen.assign(map.frame.size(), false);
  const double of_prior = std::log(prior / (1.0 - prior));
  const double inside = ring_of_data_sheet().radius;
  for (const SonarPlace& place : places) {
    const Pose2 base_from_world = inverse(place.world_from_base);
    const CellIndex centre = map.frame.cell_at(place.world_from_base.position());
    const int cells = static_cast<int>(std::ceil(reach / kCell));
    std::vector<Point2> at;
    std::vector<std::size_t> indices;
    for (int row = centre.row - cells; row <= centre.row + cells; ++row) {
      for (int column = centre.column - cells; column <= centre.column + cells; ++column) {
        if (!map.frame.holds({column, row})) continue;
        const Point2 seen = base_from_world * map.frame.centre({column, row});
        if (norm(seen) > reach || norm(seen) <= inside) continue;
        at.push_back(seen);
        indices.push_back(map.frame.index({column, row}));
      }
    }
    const std::vector<double> probabilities = model(place.view, at);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const double p = std::clamp(probabilities[i], kLeast, 1.0 - kLeast);
      map.log_odds[indices[i]] += std::log(p / (1.0 - p)) - of_prior;
      map.seen[indices[i]] = true;
    }
  }
  return map;
}

SonarScore score_sonar(const SonarWorld& world, std::uint64_t seed, const SonarModel& model, double prior,
                       double reach) {
  const std::vector<SonarPlace> places = world.places(kPlaces, seed);
  const SonarTrial trial = drawn_trial(world, places, kCells, reach, seed);
  SonarScore score;
  std::vector<double> probabilities;
  std::vector<bool> labels;
  for (std::size_t i = 0; i < trial.at.size();) {
    const std::size_t place = trial.of_place[i];
    std::vector<Point2> at;
    for (; i < trial.at.size() && trial.of_place[i] == place; ++i) {
      at.push_back(trial.at[i]);
      labels.push_back(trial.examples[i].is_occupied);
    }
    const std::vector<double> said = model(places[place].view, at);
    probabilities.insert(probabilities.end(), said.begin(), said.end());
  }
  score.examples = labels.size();
  score.cross_entropy = mapping::cross_entropy(probabilities, labels);
  score.roc_area = mapping::roc_area(probabilities, labels);

  const SonarMap map = integrated(world, places, model, prior, reach);
  std::vector<double> values;
  std::vector<bool> occupied;
  for (std::size_t i = 0; i < map.log_odds.size(); ++i) {
    if (!map.seen[i]) continue;
    const auto columns = static_cast<std::size_t>(map.frame.columns);
    values.push_back(map.log_odds[i]);
    occupied.push_back(
        world.is_occupied(map.frame.centre({static_cast<int>(i % columns), static_cast<int>(i / columns)})));
  }
  score.cells = values.size();
  score.map_roc_area = mapping::roc_area(values, occupied);
  return score;
}

}  // namespace docent::apps::train_sonar_command
