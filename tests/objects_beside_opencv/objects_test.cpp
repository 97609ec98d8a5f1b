// Real photographs of five kinds of things, 40 of each to learn and the rest to judge, seven times: our Gaussians
// beside OpenCV's linear discriminants and nearest neighbours on the same features; and what becomes of a kind that
// nobody taught. Prints the tables that docs/reports quotes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/ml.hpp>

#include "docent/apps/eyes/object_pictures.h"
#include "docent/base/random.h"

namespace docent {
namespace {

using vision::Example;
using vision::Features;
using vision::kFeatures;

constexpr std::size_t kLearn = 40;  // of a kind
constexpr int kRepetitions = 7;

struct Split {
  std::vector<Example> learn, judge;
};

std::vector<Example> photographs() {
  const char* data = std::getenv("DOCENT_DATA");
  const std::filesystem::path folder = std::filesystem::path{data == nullptr ? "" : data} / "vision" / "objects";
  std::vector<Example> examples;
  if (data == nullptr || !std::filesystem::is_directory(folder)) return examples;
  const auto kinds = apps::objects_command::object_folders(folder);
  EXPECT_TRUE(kinds) << kinds.error().message;
  for (const auto& kind : *kinds) {
    for (const auto& path : kind.pictures) {
      const auto picture = apps::objects_command::read_picture(path);
      EXPECT_TRUE(picture) << picture.error().message;
      examples.push_back({kind.object, apps::objects_command::see(*picture).features});
    }
  }
  return examples;
}

std::vector<std::string> kinds_of(const std::vector<Example>& examples) {
  std::vector<std::string> kinds;
  for (const Example& example : examples)
    if (kinds.empty() || kinds.back() != example.object) kinds.push_back(example.object);
  return kinds;
}

Split split(const std::vector<Example>& examples, std::uint64_t seed) {
  std::map<std::string, std::vector<Example>> by_kind;
  for (const Example& example : examples) by_kind[example.object].push_back(example);
  Split parts;
  Rng rng{seed};
  for (auto& [kind, own] : by_kind) {
    for (std::size_t i = own.size(); i-- > 1;)
      std::swap(own[i], own[static_cast<std::size_t>(rng.uniform() * static_cast<double>(i + 1))]);
    for (std::size_t i = 0; i < own.size(); ++i) (i < kLearn ? parts.learn : parts.judge).push_back(own[i]);
  }
  return parts;
}

/// Standardized by the examples that are learned, as ours are.
cv::Mat rows_of(const std::vector<Example>& examples, const std::vector<Example>& learn) {
  cv::Mat rows(static_cast<int>(examples.size()), static_cast<int>(kFeatures), CV_64F);
  for (std::size_t k = 0; k < kFeatures; ++k) {
    double sum = 0.0, squares = 0.0;
    for (const Example& example : learn) sum += example.features[k];
    const double middle = sum / static_cast<double>(learn.size());
    for (const Example& example : learn) squares += std::pow(example.features[k] - middle, 2);
    const double spread = std::max(1e-6, std::sqrt(squares / static_cast<double>(learn.size())));
    for (std::size_t i = 0; i < examples.size(); ++i)
      rows.at<double>(static_cast<int>(i), static_cast<int>(k)) = (examples[i].features[k] - middle) / spread;
  }
  return rows;
}

cv::Mat labels_of(const std::vector<Example>& examples, const std::vector<std::string>& kinds) {
  cv::Mat labels(static_cast<int>(examples.size()), 1, CV_32S);
  for (int i = 0; i < labels.rows; ++i)
    labels.at<int>(i) = static_cast<int>(
        std::find(kinds.begin(), kinds.end(), examples[static_cast<std::size_t>(i)].object) - kinds.begin());
  return labels;
}

using Names = std::vector<std::string>;  // [judge]

Names by_us(const Split& parts, const std::vector<std::string>&) {
  const auto book = vision::ObjectBook::learn(parts.learn);
  EXPECT_TRUE(book);
  Names names;
  for (const Example& example : parts.judge) names.push_back(book->name(example.features).object);
  return names;
}

/// The nearest mean in the space of the discriminants.
Names by_lda(const Split& parts, const std::vector<std::string>& kinds) {
  const cv::Mat learn = rows_of(parts.learn, parts.learn), labels = labels_of(parts.learn, kinds);
  cv::LDA lda{learn, labels, static_cast<int>(kinds.size()) - 1};
  const cv::Mat in_space = lda.project(learn), asked = lda.project(rows_of(parts.judge, parts.learn));
  cv::Mat means = cv::Mat::zeros(static_cast<int>(kinds.size()), in_space.cols, CV_64F);
  for (int i = 0; i < in_space.rows; ++i) means.row(labels.at<int>(i)) += in_space.row(i) / static_cast<double>(kLearn);
  Names names;
  for (int i = 0; i < asked.rows; ++i) {
    int best = 0;
    for (int k = 1; k < means.rows; ++k)
      if (cv::norm(asked.row(i), means.row(k)) < cv::norm(asked.row(i), means.row(best))) best = k;
    names.push_back(kinds[static_cast<std::size_t>(best)]);
  }
  return names;
}

Names by_neighbours(const Split& parts, const std::vector<std::string>& kinds) {
  cv::Mat learn, asked, found;
  rows_of(parts.learn, parts.learn).convertTo(learn, CV_32F);
  rows_of(parts.judge, parts.learn).convertTo(asked, CV_32F);
  const auto nearest = cv::ml::KNearest::create();
  nearest->train(learn, cv::ml::ROW_SAMPLE, labels_of(parts.learn, kinds));
  nearest->findNearest(asked, 5, found);
  Names names;
  for (int i = 0; i < found.rows; ++i)
    names.push_back(kinds[static_cast<std::size_t>(std::lround(found.at<float>(i)))]);
  return names;
}

struct Rates {
  double mean = 0.0, spread = 0.0;
};

Rates judge(const char* who, const std::vector<Example>& examples,
            const std::function<Names(const Split&, const std::vector<std::string>&)>& name) {
  const auto kinds = kinds_of(examples);
  std::map<std::string, std::map<std::string, int>> confusion;
  std::vector<double> rates;
  for (int seed = 1; seed <= kRepetitions; ++seed) {
    const Split parts = split(examples, static_cast<std::uint64_t>(seed));
    const Names names = name(parts, kinds);
    int right = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
      ++confusion[parts.judge[i].object][names[i]];
      right += names[i] == parts.judge[i].object ? 1 : 0;
    }
    rates.push_back(static_cast<double>(right) / static_cast<double>(names.size()));
  }
  Rates result;
  for (const double rate : rates) result.mean += rate / kRepetitions;
  for (const double rate : rates) result.spread += std::pow(rate - result.mean, 2) / (kRepetitions - 1);
  result.spread = std::sqrt(result.spread);
  std::printf("\n%s: %.1f +- %.1f %% of %d repetitions; named (across) of what it is (down), %%\n%12s", who,
              100.0 * result.mean, 100.0 * result.spread, kRepetitions, "");
  for (const auto& kind : kinds) std::printf(" %9s", kind.c_str());
  for (const auto& of : kinds) {
    int all = 0;
    for (const auto& [kind, count] : confusion[of]) all += count;
    std::printf("\n%12s", of.c_str());
    for (const auto& kind : kinds) std::printf(" %9.0f", 100.0 * confusion[of][kind] / all);
  }
  std::printf("\n");
  return result;
}

TEST(ObjectsBesideOpenCv, KnowsThingsOfPhotographsAsWellAsOthersDo) {
  const auto examples = photographs();
  if (examples.empty()) GTEST_SKIP() << "no recorded data (DOCENT_DATA): no photographs of things";
  const Rates ours = judge("Gaussians with shrunk covariance", examples, by_us);
  const Rates lda = judge("OpenCV, linear discriminants", examples, by_lda);
  const Rates neighbours = judge("OpenCV, five nearest neighbours", examples, by_neighbours);
  EXPECT_GE(ours.mean, lda.mean - 0.02);
  EXPECT_GE(ours.mean, neighbours.mean - 0.02);
  EXPECT_GE(ours.mean, 0.5) << "one in five by chance";
}

TEST(ObjectsBesideOpenCv, SaysHowOftenAKindThatNobodyTaughtIsTakenForAKnownOne) {
  const auto examples = photographs();
  if (examples.empty()) GTEST_SKIP() << "no recorded data (DOCENT_DATA): no photographs of things";
  std::printf(
      "\nleft out     taken for a known one, and of the known ones named at all, %%, by the share of its own examples "
      "that is known\n");
  double own_before = 2.0, foreign_before = 2.0;
  for (const double known : {0.95, 0.8, 0.5}) {
    double foreign_mean = 0.0, own_mean = 0.0;
    for (const auto& kind : kinds_of(examples)) {
      double foreign = 0.0, own = 0.0, foreign_all = 0.0, own_all = 0.0;
      for (int seed = 1; seed <= kRepetitions; ++seed) {
        Split parts = split(examples, static_cast<std::uint64_t>(seed));
        std::erase_if(parts.learn, [&](const Example& example) { return example.object == kind; });
        const auto book = vision::ObjectBook::learn(parts.learn, {.known = known});
        ASSERT_TRUE(book);
        for (const Example& example : parts.judge) {
          const bool is_known = book->name(example.features).is_known;
          (example.object == kind ? foreign : own) += is_known ? 1.0 : 0.0;
          (example.object == kind ? foreign_all : own_all) += 1.0;
        }
      }
      std::printf("%.2f %-12s %4.0f %4.0f\n", known, kind.c_str(), 100.0 * foreign / foreign_all,
                  100.0 * own / own_all);
      foreign_mean += foreign / foreign_all / 5.0;
      own_mean += own / own_all / 5.0;
    }
    EXPECT_LT(foreign_mean, foreign_before);
    EXPECT_LT(own_mean, own_before);
    EXPECT_LT(foreign_mean, own_mean) << "what it was taught it knows more often than what it was not";
    foreign_before = foreign_mean;
    own_before = own_mean;
  }
}

}  // namespace
}  // namespace docent
