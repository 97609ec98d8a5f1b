#include "docent/vision/objects/object_book.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "docent/base/random.h"

namespace docent::vision {
namespace {

namespace object_book_test {

/// Of a class whose features are all about `middle`, the first and the second going together.
Example drawn(const std::string& object, double middle, Rng& rng) {
  Example example{object, {}};
  for (double& feature : example.features) feature = middle + rng.normal();
  example.features[1] = example.features[0] + 0.2 * rng.normal();
  return example;
}

std::vector<Example> two_kinds(std::size_t each, std::uint64_t seed) {
  Rng rng{seed};
  std::vector<Example> examples;
  for (std::size_t i = 0; i < each; ++i) {
    examples.push_back(drawn("can", 0.0, rng));
    examples.push_back(drawn("wad", 1.5, rng));
  }
  return examples;
}

TEST(ObjectBook, TellsTwoKindsApartAndAThirdFromBoth) {
  const auto book = ObjectBook::learn(two_kinds(30, 1));
  ASSERT_TRUE(book) << book.error().message;
  EXPECT_EQ(book->objects(), (std::vector<std::string>{"can", "wad"}));
  Rng rng{2};
  int right = 0, known = 0, foreign = 0;
  for (int i = 0; i < 200; ++i) {
    const Example can = drawn("can", 0.0, rng);
    const auto finding = book->name(can.features);
    right += finding.object == "can" ? 1 : 0;
    known += finding.is_known ? 1 : 0;
    foreign += book->name(drawn("cat", 6.0, rng).features).is_known ? 1 : 0;
  }
  EXPECT_GT(right, 190);
  EXPECT_GT(known, 130);
  EXPECT_EQ(foreign, 0);
}

TEST(ObjectBook, AFeatureThatNeverVariesIsNoDivisionByNothing) {
  auto examples = two_kinds(12, 3);
  for (Example& example : examples) example.features[5] = 7.0;
  const auto book = ObjectBook::learn(examples);
  ASSERT_TRUE(book);
  const auto finding = book->name(examples[0].features);
  EXPECT_EQ(finding.object, "can");
  EXPECT_TRUE(std::isfinite(finding.distance));
}

TEST(ObjectBook, SaysWhatIsMissing) {
  EXPECT_EQ(ObjectBook::learn(two_kinds(5, 1)).error().message,
            "can: 5 pictures; it takes at least 8, better 30 to 50");
  Rng rng{1};
  const std::vector<Example> one_kind(20, drawn("can", 0.0, rng));
  EXPECT_EQ(ObjectBook::learn(one_kind).error().message,
            "there is only one kind of object: it takes two to tell them apart");
}

TEST(ObjectBook, IsTheSameAfterItsFile) {
  const auto path = std::filesystem::path{testing::TempDir()} / "book.json";
  const auto examples = two_kinds(20, 5);
  const auto book = ObjectBook::learn(examples);
  ASSERT_TRUE(book->save(path));
  const auto again = ObjectBook::load(path);
  ASSERT_TRUE(again) << again.error().message;
  for (const Example& example : examples) {
    const auto a = book->name(example.features);
    const auto b = again->name(example.features);
    EXPECT_EQ(a.object, b.object);
    EXPECT_EQ(a.is_known, b.is_known);
    EXPECT_EQ(a.likelihoods, b.likelihoods);
  }
  for (const char* text : {"", "{}", "[1]", R"({"format": "docent object book 1", "features": []})"}) {
    std::ofstream{path} << text;
    const auto refused = ObjectBook::load(path);
    ASSERT_FALSE(refused) << text;
    EXPECT_EQ(refused.error().message.rfind(path.string() + ": ", 0), 0U) << refused.error().message;
  }
  std::remove(path.c_str());
}

}  // namespace object_book_test
}  // namespace
}  // namespace docent::vision
