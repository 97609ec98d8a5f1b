#include "docent/mapping/expectation_maximization/evidence_map.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace docent::mapping {
namespace {

/// The cell whose centre is nearest: cells of PoseCells.
CellIndex cell_of(Point2 at, double cell) {
  return {static_cast<int>(std::lround(at.x / cell)), static_cast<int>(std::lround(at.y / cell))};
}

}  // namespace

EvidenceMap::EvidenceMap(std::span<const SeenPlace> places, std::span<const PoseBox> beliefs) {
  const double cell = beliefs.front().cells().cell;
  CellIndex low{1 << 30, 1 << 30};
  CellIndex high{-(1 << 30), -(1 << 30)};
  for (std::size_t t = 0; t < places.size(); ++t) {
    double reach = 0.0;
    for (const Point2 p : places[t].occupied) reach = std::max(reach, norm(p));
    const int border = static_cast<int>(std::ceil(reach / cell)) + 1;
    for (const std::size_t corner : {std::size_t{0}, beliefs[t].size() - 1}) {
      const CellIndex at = cell_of(beliefs[t].pose(corner).position(), cell);
      low = {std::min(low.column, at.column - border), std::min(low.row, at.row - border)};
      high = {std::max(high.column, at.column + border), std::max(high.row, at.row + border)};
    }
  }
  first_ = low;
  frame_ = {
      high.column - low.column + 1, high.row - low.row + 1, cell, {(low.column - 0.5) * cell, (low.row - 0.5) * cell}};
  occupied_.assign(frame_.size(), 0.0F);
  free_.assign(frame_.size(), 0.0F);
  for (std::size_t t = 0; t < places.size(); ++t) add(places[t], beliefs[t]);
  take_logarithms();
}

EvidenceMap::TurnedPlace EvidenceMap::turned(const SeenPlace& place, Angle heading, double cell) {
  TurnedPlace turned;
  const Pose2 turn{0.0, 0.0, heading};
  turned.occupied.reserve(place.occupied.size());
  turned.free.reserve(place.free.size());
  for (const Point2 p : place.occupied) turned.occupied.push_back(cell_of(turn * p, cell));
  for (const Point2 p : place.free) turned.free.push_back(cell_of(turn * p, cell));
  return turned;
}

void EvidenceMap::add(const SeenPlace& place, const PoseBox& belief) {
  constexpr float kLeast = 1e-6F;  // of the whole mass; less does not show
  std::map<double, TurnedPlace> seen_at;
  for (std::size_t i = 0; i < belief.size(); ++i) {
    const float mass = belief.value(i);
    if (mass < kLeast) continue;
    const Pose2 pose = belief.pose(i);
    auto [entry, is_new] = seen_at.try_emplace(pose.theta.radians());
    if (is_new) entry->second = turned(place, pose.theta, frame_.resolution);
    const CellIndex at = cell_of(pose.position(), frame_.resolution);
    const auto count = [&](const std::vector<CellIndex>& cells, std::vector<float>& counts) {
      for (const CellIndex cell : cells) {
        const CellIndex in_frame{cell.column + at.column - first_.column, cell.row + at.row - first_.row};
        if (frame_.holds(in_frame)) counts[frame_.index(in_frame)] += mass;
      }
    };
    count(entry->second.occupied, occupied_);
    count(entry->second.free, free_);
  }
}

void EvidenceMap::take_logarithms() {
  constexpr double kPrior = 0.3;   // counts of the mean that every cell begins with
  constexpr double kNever = 0.02;  // no cell is surely the one or the other: people, and poses within a cell
  double all_occupied = 1.0;
  double all = 2.0;
  for (std::size_t i = 0; i < occupied_.size(); ++i) {
    all_occupied += occupied_[i];
    all += occupied_[i] + free_[i];
  }
  const double mean = all_occupied / all;
  log_occupied_.resize(occupied_.size());
  log_free_.resize(free_.size());
  for (std::size_t i = 0; i < occupied_.size(); ++i) {
    double p = (occupied_[i] + kPrior * mean) / (occupied_[i] + free_[i] + kPrior);
    p = std::clamp(p, kNever, 1.0 - kNever);
    log_occupied_[i] = static_cast<float>(std::log(p / mean));
    log_free_[i] = static_cast<float>(std::log((1.0 - p) / (1.0 - mean)));
  }
}

double EvidenceMap::log_likelihood(const TurnedPlace& place, CellIndex at, double independent) const {
  const auto mean_over = [&](const std::vector<CellIndex>& cells, const std::vector<float>& logs) {
    double sum = 0.0;
    for (const CellIndex cell : cells) {
      const CellIndex in_frame{cell.column + at.column - first_.column, cell.row + at.row - first_.row};
      if (frame_.holds(in_frame)) sum += logs[frame_.index(in_frame)];
    }
    return cells.empty() ? 0.0 : sum / static_cast<double>(cells.size());
  };
  return independent * (mean_over(place.occupied, log_occupied_) + mean_over(place.free, log_free_));
}

double EvidenceMap::log_likelihood(const SeenPlace& place, const Pose2& map_from_base, double independent) const {
  return log_likelihood(turned(place, map_from_base.theta, frame_.resolution),
                        cell_of(map_from_base.position(), frame_.resolution), independent);
}

OccupancyGrid EvidenceMap::picture() const {
  constexpr float kSeen = 0.2F;
  OccupancyGrid grid{frame_, std::vector<std::int8_t>(frame_.size(), OccupancyGrid::kUnknown)};
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const float seen = occupied_[i] + free_[i];
    if (seen >= kSeen) grid.cells[i] = static_cast<std::int8_t>(std::lround(100.0F * occupied_[i] / seen));
  }
  return grid;
}

}  // namespace docent::mapping
