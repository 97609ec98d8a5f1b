#include "docent/vision/objects/object_book.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "docent/base/files.h"

namespace docent::vision {
namespace {

constexpr int kSize = static_cast<int>(kFeatures);
using Square = Eigen::Matrix<double, kSize, kSize>;
using Column = Eigen::Matrix<double, kSize, 1>;

// Shares of what all classes have in common, and of the variances alone, that are tried.
constexpr std::array<double, 5> kCommon{0.0, 0.25, 0.5, 0.75, 1.0};
constexpr std::array<double, 3> kAlone{0.02, 0.1, 0.3};
constexpr double kLeastVariance = 1e-3;  // of a standardized feature: examples that are all alike say little of others

Column column_of(const Features& features) { return Eigen::Map<const Column>(features.data()); }

/// A Gaussian of some examples.
struct Gaussian {
  Column mean;
  Square inverse;
  double log_volume = 0.0;

  [[nodiscard]] double distance(const Column& at) const { return (at - mean).dot(inverse * (at - mean)); }
  [[nodiscard]] double log_likelihood(const Column& at) const { return -0.5 * (distance(at) + log_volume); }
};

struct Moments {
  Column mean = Column::Zero();
  Square covariance = Square::Zero();
};

/// @param left_out  index of an example that is not taken; as many as there are: none
Moments moments_of(const std::vector<Column>& examples, std::size_t left_out) {
  Moments result;
  double count = 0.0;
  for (std::size_t i = 0; i < examples.size(); ++i) {
    if (i == left_out) continue;
    count += 1.0;
    result.mean += examples[i];
  }
  result.mean /= count;
  for (std::size_t i = 0; i < examples.size(); ++i)
    if (i != left_out) result.covariance += (examples[i] - result.mean) * (examples[i] - result.mean).transpose();
  result.covariance /= count - 1.0;
  return result;
}

/// How much a class takes over from all of them. [Friedman1989]
struct Regularization {
  double common = 0.0;  ///< share of their pooled covariance
  double alone = 0.0;   ///< share of the variances alone, of what comes of it
};

Gaussian regularized(const Moments& own, const Square& pooled, const Regularization& how) {
  Square covariance = (1.0 - how.common) * own.covariance + how.common * pooled;
  const Column variances = covariance.diagonal().cwiseMax(kLeastVariance);
  covariance *= 1.0 - how.alone;
  covariance.diagonal() = variances;
  const Eigen::LLT<Square> factor{covariance};
  return {own.mean, factor.solve(Square::Identity()),
          2.0 * factor.matrixL().toDenseMatrix().diagonal().array().log().sum()};
}

using ByClass = std::vector<std::vector<Column>>;

/// What the examples say that are left out in turn.
struct LeftOut {
  double likelihood = 0.0;                     ///< logarithm, of their classes
  std::vector<std::vector<double>> distances;  ///< [classes][examples] squared, from the others of their class
};

LeftOut leave_one_out(const ByClass& classes, const std::vector<Moments>& moments, const Square& pooled,
                      const Regularization& how) {
  std::vector<Gaussian> whole;
  for (const Moments& own : moments) whole.push_back(regularized(own, pooled, how));
  LeftOut result;
  for (std::size_t c = 0; c < classes.size(); ++c) {
    result.distances.emplace_back();
    for (std::size_t i = 0; i < classes[c].size(); ++i) {
      const Column& at = classes[c][i];
      const Gaussian others = regularized(moments_of(classes[c], i), pooled, how);
      result.distances.back().push_back(others.distance(at));
      const double own = others.log_likelihood(at);
      double odds = 1.0;  // of all classes against its own
      for (std::size_t k = 0; k < classes.size(); ++k)
        if (k != c) odds += std::exp(std::min(500.0, whole[k].log_likelihood(at) - own));
      result.likelihood -= std::log(odds);
    }
  }
  return result;
}

}  // namespace

Features ObjectBook::standardized(const Features& features) const {
  Features result;
  for (std::size_t i = 0; i < kFeatures; ++i) result[i] = (features[i] - middle_[i]) / spread_[i];
  return result;
}

Result<ObjectBook> ObjectBook::learn(std::span<const Example> examples, const ObjectBookParams& params) {
  if (!(params.known > 0.0 && params.known <= 1.0)) return fail("the share that is known must be in (0, 1]");
  std::map<std::string, std::vector<Features>> by_object;
  for (const Example& example : examples) by_object[example.object].push_back(example.features);
  if (by_object.size() < 2) return fail("there is only one kind of object: it takes two to tell them apart");
  for (const auto& [object, own] : by_object)
    if (own.size() < params.least_examples)
      return fail(object + ": " + std::to_string(own.size()) + " pictures; it takes at least " +
                  std::to_string(params.least_examples) + ", better 30 to 50");
  ObjectBook book;
  for (std::size_t i = 0; i < kFeatures; ++i) {
    double sum = 0.0, squares = 0.0;
    for (const Example& example : examples) sum += example.features[i];
    book.middle_[i] = sum / static_cast<double>(examples.size());
    for (const Example& example : examples) squares += std::pow(example.features[i] - book.middle_[i], 2);
    book.spread_[i] = std::max(1e-6, std::sqrt(squares / static_cast<double>(examples.size())));
  }
  ByClass classes;
  std::vector<Moments> moments;
  Square pooled = Square::Zero();
  for (const auto& [object, own] : by_object) {
    classes.emplace_back();
    for (const Features& features : own) classes.back().push_back(column_of(book.standardized(features)));
    moments.push_back(moments_of(classes.back(), own.size()));
    pooled += static_cast<double>(own.size() - 1) / static_cast<double>(examples.size() - by_object.size()) *
              moments.back().covariance;
  }
  Regularization best_how;
  LeftOut best{-std::numeric_limits<double>::infinity(), {}};
  for (const double common : kCommon) {
    for (const double alone : kAlone) {
      LeftOut left_out = leave_one_out(classes, moments, pooled, {common, alone});
      if (left_out.likelihood <= best.likelihood) continue;
      best = std::move(left_out);
      best_how = {common, alone};
    }
  }
  book.common_ = best_how.common;
  book.alone_ = best_how.alone;
  std::size_t c = 0;
  for (const auto& [object, own] : by_object) {
    Class learned;
    learned.object = object;
    learned.examples = own.size();
    const Gaussian gaussian = regularized(moments[c], pooled, best_how);
    std::copy(gaussian.mean.begin(), gaussian.mean.end(), learned.mean.begin());
    learned.inverse.assign(gaussian.inverse.data(), gaussian.inverse.data() + kSize * kSize);
    learned.log_volume = gaussian.log_volume;
    std::vector<double>& distances = best.distances[c++];
    std::sort(distances.begin(), distances.end());
    const auto last = static_cast<std::size_t>(std::ceil(params.known * static_cast<double>(distances.size()))) - 1;
    learned.most_distant = distances[std::min(last, distances.size() - 1)];
    book.classes_.push_back(std::move(learned));
  }
  return book;
}

ObjectBook::Finding ObjectBook::name(const Features& features) const {
  const Column at = column_of(standardized(features));
  Finding finding;
  double best = -std::numeric_limits<double>::infinity();
  for (const Class& known : classes_) {
    const Column off = at - column_of(known.mean);
    const double distance = off.dot(Eigen::Map<const Square>(known.inverse.data()) * off);
    finding.likelihoods.push_back(-0.5 * (distance + known.log_volume));
    if (finding.likelihoods.back() <= best) continue;
    best = finding.likelihoods.back();
    finding.object = known.object;
    finding.distance = distance;
    finding.is_known = distance <= known.most_distant;
  }
  return finding;
}

std::vector<std::string> ObjectBook::objects() const {
  std::vector<std::string> names;
  for (const Class& known : classes_) names.push_back(known.object);
  return names;
}

Result<void> ObjectBook::save(const std::filesystem::path& path) const {
  nlohmann::ordered_json classes = nlohmann::ordered_json::array();
  for (const Class& known : classes_)
    classes.push_back({{"object", known.object},
                       {"examples", known.examples},
                       {"most_distant", known.most_distant},
                       {"log_volume", known.log_volume},
                       {"mean", known.mean},
                       {"inverse", known.inverse}});
  const nlohmann::ordered_json file{{"format", "docent object book 1"},
                                    {"features", feature_names()},
                                    {"middle", middle_},
                                    {"spread", spread_},
                                    {"common", common_},
                                    {"alone", alone_},
                                    {"classes", classes}};
  return write_file_atomically(path, file.dump(1) + "\n");
}

Result<ObjectBook> ObjectBook::load(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected<Error>(text.error());
  const auto refuse = [&](const std::string& why) { return fail(path.string() + ": " + why); };
  const auto file = nlohmann::json::parse(*text, nullptr, false);
  if (file.is_discarded()) return refuse("is no JSON");
  ObjectBook book;
  try {
    if (file.at("format") != "docent object book 1") return refuse("is no object book of docent learn-objects");
    if (file.at("features").get<std::vector<std::string>>() !=
        std::vector<std::string>(feature_names().begin(), feature_names().end()))
      return refuse("has other features than this program: learn the objects anew");
    file.at("middle").get_to(book.middle_);
    file.at("spread").get_to(book.spread_);
    file.at("common").get_to(book.common_);
    file.at("alone").get_to(book.alone_);
    for (const auto& one : file.at("classes")) {
      Class known;
      one.at("object").get_to(known.object);
      one.at("examples").get_to(known.examples);
      one.at("most_distant").get_to(known.most_distant);
      one.at("log_volume").get_to(known.log_volume);
      one.at("mean").get_to(known.mean);
      one.at("inverse").get_to(known.inverse);
      if (known.inverse.size() != kFeatures * kFeatures)
        return refuse("the matrix of " + known.object + " has another size");
      book.classes_.push_back(std::move(known));
    }
  } catch (const nlohmann::json::exception& error) {
    return refuse(error.what());
  }
  if (book.classes_.empty()) return refuse("knows no objects");
  for (const double spread : book.spread_)
    if (!(spread > 0.0)) return refuse("a feature has no spread");
  return book;
}

}  // namespace docent::vision
