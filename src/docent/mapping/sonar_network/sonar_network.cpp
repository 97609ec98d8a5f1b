#include "docent/mapping/sonar_network/sonar_network.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "docent/base/files.h"

namespace docent::mapping {
namespace {

constexpr const char* kFormat = "docent sonar network 1";

float logistic(double x) { return static_cast<float>(1.0 / (1.0 + std::exp(-x))); }

/// Adam (D. Kingma and J. Ba, ICLR 2015) over one matrix.
struct Momentum {
  Eigen::MatrixXf mean;
  Eigen::MatrixXf square;
  explicit Momentum(const Eigen::MatrixXf& like)
      : mean{Eigen::MatrixXf::Zero(like.rows(), like.cols())}, square{mean} {}
  template <class Parameters, class Gradient>
  void step(Parameters& parameters, const Gradient& gradient, int n, double rate, double decay) {
    constexpr float kMean = 0.9F;
    constexpr float kSquare = 0.999F;
    mean = kMean * mean + (1.0F - kMean) * gradient;
    square = kSquare * square + (1.0F - kSquare) * gradient.cwiseProduct(gradient);
    const float mean_scale = 1.0F / (1.0F - std::pow(kMean, static_cast<float>(n)));
    const float square_scale = 1.0F / (1.0F - std::pow(kSquare, static_cast<float>(n)));
    const auto change = (mean_scale * mean).array() / ((square_scale * square).array().sqrt() + 1e-7F);
    parameters -= static_cast<float>(rate) * (change.matrix() + static_cast<float>(decay) * parameters);
  }
};

Eigen::MatrixXf drawn_weights(int rows, int columns, Rng& rng) {
  Eigen::MatrixXf weights(rows, columns);
  const double scale = std::sqrt(1.0 / columns);
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < rows; ++r) weights(r, c) = static_cast<float>(rng.normal(0.0, scale));
  }
  return weights;
}

nlohmann::json to_json(const Eigen::MatrixXf& matrix) {
  nlohmann::json rows = nlohmann::json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    nlohmann::json row = nlohmann::json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(matrix(r, c));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Throws what nlohmann does where it is none.
Eigen::MatrixXf matrix_of(const nlohmann::json& rows) {
  Eigen::MatrixXf matrix(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.at(0).size()));
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    const nlohmann::json& row = rows.at(static_cast<std::size_t>(r));
    if (row.size() != static_cast<std::size_t>(matrix.cols()))
      throw nlohmann::json::other_error::create(501, "ragged rows", &rows);
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) matrix(r, c) = row.at(static_cast<std::size_t>(c)).get<float>();
  }
  return matrix;
}

}  // namespace

SonarNetwork::Inputs SonarNetwork::inputs(std::span<const SonarCell> cells, const SonarRingGeometry& ring) {
  constexpr double kSharp = 0.4;  // [m]: where a reading's difference from the place matters most
  Inputs out(kInputs, static_cast<Eigen::Index>(cells.size()));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const SonarCell& cell = cells[i];
    auto column = out.col(static_cast<Eigen::Index>(i));
    column[0] = static_cast<float>(2.0 * cell.range / ring.max_range - 1.0);
    column[1] = static_cast<float>(2.0 * cell.off_axis - 1.0);
    for (int k = 0; k < 4; ++k) {
      const double reading = cell.readings[static_cast<std::size_t>(k)];
      column[2 + k] = static_cast<float>(2.0 * reading / ring.max_range - 1.0);
      column[6 + k] = static_cast<float>(std::tanh((reading - cell.range) / kSharp));
    }
  }
  return out;
}

Eigen::RowVectorXf SonarNetwork::logits(const Inputs& inputs, Eigen::MatrixXf* first, Eigen::MatrixXf* second) const {
  Eigen::MatrixXf one = ((first_.weights * inputs).colwise() + first_.bias).array().tanh();
  Eigen::MatrixXf two = ((second_.weights * one).colwise() + second_.bias).array().tanh();
  Eigen::RowVectorXf out = (last_.weights * two).array() + last_.bias[0];
  if (first != nullptr) *first = std::move(one);
  if (second != nullptr) *second = std::move(two);
  return out;
}

double SonarNetwork::probability(const SonarCell& cell) const { return probabilities({&cell, 1}).front(); }

std::vector<double> SonarNetwork::probabilities(std::span<const SonarCell> cells) const {
  std::vector<double> all;
  all.reserve(cells.size());
  const Eigen::RowVectorXf raw = logits(inputs(cells, ring_), nullptr, nullptr);
  for (const float logit : raw) all.push_back(logistic(scale_ * static_cast<double>(logit) + shift_));
  return all;
}

/// Back-propagation: the gradient of the cross-entropy by each weight, from the last layer to the first.
struct SonarNetwork::Trainer {
  SonarNetwork& network;
  const SonarTrainingParams& params;
  Momentum weights[3];
  Momentum biases[3];
  int steps = 0;

