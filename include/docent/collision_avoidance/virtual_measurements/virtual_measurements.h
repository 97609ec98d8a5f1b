#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"

namespace docent::collision_avoidance {

/// Section `hazards`: virtual measurements, of what no sensor sees, from the belief.
struct VirtualMeasurementParams {
  double confidence = 0.99;     ///< probability with which a virtual measurement underestimates the true distance
  bool jointly = true;          ///< in all directions at once; else in each direction by itself, as in the papers
  double cell_padding = 0.05;   ///< [m] the robot may be so far from the centre of its belief cell
  double doubt_sigmas = 2.5;    ///< >= 0: of where the scanners are mounted, while nothing has confirmed it
  double max_impossible = 0.5;  ///< when more mass than this lies where the robot cannot be, that is believed
  bool best_pose_only = false;  ///< crippled, for evaluation: trusts the likeliest pose

  // What no robot.yaml needs to change.
  double lattice = 0.025;         ///< [m] positions closer than this share their distances
  std::size_t most_rows = 16000;  ///< 3 MB, reached within the first hour: a day takes no more memory than that
  double block = 0.5;             ///< [m] positions in one block have the same borders within range
  double reentry = 0.5;           ///< [m] from outside the area: within that, a way leads back in
  std::size_t sample = 256;       ///< poses from which the limits are guessed
  std::size_t few_poses = 1024;   ///< not worth a guess
  double ample = 4.0;             ///< times the mass that is wanted: so much may the sample be off
  int turned = 6;                 ///< directions, between one belief and the next
  int driven = 8;                 ///< bins likewise

