#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::mapping {

/// How poses are cut into cells: the centre of cell (column, row, turn) is (column, row) * cell and turn * step.
struct PoseCells {
  double cell = 1.0;                  ///< [m], > 0
  int turns = 36;                     ///< > 0: headings of a full circle
  [[nodiscard]] double step() const;  ///< [rad]
};

/// What odometry says of a motion, and how wrong it may be.
struct Motion {
  Pose2 before_from_after;
  double way_variance = 0.0;   ///< [m2] along each axis
  double turn_variance = 0.0;  ///< [rad2]
};

/// A belief over poses, kept where there is any: cells of a box of places times an arc of headings. What lies outside
/// has none.
class PoseBox {
 public:
  /// All of it in the cell of one pose.
  PoseBox(const PoseCells& cells, const Pose2& at);
  /// `value_of(pose of the cell's centre)` of all cells within `reach` [m] and `turn` [rad] of a pose, ends included.
  template <class F>
  static PoseBox about(const PoseCells& cells, const Pose2& at, double reach, double turn, F value_of) {
    PoseBox box{cells, at};
    box.widen(static_cast<int>(std::lround(reach / cells.cell)), static_cast<int>(std::lround(turn / cells.step())));
    for (std::size_t i = 0; i < box.size(); ++i) box.values_[i] = static_cast<float>(value_of(box.pose(i)));
    return box;
  }

  [[nodiscard]] const PoseCells& cells() const { return cells_; }
  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] Pose2 pose(std::size_t i) const;  ///< of a cell's centre
  [[nodiscard]] float value(std::size_t i) const { return values_[i]; }
  [[nodiscard]] double value_at(const Pose2& pose) const;  ///< of the cell that the pose lies in; 0 outside
  void set_value(std::size_t i, float value) { values_[i] = value; }

  /// The belief after a motion: sum over s of p(s' | a, s) b(s), the prediction of Markov localization [Minerva2000]
  /// eq. 4. The box grows. O(cells * widths of the noise).
  [[nodiscard]] PoseBox moved(const Motion& motion) const;
  /// The message that runs backwards: sum over s' of p(s' | a, s) b(s'), the transpose of `moved`.
  [[nodiscard]] PoseBox moved_back(const Motion& motion) const;

  /// Divides by the sum. @returns the sum; where it is 0, nothing changes.
  double normalise();
  /// Sets cells below `least` of the largest value to 0 and takes the smallest box that holds the rest.
  void crop(float least);
  /// Every cell times the other's value there: 0 outside of it.
  void multiply(const PoseBox& other);
  /// The mean about the heaviest cell: of the cells within two of it.
  [[nodiscard]] Pose2 mode() const;
  /// [m] and [rad]: root mean square from the mode.
  struct Spread {
    double metres = 0.0;
    double radians = 0.0;
  };
  [[nodiscard]] Spread spread() const;

 private:
  [[nodiscard]] std::size_t index(int column, int row, int turn) const {
    return (static_cast<std::size_t>(turn) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(row)) *
               static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  /// What odometry's errors blur by, in cells.
  struct Noise {
    std::vector<float> places;
    std::vector<float> turns;
  };
  [[nodiscard]] Noise noise_of(const Motion& motion) const;
  /// The same in a box that holds it after the motion, too.
  [[nodiscard]] PoseBox with_room_for(const Motion& motion, const Noise& noise) const;
  /// The same with an empty border of so many cells; an arc never grows beyond the circle.
  void widen(int places, int turns);
  void blur_places(std::span<const float> kernel);
  void blur_turns(std::span<const float> kernel);
  /// All turns shifted by a part of one, in proportion to both neighbours.
  void shift_turns(double turns);
  /// Each turn's places shifted by `sign` times the motion as its heading sees it, by area.
  void shift_places(Point2 way, double sign);

  PoseCells cells_;
  int first_column_ = 0;
  int first_row_ = 0;
  int first_turn_ = 0;  ///< any whole number; the heading is that modulo `turns`
  int columns_ = 1;
  int rows_ = 1;
  int arc_ = 1;                ///< headings held, at most cells_.turns
  std::vector<float> values_;  ///< [arc][rows][columns]
};

}  // namespace docent::mapping
