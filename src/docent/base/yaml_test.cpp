#include "docent/base/yaml.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "docent/base/text.h"

namespace docent {
namespace {

struct Inner {
  double weight = 2.0;
  template <class V>
  void visit(V& v) {
    v("weight", weight);
  }
};
struct Outer {
  std::string name = "none";
  std::vector<Inner> parts;
  int count = 1;
  template <class V>
  void visit(V& v) {
    v("name", name);
    v("parts", parts);
    v("count", count);
  }
};

std::string fault_of(const std::string& text) {
  const auto file = YamlFile::parse(text, "f.yaml");
  if (!file) return file.error().message;
  Outer outer;
  const auto result = read_yaml(*file, file->root(), outer);
  return result ? "" : result.error().message;
}

TEST(Yaml, ReadsStructsOverTheirDefaults) {
  const auto file = YamlFile::parse("name: a\nparts:\n  - {weight: 3}\n  - {}\n", "f.yaml").value();
  Outer outer;
  ASSERT_TRUE(read_yaml(file, file.root(), outer).has_value());
  EXPECT_EQ(outer.name, "a");
  ASSERT_EQ(outer.parts.size(), 2U);
  EXPECT_EQ(outer.parts[0].weight, 3.0);
  EXPECT_EQ(outer.parts[1].weight, 2.0);
  EXPECT_EQ(outer.count, 1);
}

TEST(Yaml, FaultsNameFileAndLine) {
  EXPECT_EQ(fault_of("name: a\nwieght: 3\n"), "f.yaml:2: unknown key 'wieght' (known: count, name, parts)");
  EXPECT_EQ(fault_of("name: a\n\ncount: many\n"), "f.yaml:3: expected a whole number, found 'many'");
  EXPECT_EQ(fault_of("parts:\n  - {weight: .nan}\n"), "f.yaml:2: expected a finite number");
  EXPECT_EQ(fault_of("parts: 3\n"), "f.yaml:1: expected a list");
  EXPECT_EQ(fault_of("count: 1\ncount: 2\n"), "f.yaml:2: key 'count' stands twice");
  EXPECT_TRUE(fault_of("name: [\n").starts_with("f.yaml:2: not valid YAML"));
  EXPECT_EQ(fault_of("- 1\n"), "f.yaml:1: expected a mapping (key: value)");
  EXPECT_EQ(fault_of("name: a\n---\ncount: 3\n"), "f.yaml:3: another YAML document begins here: one alone is read");
  EXPECT_EQ(fault_of("\xEF\xBB\xBF# of Windows\n---\nname: a\n"), fault_of("name: a\n"));
  EXPECT_EQ(fault_of("---\nname: a\n...\n---\n"), "") << "an empty one says nothing";
}

TEST(Yaml, AMisspeltKeyIsToldFromTheOneThatIsMeant) {
  EXPECT_EQ(fault_of("name: a\ncuont: 3\n"),
            "f.yaml:2: unknown key 'cuont'; did you mean 'count'? (known: count, name, parts)");
  const auto option = YamlFile::parse("count: 1\nnmae: a\n", "--set count=1").value();
  Outer outer;
  EXPECT_EQ(read_yaml(option, option.root(), outer).error().message,
            "--set count=1: unknown key 'nmae'; did you mean 'name'? (known: count, name, parts)")
      << "an option has no lines";
  EXPECT_TRUE(YamlFile::parse("a: [", "--set a").error().message.starts_with("--set a: not valid YAML"));
}

TEST(Yaml, WhatIsNoTextIsRefusedWithItsLine) {
  using std::string_literals::operator""s;
  const auto file = YamlFile::parse("leaf: 1\n\0\x1a"s, "picture.png");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().message, "picture.png:2: is no text file, and so no YAML file");
}

struct Numbers {
  std::vector<double> values;
  template <class V>
  void visit(V& v) {
    v("values", values);
  }
};

TEST(Yaml, AListThatIsWrittenIsReadAgain) {
  EXPECT_EQ(yaml_list({}), "[]");
  const std::vector<double> values{1.0, -0.25, 1.0 / 3.0, 2e-9, 1e15};
  EXPECT_EQ(yaml_list(values), "[1, -0.25, 0.333333333, 2e-09, 1e+15]");
  const auto file = YamlFile::parse("values: " + yaml_list(values) + "\n", "f.yaml").value();
  Numbers again;
  ASSERT_TRUE(read_yaml(file, file.root(), again));
  ASSERT_EQ(again.values.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(again.values[i], values[i], 1e-9 * std::abs(values[i]));
}

TEST(Yaml, FaultsStayOnOneLineWhateverTheFileSays) {
  EXPECT_EQ(fault_of("count: \"a\\nb\"\n"), "f.yaml:1: expected a whole number, found 'a b'");
  EXPECT_LT(fault_of("count: " + std::string(5000, 'x') + "\n").size(), 400U);
}

}  // namespace
}  // namespace docent
