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

constexpr std::array<double, 8> kShrinkages{0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.8};  // that are tried
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

/// @param left_out  index of an example that is not taken; as many as there are: none
Gaussian fit(const std::vector<Column>& examples, double shrinkage, std::size_t left_out) {
  Gaussian result;
  result.mean.setZero();
  Square covariance = Square::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < examples.size(); ++i) {
    if (i == left_out) continue;
    count += 1.0;
    result.mean += examples[i];
  }
  result.mean /= count;
  for (std::size_t i = 0; i < examples.size(); ++i)
    if (i != left_out) covariance += (examples[i] - result.mean) * (examples[i] - result.mean).transpose();
  covariance /= count - 1.0;
  const Column own = covariance.diagonal().cwiseMax(kLeastVariance);
  covariance *= 1.0 - shrinkage;
  covariance.diagonal() = own;
  const Eigen::LLT<Square> factor{covariance};
  result.inverse = factor.solve(Square::Identity());
  result.log_volume = 2.0 * factor.matrixL().toDenseMatrix().diagonal().array().log().sum();
  return result;
}

/// [examples] squared distances of each from the Gaussian of the others, and the sum of their log-likelihoods.
std::pair<std::vector<double>, double> leave_one_out(const std::vector<Column>& examples, double shrinkage) {
  std::vector<double> distances;
  double sum = 0.0;
  for (std::size_t i = 0; i < examples.size(); ++i) {
    const Gaussian others = fit(examples, shrinkage, i);
    distances.push_back(others.distance(examples[i]));
    sum += others.log_likelihood(examples[i]);
  }
  return {distances, sum};
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
  for (const auto& [object, own] : by_object) {
    std::vector<Column> columns;
    for (const Features& features : own) columns.push_back(column_of(book.standardized(features)));
    Class learned;
    learned.object = object;
    learned.examples = own.size();
    double best = -std::numeric_limits<double>::infinity();
    std::vector<double> distances;
    for (const double shrinkage : kShrinkages) {
      auto [own_distances, likelihood] = leave_one_out(columns, shrinkage);
      if (likelihood <= best) continue;
      best = likelihood;
      learned.shrinkage = shrinkage;
      distances = std::move(own_distances);
    }
    const Gaussian gaussian = fit(columns, learned.shrinkage, columns.size());
    std::copy(gaussian.mean.begin(), gaussian.mean.end(), learned.mean.begin());
    learned.inverse.assign(gaussian.inverse.data(), gaussian.inverse.data() + kSize * kSize);
    learned.log_volume = gaussian.log_volume;
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
                       {"shrinkage", known.shrinkage},
                       {"most_distant", known.most_distant},
                       {"log_volume", known.log_volume},
                       {"mean", known.mean},
                       {"inverse", known.inverse}});
  const nlohmann::ordered_json file{{"format", "docent object book 1"},
                                    {"features", feature_names()},
                                    {"middle", middle_},
                                    {"spread", spread_},
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
    for (const auto& one : file.at("classes")) {
      Class known;
      one.at("object").get_to(known.object);
      one.at("examples").get_to(known.examples);
      one.at("shrinkage").get_to(known.shrinkage);
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
