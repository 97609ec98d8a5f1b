#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "docent/base/result.h"
#include "docent/collision_avoidance/dynamic_window.h"

namespace docent {

/// What it costs to be near people, and how far they are foreseen. Costs are seconds that a second counts more.
struct CrowdFitParams {
  double horizon = 3.0;          ///< [s] that people who walk are foreseen
  double hard_margin = 0.04;     ///< [m] between the outlines: no way leads nearer
  double intimate = 0.25;        ///< [m] between the outlines; with half a body the 0.45 m of intimate space
  double personal = 0.95;        ///< [m] the same; with half a body 1.2 m
  double intimate_weight = 3.0;  ///< inside intimate space
  double personal_weight = 0.4;  ///< at the inner rim of personal space; falls to 0 at the outer one
  double hidden_weight = 1.5;    ///< behind people, where nobody looks: there may be more of them
  double patience = 8.0;         ///< [s] of standing after which personal space counts half as much
  double blocked_weight = 40.0;  ///< where somebody stands: they may go, or make room
  double crossed_weight = 10.0;  ///< where somebody will walk: better waited for than run into
  double walks = 0.35;           ///< [m/s] below: stands, and is not counted upon to be gone
  double stands = 2.0;           ///< [s] in one place: then it stands; before, it may be somebody who walks
  double uncertainty = 0.12;     ///< [m/s] by which the place of somebody who walks becomes less certain
  double memory = 10.0;          ///< [s] for who stands behind somebody else by now
  double keeping = 0.6;          ///< share of its time that the way chosen before counts: another one must be better
  double change_weight = 0.8;    ///< [s/rad] against needless changes of the way
  template <class V>
  void visit(V& v) {
    v("horizon", horizon);
    v("hard_margin", hard_margin);
    v("intimate", intimate);
    v("personal", personal);
    v("intimate_weight", intimate_weight);
    v("personal_weight", personal_weight);
    v("hidden_weight", hidden_weight);
    v("patience", patience);
    v("blocked_weight", blocked_weight);
    v("crossed_weight", crossed_weight);
    v("walks", walks);
    v("stands", stands);
    v("uncertainty", uncertainty);
    v("memory", memory);
    v("keeping", keeping);
    v("change_weight", change_weight);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// The way that is wanted.
struct CrowdPath {
  std::span<const Point2> points;  ///< [m], odom, from the robot on, not empty
  bool goes_on = false;            ///< beyond its last point
};

/// Time to go [s] over place and time for a robot among people: value iteration [BurgardEtAl1999 4.2] over the floor
/// round the robot and over the next seconds. In layer k people are where they will be k steps from now; beyond the
/// last layer those who walk are gone and those who stand still stand. A move goes to one of eight neighbours or
/// nowhere. Frame: odom, axis-parallel, the robot in the middle.
class CrowdField {
 public:
  static constexpr int kCells = 65;      ///< a side
  static constexpr double kCell = 0.15;  ///< [m]
  static constexpr double kReach = 4.8;  ///< [m] what is farther away does not matter
  static constexpr double kStep = 0.3;   ///< [s] a layer; a cell a step is 0.5 m/s, aslant 0.7
  static constexpr double kSpeed = 0.5;  ///< [m/s] of the time to go beyond the last layer

  CrowdField(const CrowdFitParams& params, double robot_radius);

  /// At the path's end the time to go is 0, at its other points what is left of it. A straight path that goes on is
  /// made for on a broad front: all places of the rim ahead count by their distance to a point farther on.
  /// @param obstacles  odom frame
  /// @param ease  times the weights of personal space
  /// O(cells log cells + layers * (9 cells + 200 moving obstacles)), no allocation after the first call.
  void build(Point2 robot, std::span<const Obstacle> obstacles, const CrowdPath& path, double ease = 1.0);

  [[nodiscard]] int layers() const { return layers_; }
  /// Time to go [s] from a point at a layer, bilinear; outside as at the border.
  [[nodiscard]] double value(int layer, Point2 in_odom) const;
  /// What a second at a point and a layer costs more, 0 in the open.
  [[nodiscard]] double cost(int layer, Point2 in_odom) const;
  /// Where the best way from `from` leads within the layers: the first of its points at least `away` [m] from there,
  /// or its last. Nothing when it waits in all layers.
  [[nodiscard]] std::optional<Point2> way_on(Point2 from, double away) const;
  /// The next build thinks of no way.
  void forget() { way_.clear(); }

 private:
  using Layer = std::vector<float>;  ///< [rows * columns]
  [[nodiscard]] double sample(const Layer& layer, Point2 in_odom) const;
  [[nodiscard]] int cell_at(Point2 in_odom) const;  ///< -1 outside
  [[nodiscard]] bool is_walking(const Obstacle& obstacle) const { return norm(obstacle.velocity) > params_.walks; }
  void stamp(const Obstacle& obstacle, double time, Layer& layer) const;
  void add_shadows(Point2 robot, std::span<const Obstacle> obstacles, Layer& layer) const;
  void seed_path(const CrowdPath& path, double beyond);
  void seed_front(Point2 robot, const CrowdPath& path);
  void keep_to_way();
  void solve_standing();
  void find_way(Point2 from);
  void solve_layer(std::size_t layer);

  CrowdFitParams params_;
  double robot_radius_;
  int layers_;
  double ease_ = 1.0;
  bool is_final_ = true;
  int end_ = -1;               ///< cell where the path ends or leaves the field: who is there has arrived, at any time
  Point2 low_{};               ///< [m], odom, centre of cell (0, 0)
  std::vector<Layer> costs_;   ///< [layers + 1], the first is now
  std::vector<Layer> values_;  ///< [layers + 1]
  std::vector<Point2> way_;    ///< [m], odom: the best among those who stand, by the last build
  Layer share_;                ///< [rows * columns] of its time that a cell counts: less along that way
  std::vector<std::pair<float, int>> open_;
};

}  // namespace docent
