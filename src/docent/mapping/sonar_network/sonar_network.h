#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/result.h"
#include "docent/mapping/sonar_network/sonar_view.h"

namespace docent::mapping {

/// A place, what the sonars said, and whether something was there.
struct SonarExample {
  SonarCell cell;
  bool is_occupied = false;
};

struct SonarTrainingParams {
  int first_layer = 24;    ///< > 0 units
  int second_layer = 12;   ///< > 0
  int epochs = 12;         ///< > 0 times through all examples
  int batch = 64;          ///< > 0 examples a step
  double rate = 0.004;     ///< > 0, of the first epoch; falls to a twentieth
  double decay = 1e-5;     ///< >= 0, of the weights
  double held_back = 0.1;  ///< 0..0.5 of the examples, that calibration is fitted to
  template <class V>
  void visit(V& v) {
    v("first_layer", first_layer);
    v("second_layer", second_layer);
    v("epochs", epochs);
    v("batch", batch);
    v("rate", rate);
    v("decay", decay);
    v("held_back", held_back);
  }
};

/// P(c_xy | o), the inverse sensor model of a ring of sonars, learned ([Rhino1999] 3.2.2; S. Thrun, Learning
/// metric-topological maps, Artificial Intelligence 99, 1998): a network of two hidden layers, trained by
/// back-propagation on examples from places drawn in known worlds, whose output is then calibrated so that of all cells
/// with output p a share of p is occupied.
class SonarNetwork {
 public:
  static constexpr int kInputs = 10;

  /// Trains one. The same examples, parameters and seed give the same network. `progress`: epoch, mean cross-entropy
  /// [nat] of its examples. @pre examples of both kinds. O(epochs * examples * weights).
  [[nodiscard]] static SonarNetwork trained(std::span<const SonarExample> examples, const SonarRingGeometry& ring,
                                            const SonarTrainingParams& params, Rng rng,
                                            const std::function<void(int, double)>& progress = {});
  /// Error: "FILE: …", not a network of ours.
  [[nodiscard]] static Result<SonarNetwork> load(const std::filesystem::path& json);
  /// From memory; `name` stands where the file's name would.
  [[nodiscard]] static Result<SonarNetwork> parse(const std::string& text, const std::string& name);
  [[nodiscard]] Result<void> save(const std::filesystem::path& json) const;

  [[nodiscard]] const SonarRingGeometry& ring() const { return ring_; }
  /// Share of the examples that were occupied: what it says of a place about which it knows nothing.
  [[nodiscard]] double prior() const { return prior_; }
  /// P(occupied), 0..1. O(weights).
  [[nodiscard]] double probability(const SonarCell& cell) const;
  /// All at once, several times faster than one by one.
  [[nodiscard]] std::vector<double> probabilities(std::span<const SonarCell> cells) const;

  using Inputs = Eigen::Matrix<float, kInputs, Eigen::Dynamic>;
  /// The cells as the network sees them, one a column: everything about -1..1.
  [[nodiscard]] static Inputs inputs(std::span<const SonarCell> cells, const SonarRingGeometry& ring);

 private:
  struct Layer {
    Eigen::MatrixXf weights;
    Eigen::VectorXf bias;
  };
  /// Logits before calibration. With `hidden` also what the hidden layers said.
  [[nodiscard]] Eigen::RowVectorXf logits(const Inputs& inputs, Eigen::MatrixXf* first, Eigen::MatrixXf* second) const;
  void calibrate(const Inputs& inputs, std::span<const float> labels);
  struct Trainer;

  SonarRingGeometry ring_;
  Layer first_;
  Layer second_;
  Layer last_;
  double scale_ = 1.0;  ///< calibration: logit = scale * network's + shift
  double shift_ = 0.0;
  double prior_ = 0.5;
};

/// Mean of -ln P(what was) [nat]. Probabilities are kept from 0 and 1 by 1e-4.
[[nodiscard]] double cross_entropy(std::span<const double> probabilities, const std::vector<bool>& is_occupied);
/// Area under the ROC curve: the chance that an occupied one has a larger value than a free one. O(n log n).
[[nodiscard]] double roc_area(std::span<const double> values, const std::vector<bool>& is_occupied);

}  // namespace docent::mapping
