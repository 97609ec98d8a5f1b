#include "docent/base/instruction_set.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

TEST(InstructionSet, PlainIsEverywhereAndAutoIsTheWidest) {
  const auto sets = instruction_sets();
  ASSERT_FALSE(sets.empty());
  EXPECT_EQ(sets.front(), InstructionSet::plain);
  ASSERT_TRUE(instruction_set_of("auto"));
  EXPECT_EQ(*instruction_set_of("auto"), sets.back());
}

TEST(InstructionSet, ASetIsFoundByItsNameIfTheProcessorHasIt) {
  for (const InstructionSet set : instruction_sets()) {
    const auto found = instruction_set_of(std::string{name_of(set)});
    ASSERT_TRUE(found) << name_of(set);
    EXPECT_EQ(*found, set);
  }
  if (instruction_sets().back() != InstructionSet::avx512) {
    EXPECT_FALSE(instruction_set_of("avx512"));
  }
  EXPECT_FALSE(instruction_set_of("sse9"));
  EXPECT_FALSE(instruction_set_of(""));
}

}  // namespace
}  // namespace docent