  Trainer(SonarNetwork& of, const SonarTrainingParams& with)
      : network{of},
        params{with},
        weights{Momentum{of.first_.weights}, Momentum{of.second_.weights}, Momentum{of.last_.weights}},
        biases{Momentum{of.first_.bias}, Momentum{of.second_.bias}, Momentum{of.last_.bias}} {}

  /// One step on one batch. @returns the sum of its cross-entropies [nat].
  double step(const Inputs& inputs, const Eigen::RowVectorXf& labels, double rate) {
    Eigen::MatrixXf one;
    Eigen::MatrixXf two;
    const Eigen::RowVectorXf raw = network.logits(inputs, &one, &two);
    const Eigen::RowVectorXf said = raw.unaryExpr([](float x) { return logistic(x); });
    double entropy = 0.0;
    for (Eigen::Index i = 0; i < said.size(); ++i) {
      entropy -= std::log(std::max(labels[i] > 0.5F ? said[i] : 1.0F - said[i], 1e-6F));
    }
    const auto count = static_cast<float>(said.size());
    const Eigen::RowVectorXf at_last = (said - labels) / count;  // d entropy / d logit
    const Eigen::MatrixXf at_two =
        (network.last_.weights.transpose() * at_last).array() * (1.0F - two.array().square());
    const Eigen::MatrixXf at_one =
        (network.second_.weights.transpose() * at_two).array() * (1.0F - one.array().square());
    ++steps;
    descend(2, network.last_, at_last, two, rate);
    descend(1, network.second_, at_two, one, rate);
    descend(0, network.first_, at_one, inputs, rate);
    return entropy;
  }

  template <class Error, class Input>
  void descend(int layer, Layer& of, const Error& error, const Input& input, double rate) {
    weights[layer].step(of.weights, error * input.transpose(), steps, rate, params.decay);
    biases[layer].step(of.bias, error.rowwise().sum(), steps, rate, 0.0);
  }
};

