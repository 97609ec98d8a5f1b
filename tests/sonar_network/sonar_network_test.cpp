#include "docent/mapping/sonar_network/sonar_network.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/ml.hpp>

#include "docent/apps/laboratory/train_sonar/sonar_worlds.h"

namespace docent {
namespace {

using mapping::SonarExample;
using mapping::SonarNetwork;

std::vector<SonarExample> examples_of(std::uint64_t seed, std::size_t places) {
  const apps::train_sonar_command::SonarWorld world = apps::train_sonar_command::SonarWorld::office(seed);
  const auto where = world.places(places, seed);
  return apps::train_sonar_command::drawn_trial(world, where, 60, 3.0, seed).examples;
}

SonarNetwork::Inputs inputs_of(const std::vector<SonarExample>& examples) {
  std::vector<mapping::SonarCell> cells;
  for (const SonarExample& example : examples) cells.push_back(example.cell);
  return SonarNetwork::inputs(cells, apps::train_sonar_command::ring_of_data_sheet());
}

cv::Mat as_rows(const SonarNetwork::Inputs& inputs) {
  cv::Mat rows(static_cast<int>(inputs.cols()), SonarNetwork::kInputs, CV_32F);
  for (int i = 0; i < rows.rows; ++i) {
    for (int k = 0; k < rows.cols; ++k) rows.at<float>(i, k) = inputs(k, i);
  }
  return rows;
}

/// The same layers, inputs and examples; its output is squeezed from OpenCV's -1..1 to 0..1.
std::vector<double> by_opencv(const std::vector<SonarExample>& learn, const std::vector<SonarExample>& ask) {
  auto network = cv::ml::ANN_MLP::create();
  network->setLayerSizes(std::vector<int>{SonarNetwork::kInputs, 24, 12, 1});
  network->setActivationFunction(cv::ml::ANN_MLP::SIGMOID_SYM, 1.0, 1.0);
  network->setTrainMethod(cv::ml::ANN_MLP::RPROP);
  network->setTermCriteria({cv::TermCriteria::MAX_ITER, 150, 0.0});
  cv::Mat labels(static_cast<int>(learn.size()), 1, CV_32F);
  for (int i = 0; i < labels.rows; ++i)
    labels.at<float>(i) = learn[static_cast<std::size_t>(i)].is_occupied ? 1.0F : -1.0F;
  cv::theRNG().state = 1;
  network->train(as_rows(inputs_of(learn)), cv::ml::ROW_SAMPLE, labels);
  cv::Mat out;
  network->predict(as_rows(inputs_of(ask)), out);
  std::vector<double> probabilities;
  for (int i = 0; i < out.rows; ++i) {
    probabilities.push_back(std::clamp(0.5 + 0.5 * static_cast<double>(out.at<float>(i)), 0.01, 0.99));
  }
  return probabilities;
}

TEST(SonarNetworkBesideOpenCv, IsAsGoodOnTheSameExamples) {
  const std::vector<SonarExample> learn = examples_of(1, 200);
  const std::vector<SonarExample> ask = examples_of(2, 60);
  const auto ours = SonarNetwork::trained(learn, apps::train_sonar_command::ring_of_data_sheet(), {}, Rng{1});
  std::vector<mapping::SonarCell> cells;
  std::vector<bool> labels;
  for (const SonarExample& example : ask) {
    cells.push_back(example.cell);
    labels.push_back(example.is_occupied);
  }
  const std::vector<double> our_word = ours.probabilities(cells);
  const std::vector<double> their_word = by_opencv(learn, ask);
  const double our_entropy = mapping::cross_entropy(our_word, labels);
  const double their_entropy = mapping::cross_entropy(their_word, labels);
  RecordProperty("ours", std::to_string(our_entropy));
  RecordProperty("theirs", std::to_string(their_entropy));
  EXPECT_LT(our_entropy, 1.05 * their_entropy);
  EXPECT_LT(their_entropy, 0.69) << "the peer has learned something, too";
  double apart = 0.0;
  for (std::size_t i = 0; i < ask.size(); ++i) apart += std::abs(our_word[i] - their_word[i]);
  EXPECT_LT(apart / static_cast<double>(ask.size()), 0.12) << "both mean the same";
}

}  // namespace
}  // namespace docent
