#include "docent/mapping/scan_matching/correlative_matcher.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace docent::mapping {
namespace {

/// A square of poses of one heading: offsets of `2^level` cells each way from the lowest.
struct Branch {
  int heading = 0;
  int level = 0;
  int column = 0;  ///< [cells] from the expected place
  int row = 0;
  double bound = 0.0;
};

struct TurnedSweep {
  double turn = 0.0;             ///< [rad] from the expected heading
  std::vector<CellIndex> cells;  ///< of the points, at the expected place
};

class BranchAndBound {
 public:
  BranchAndBound(const MatchGrid& grid, std::span<const Point2> points, const Pose2& expected,
                 const MatchWindow& window, const ForbiddenPlace* not_near)
      : grid_{grid}, expected_{expected}, window_{window}, not_near_{not_near} {
    reach_ = static_cast<int>(std::ceil(window.reach / grid.frame().resolution));
    double farthest = 1.0;
    for (const Point2 p : points) farthest = std::max(farthest, norm(p));
    const double step = grid.frame().resolution / farthest;
    const int steps = static_cast<int>(std::ceil(std::min(window.turn, std::numbers::pi) / step));
    for (int i = -steps; i <= steps; ++i) add_turn(points, i * step);
  }

  std::optional<CorrelativeMatch> search(double least) {
    best_score_ = least;
    descend(first_branches());
    if (!best_) return std::nullopt;
    return CorrelativeMatch{pose_of(*best_), best_score_};
  }

 private:
  void add_turn(std::span<const Point2> points, double turn) {
    TurnedSweep turned{turn, {}};
    const Pose2 pose{expected_.x, expected_.y, expected_.theta + Angle::radians(turn)};
    turned.cells.reserve(points.size());
    for (const Point2 p : points) turned.cells.push_back(grid_.frame().cell_at(pose * p));
    turned_.push_back(std::move(turned));
  }

  [[nodiscard]] Pose2 pose_of(const Branch& leaf) const {
    const double cell = grid_.frame().resolution;
    return {expected_.x + leaf.column * cell, expected_.y + leaf.row * cell,
            expected_.theta + Angle::radians(turned_[static_cast<std::size_t>(leaf.heading)].turn)};
  }

  /// What the nearest pose of the branch loses by its distance from the expectation.
  [[nodiscard]] double cost_of(const Branch& branch) const {
    if (window_.expectation_weight == 0.0) return 0.0;
    const int width = (1 << branch.level) - 1;
    const auto nearest = [&](int low) { return low > 0 ? low : std::min(0, low + width); };
    const double cell = grid_.frame().resolution;
    const double x = nearest(branch.column) * cell / window_.position_sigma;
    const double y = nearest(branch.row) * cell / window_.position_sigma;
    const double t = turned_[static_cast<std::size_t>(branch.heading)].turn / window_.heading_sigma;
    return window_.expectation_weight * 0.5 * (x * x + y * y + t * t);
  }

  void set_bound(Branch& branch) const {
    const std::vector<CellIndex>& cells = turned_[static_cast<std::size_t>(branch.heading)].cells;
    std::uint32_t sum = 0;
    for (const CellIndex cell : cells) {
      sum += grid_.bound(branch.level, {cell.column + branch.column, cell.row + branch.row});
    }
    branch.bound = sum / (255.0 * static_cast<double>(cells.size())) - cost_of(branch);
  }

  [[nodiscard]] bool is_forbidden(const Branch& leaf) const {
    if (not_near_ == nullptr) return false;
    const Pose2 pose = pose_of(leaf);
    return distance(pose.position(), not_near_->pose.position()) < not_near_->reach &&
           std::abs((pose.theta - not_near_->pose.theta).radians()) < not_near_->turn;
  }

  [[nodiscard]] std::vector<Branch> first_branches() const {
    const int level = grid_.levels() - 1;
    const int width = 1 << level;
    std::vector<Branch> branches;
    for (std::size_t heading = 0; heading < turned_.size(); ++heading) {
      for (int row = -reach_; row <= reach_; row += width) {
        for (int column = -reach_; column <= reach_; column += width) {
          Branch branch{static_cast<int>(heading), level, column, row, 0.0};
          set_bound(branch);
          if (branch.bound > best_score_) branches.push_back(branch);
        }
      }
    }
    return branches;
  }

  void descend(std::vector<Branch> branches) {
    // The order of equals is that of the window, whatever sorts: the same run everywhere.
    std::stable_sort(branches.begin(), branches.end(),
                     [](const Branch& a, const Branch& b) { return a.bound > b.bound; });
    for (const Branch& branch : branches) {
      if (branch.bound <= best_score_) return;
      if (branch.level == 0) {
        if (is_forbidden(branch)) continue;
        best_score_ = branch.bound;
        best_ = branch;
        return;
      }
      std::vector<Branch> parts;
      const int half = 1 << (branch.level - 1);
      for (const int row : {branch.row, branch.row + half}) {
        for (const int column : {branch.column, branch.column + half}) {
          if (row > reach_ || column > reach_) continue;
          Branch part{branch.heading, branch.level - 1, column, row, 0.0};
          set_bound(part);
          if (part.bound > best_score_) parts.push_back(part);
        }
      }
      descend(std::move(parts));
    }
  }

  const MatchGrid& grid_;
  Pose2 expected_;
  MatchWindow window_;
  const ForbiddenPlace* not_near_;
  int reach_ = 0;
  std::vector<TurnedSweep> turned_;
  double best_score_ = 0.0;
  std::optional<Branch> best_;
};

}  // namespace

std::optional<CorrelativeMatch> best_match(const MatchGrid& grid, std::span<const Point2> points, const Pose2& expected,
                                           const MatchWindow& window, double least, const ForbiddenPlace* not_near) {
  return BranchAndBound{grid, points, expected, window, not_near}.search(least);
}

}  // namespace docent::mapping
