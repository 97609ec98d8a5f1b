#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace docent {

/// What a driver means that writes 0.
enum class ZeroMeans {
  find_out,  ///< the readings tell
  nothing,   ///< that nothing came back: nothing stands within reach
  failed,    ///< that there is no reading
};

/// Finds out from its sweeps what a driver means that writes 0 for a beam.
///
/// One that has ever written +infinity or its greatest range has another word for "nothing there". Of the others, zeros
/// are "nothing there" where walls run out of reach: readings grow to the greatest range before they become 0, at
/// several places; or where the edges between zeros and far readings wander over many beams, as they do while the robot
/// moves, each time by a few degrees. What is covered has fixed edges, what comes too near has near neighbours, and
/// what is thrown over a scanner comes at once: none of these counts.
class ZeroMeaning {
 public:
  /// One sweep as the driver wrote it. `bearing_step` [rad] > 0, `min_range`, `max_range` [m]. O(beams)
  void add(std::span<const float> ranges, double bearing_step, double min_range, double max_range);
  /// find_out: nobody can say yet.
  [[nodiscard]] ZeroMeans found() const { return found_; }

 private:
  enum class Beam : unsigned char { zero, open, near, none };
  void note_edges_at_reach(std::span<const float> ranges, double max_range);
  void note_edges_that_wander(double bearing_step);

  ZeroMeans found_ = ZeroMeans::find_out;
  std::vector<Beam> now_, before_;
  std::vector<bool> wandered_;  ///< [beams] an edge has passed over it
  std::size_t far_ = 0;         ///< readings so far that were the driver's word for "nothing there"
  double said_far_ = 0.0;       ///< [m] the last of them
  std::size_t at_reach_ = 0;    ///< sweeps with zeros beside readings of nearly the greatest range, at several places
  std::size_t closed_ = 0;      ///< beams of zeros beside something near, and
  std::size_t open_ = 0;        ///< beside something far
};

}  // namespace docent