  template <class V>
  void visit(V& v) {
    v("confidence", confidence);
    v("jointly", jointly);
    v("cell_padding", cell_padding);
    v("doubt_sigmas", doubt_sigmas);
    v("max_impossible", max_impossible);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// One weighted pose of a belief, map frame.
struct WeightedPose {
  Point2 position;       ///< [m]
  double heading = 0.0;  ///< [rad]
  double mass = 0.0;     ///< probability
};
/// Mass that may be anywhere in a square, with any heading.
struct WeightedSquare {
  Point2 centre;      ///< [m], map
  double side = 0.0;  ///< [m]
  double mass = 0.0;  ///< probability
};

/// Virtual range measurements of hazards and of the border of the operating area, from the whole belief
/// [Rhino1999] eq. 21-24, [Markov1998] eq. 9-11.
///
/// Departure: the rays end on hazards and on the area's border, not on walls that sensors see (as in
/// [Minerva2000] eq. 14-15); docs/decisions/0002 says why.
class VirtualMeasurements {
 public:
  static constexpr int kDirections = 180;  ///< direction i points 2 i degrees - 180 degrees from the robot's heading
  static constexpr double kBin = 0.05;     ///< [m]
  static constexpr int kBins = 121;        ///< the last: nothing within kMaxRange
  static constexpr double kMaxRange = kBin * (kBins - 1);  ///< [m]
  using Ranges = std::array<double, kDirections>;          ///< [m]

  /// What rays end on: hazards bind the robot's body, the border its centre.
  enum class Ends { both, hazards, border };

  /// Polygons in [m], map. An empty area has no border. @pre params are valid.
  VirtualMeasurements(Polygon area, std::vector<Polygon> hazards, VirtualMeasurementParams params,
                      Ends ends = Ends::both);

  /// What the belief measures.
  struct Scan {
    Ranges ranges{};             ///< to the nearest end, at most kMaxRange
    double possible_mass = 0.0;  ///< share of the belief that lies where the robot can be
  };
  /// The largest distances that, with the wanted confidence, underestimate the true ones: o* = sup {o : P(X > o) >
  /// 0.99}. That holds for each direction by itself: another hundredth of the belief may lie nearer in another one, and
  /// a robot that drives past something passes many directions. So, unless `jointly` is off, they are then lowered
  /// until all of them underestimate at once with that confidence: the likeliest pose that one of them overstates is
  /// given its way, then the next, until at most a hundredth is left that is not. What is left are the unlikeliest.
  /// Poses inside hazards or outside the area are left out, as the robot cannot be there, unless they are most of the
  /// belief. `rest` counts with its nearest hazard in every direction. An empty belief gives zeros.
  ///
  /// The belief before, and when that was quite another a sample of the poses, tells in which bins the hundredth must
  /// lie, with room to spare. All poses that see farther
  /// are passed over, sixteen directions at a time, and few get as far as the histogram. Where the hundredth is not
  /// reached within the guess, everything is counted: the result is that of the plain histogram. O(poses * kDirections
  /// / 16), at worst O(poses * kDirections); about 10 us once for every new position.
  [[nodiscard]] Scan measure(std::span<const WeightedPose> poses, std::span<const WeightedSquare> rest);

  /// True where the robot's centre may be.
  [[nodiscard]] bool is_possible(Point2 position) const;
  /// Distance [m] from `position` to the nearest hazard or border; 0 where the robot cannot be.
  [[nodiscard]] double nearest(Point2 position) const;

 private:
  static constexpr int kStride = 192;  ///< of a row: kDirections, padded to whole vectors
  /// Distances seen from one position, in bins, direction i at 2 i degrees in the map; then padding that is far away.
  struct Row {
    Row() { bins.fill(255); }
    std::array<std::uint8_t, kStride> bins;
    bool possible = false;
  };
  /// A pose of a belief and what is seen from it.
  struct Sighting {
    std::uint32_t row = 0;
    std::int32_t first = 0;  ///< the robot's direction i is the map's direction i + first
    double mass = 0.0;
  };
  /// Mass that may be anywhere in a square and sees something so near, whichever the direction.
  struct RestBin {
    std::uint8_t bin = 0;
    double mass = 0.0;
  };
  std::uint32_t row_of(Point2 position);
  void sight(std::span<const WeightedPose> poses);
  /// The first: fills the histogram as far as the limits reach. @returns the mass that was counted
  double count(std::span<const WeightedSquare> rest, bool leave_out);
  void count_within_limits(const Sighting& sighting);
  void remember_limits();
  void recall_limits();  ///< those of the belief before, with room for what the robot has driven and turned
  void sample_limits();
  /// Sets each limit to the bin where the counted mass reaches `allowed`. False: it does not within some former limit.
  bool lower_limits(double allowed);
  [[nodiscard]] std::size_t last_limit() const;
  void clear_histogram();  ///< as far as the limits reach
  [[nodiscard]] bool is_overstated(const Sighting& sighting) const;
  void lower_jointly(double allowed);
  /// What all positions of a block of half a metre share.
  struct Surroundings {
    std::vector<Segment> borders;  ///< that may be within range, in their order
    std::optional<bool> possible;  ///< whether the robot can be there; nullopt: an outline parts the block
  };
  const Surroundings& surroundings_of(Point2 position);
  void fill(Row& row, Point2 position, std::span<const Segment> borders) const;
  /// [m] to the nearest edge of the hazard that holds a position; nullopt: none does.
  [[nodiscard]] std::optional<Point2> way_out(Point2 position) const;
  void fill_from_outside(Row& row, Point2 position) const;
  /// A place just inside the border for one that lies on it or beyond: its border is where the robot is, and all ways
  /// inwards are open. Other places stay.
  [[nodiscard]] Point2 led_inside(Point2 position) const;
  [[nodiscard]] bool is_in_area(Point2 position) const;
  [[nodiscard]] bool is_in_hazard(Point2 position) const;
  [[nodiscard]] double border_distance(Point2 position) const;
  /// Least distance [m] from within a square; -1 where the robot can be nowhere in it.
  [[nodiscard]] double square_range(Point2 centre, double half_diagonal) const;

  Polygon area_;
  std::vector<Polygon> hazards_;
  std::vector<Segment> borders_;  ///< what rays end on
  VirtualMeasurementParams params_;
  Ends ends_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_;  ///< never iterated: the order of its entries is arbitrary
  std::vector<Row> rows_;
  std::unordered_map<std::uint64_t, Surroundings> surroundings_;  ///< never iterated; of blocks that were asked for
  /// What was asked of last time: the coarse cells of a belief are always the same ones.
  struct KnownSquare {
    Point2 centre;
    double side = -1.0;  ///< none yet
    bool possible = false;
    std::uint8_t bin = 0;  ///< of the least distance
  };
  std::vector<KnownSquare> squares_;
  std::vector<Sighting> sightings_;
  std::vector<RestBin> rest_bins_;
  std::vector<double> histogram_;  ///< [kBins][kDirections] mass; of bins beyond the limits not all
  /// For each of the robot's directions the last bin that still matters; twice in succession, as rows may start
  /// anywhere.
  std::array<std::uint8_t, 2 * kDirections + kStride> limits_{};
  std::array<std::uint8_t, kDirections> last_limits_{};
};

}  // namespace docent::collision_avoidance
