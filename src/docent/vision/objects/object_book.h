#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/vision/objects/features.h"

namespace docent::vision {

/// A picture's features, and what it shows.
struct Example {
  std::string object;  ///< name of its class
  Features features{};
};

struct ObjectBookParams {
  std::size_t least_examples = 8;  ///< of a class, to learn it
  double known = 0.95;             ///< of a class's own examples, left out of it in turn, are to be taken for known
};

/// Things that the robot knows by sight, after [Buhmann1995]: a Gaussian for each class of objects. With 30 to 50
/// examples a covariance of 17 features is all but singular, so each class takes over a share of the covariance of all,
/// and of the variances alone: those shares, of some, by which the examples are named best that are left out in turn
/// (regularized discriminant analysis, [Friedman1989]). The class is
/// that of the greatest likelihood, which is the paper's Mahalanobis distance with ln |S|; what is farther from it than
/// all but few of its own left-out examples is unclassified. Deterministic.
class ObjectBook {
 public:
  /// Error: fewer than two classes, or one with too few examples, by name. O(examples * (examples of a class +
  /// kFeatures) * kFeatures^2).
  [[nodiscard]] static Result<ObjectBook> learn(std::span<const Example> examples, const ObjectBookParams& params = {});

  struct Finding {
    std::string object;               ///< of the likeliest class
    bool is_known = false;            ///< else the thing is unclassified, and `object` is what it is most like
    double distance = 0.0;            ///< squared Mahalanobis distance from that class
    std::vector<double> likelihoods;  ///< [classes] logarithms, up to one constant
  };
  /// O(classes * kFeatures^2)
  [[nodiscard]] Finding name(const Features& features) const;
  [[nodiscard]] std::vector<std::string> objects() const;  ///< [classes] by name

  /// JSON. Error: the file cannot be written.
  [[nodiscard]] Result<void> save(const std::filesystem::path& path) const;
  /// Error: with file and what is wrong in it.
  [[nodiscard]] static Result<ObjectBook> load(const std::filesystem::path& path);

 private:
  using Matrix = std::vector<double>;  ///< [kFeatures * kFeatures]
  struct Class {
    std::string object;
    std::size_t examples = 0;
    Features mean{};            ///< standardized
    Matrix inverse;             ///< of the covariance
    double log_volume = 0.0;    ///< ln |S|
    double most_distant = 0.0;  ///< squared: beyond it a thing is unclassified
  };
  [[nodiscard]] Features standardized(const Features& features) const;

  Features middle_{};    ///< of all examples
  Features spread_{};    ///< likewise, > 0
  double common_ = 0.0;  ///< share of the covariance of all classes in that of each,
  double alone_ = 0.0;   ///< and of the variances alone
  std::vector<Class> classes_;
};

}  // namespace docent::vision