SonarNetwork SonarNetwork::trained(std::span<const SonarExample> examples, const SonarRingGeometry& ring,
                                   const SonarTrainingParams& params, Rng rng,
                                   const std::function<void(int, double)>& progress) {
  SonarNetwork network;
  network.ring_ = ring;
  network.first_ = {drawn_weights(params.first_layer, kInputs, rng), Eigen::VectorXf::Zero(params.first_layer)};
  network.second_ = {drawn_weights(params.second_layer, params.first_layer, rng),
                     Eigen::VectorXf::Zero(params.second_layer)};
  network.last_ = {drawn_weights(1, params.second_layer, rng), Eigen::VectorXf::Zero(1)};
  std::vector<std::size_t> order(examples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto shuffle = [&](std::size_t count) {  // not std::shuffle, which differs between libraries
    for (std::size_t i = count; i > 1; --i) {
      std::swap(order[i - 1], order[static_cast<std::size_t>(rng.uniform() * static_cast<double>(i))]);
    }
  };
  shuffle(order.size());
  const auto held_back = static_cast<std::size_t>(params.held_back * static_cast<double>(examples.size()));
  const std::size_t used = examples.size() - held_back;
  const auto gather = [&](std::size_t from, std::size_t to, std::vector<float>& labels) {
    std::vector<SonarCell> cells;
    labels.clear();
    for (std::size_t i = from; i < to; ++i) {
      cells.push_back(examples[order[i]].cell);
      labels.push_back(examples[order[i]].is_occupied ? 1.0F : 0.0F);
    }
    return inputs(cells, ring);
  };
  std::vector<float> calibration_labels;
  const Inputs calibration = gather(used, order.size(), calibration_labels);
  Trainer trainer{network, params};
  const auto batch = static_cast<std::size_t>(params.batch);
  for (int epoch = 0; epoch < params.epochs; ++epoch) {
    shuffle(used);
    const double share = params.epochs > 1 ? static_cast<double>(epoch) / (params.epochs - 1) : 0.0;
    const double rate = params.rate * std::pow(0.05, share);
    double entropy = 0.0;
    std::vector<float> labels;
    for (std::size_t from = 0; from < used; from += batch) {
      const Inputs in = gather(from, std::min(used, from + batch), labels);
      entropy += trainer.step(
          in, Eigen::Map<Eigen::RowVectorXf>{labels.data(), static_cast<Eigen::Index>(labels.size())}, rate);
    }
    if (progress) progress(epoch, entropy / static_cast<double>(std::max<std::size_t>(used, 1)));
  }
  const auto occupied =
      std::count_if(examples.begin(), examples.end(), [](const SonarExample& e) { return e.is_occupied; });
  network.prior_ = static_cast<double>(occupied) / static_cast<double>(std::max<std::size_t>(examples.size(), 1));
  if (!calibration_labels.empty()) network.calibrate(calibration, calibration_labels);
  return network;
}

/// Newton's method for the scale and shift of the logits that make the held-back labels likeliest (J. Platt, 1999).
void SonarNetwork::calibrate(const Inputs& inputs, std::span<const float> labels) {
  const Eigen::RowVectorXf raw = logits(inputs, nullptr, nullptr);
  for (int step = 0; step < 20; ++step) {
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d curvature = 1e-6 * Eigen::Matrix2d::Identity();
    for (Eigen::Index i = 0; i < raw.size(); ++i) {
      const double x = static_cast<double>(raw[i]);
      const double p = static_cast<double>(logistic(scale_ * x + shift_));
      const Eigen::Vector2d by{x, 1.0};
      gradient += (p - static_cast<double>(labels[static_cast<std::size_t>(i)])) * by;
      curvature += p * (1.0 - p) * by * by.transpose();
    }
    const double determinant = curvature.determinant();
    const Eigen::Vector2d change{(curvature(1, 1) * gradient[0] - curvature(0, 1) * gradient[1]) / determinant,
                                 (curvature(0, 0) * gradient[1] - curvature(1, 0) * gradient[0]) / determinant};
    scale_ -= change[0];
    shift_ -= change[1];
    if (change.norm() < 1e-9) return;
  }
}

Result<void> SonarNetwork::save(const std::filesystem::path& json) const {
  const nlohmann::json document{{"format", kFormat},
                                {"ring",
                                 {{"count", ring_.count},
                                  {"radius", ring_.radius},
                                  {"max_range", ring_.max_range},
                                  {"field_of_view", ring_.field_of_view}}},
                                {"prior", prior_},
                                {"calibration", {{"scale", scale_}, {"shift", shift_}}},
                                {"layers",
                                 {{{"weights", to_json(first_.weights)}, {"bias", to_json(first_.bias)}},
                                  {{"weights", to_json(second_.weights)}, {"bias", to_json(second_.bias)}},
                                  {{"weights", to_json(last_.weights)}, {"bias", to_json(last_.bias)}}}}};
  return write_file_atomically(json, document.dump(1) + "\n");
}

Result<SonarNetwork> SonarNetwork::load(const std::filesystem::path& json) {
  const auto text = read_file(json);
  if (!text) return tl::unexpected<Error>(text.error());
  return parse(*text, json.string());
}

Result<SonarNetwork> SonarNetwork::parse(const std::string& text, const std::string& name) {
  SonarNetwork network;
  try {
    const nlohmann::json document = nlohmann::json::parse(text);
    if (document.at("format") != kFormat) return fail(name + ": not a sonar network that this program knows");
    const nlohmann::json& ring = document.at("ring");
    network.ring_ = {ring.at("count").get<int>(), ring.at("radius").get<double>(), ring.at("max_range").get<double>(),
                     ring.at("field_of_view").get<double>()};
    network.prior_ = document.at("prior").get<double>();
    network.scale_ = document.at("calibration").at("scale").get<double>();
    network.shift_ = document.at("calibration").at("shift").get<double>();
    Layer* layers[] = {&network.first_, &network.second_, &network.last_};
    for (std::size_t i = 0; i < 3; ++i) {
      layers[i]->weights = matrix_of(document.at("layers").at(i).at("weights"));
      layers[i]->bias = matrix_of(document.at("layers").at(i).at("bias"));
    }
  } catch (const nlohmann::json::exception& error) {
    return fail(name + ": not a sonar network: " + error.what());
  }
  const bool fits = network.ring_.count >= 4 && network.ring_.count <= 1000 &&
                    network.first_.weights.cols() == kInputs &&
                    network.second_.weights.cols() == network.first_.weights.rows() &&
                    network.last_.weights.cols() == network.second_.weights.rows() &&
                    network.last_.weights.rows() == 1 && network.first_.bias.size() == network.first_.weights.rows() &&
                    network.second_.bias.size() == network.second_.weights.rows() && network.last_.bias.size() == 1;
  if (!fits) return fail(name + ": the layers do not fit each other");
  return network;
}

double cross_entropy(std::span<const double> probabilities, const std::vector<bool>& is_occupied) {
  constexpr double kLeast = 1e-4;
  double sum = 0.0;
  for (std::size_t i = 0; i < probabilities.size(); ++i) {
    const double p = std::clamp(probabilities[i], kLeast, 1.0 - kLeast);
    sum -= std::log(is_occupied[i] ? p : 1.0 - p);
  }
  return probabilities.empty() ? 0.0 : sum / static_cast<double>(probabilities.size());
}

double roc_area(std::span<const double> values, const std::vector<bool>& is_occupied) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  double ranks_of_occupied = 0.0;
  double occupied = 0.0;
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    const double rank = 0.5 * static_cast<double>(i + end + 1);  // of equals the mean
    for (; i < end; ++i) {
      if (!is_occupied[order[i]]) continue;
      ranks_of_occupied += rank;
      occupied += 1.0;
    }
  }
  const double free = static_cast<double>(values.size()) - occupied;
  if (occupied == 0.0 || free == 0.0) return 0.5;
  return (ranks_of_occupied - 0.5 * occupied * (occupied + 1.0)) / (occupied * free);
}

}  // namespace docent::mapping
