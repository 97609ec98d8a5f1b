#include "docent/task_control/golog/prolog_text.h"

#include <gtest/gtest.h>

namespace docent::task_control {
namespace {

TEST(PrologText, QuotesWhateverItHolds) {
  EXPECT_EQ(prolog_atom("tv-sat"), "'tv-sat'");
  EXPECT_EQ(prolog_atom("it's\\"), "'it\\'s\\\\'");
  EXPECT_EQ(prolog_string("a\n\"b\""), "\"a\\xa\\\\\"b\\\"\"");
  EXPECT_EQ(prolog_term({"drive", {"e1", 2.5}}), "'drive'('e1',2.5)");
  EXPECT_EQ(prolog_term({"stop"}), "'stop'");
  EXPECT_EQ(prolog_atoms(std::vector<std::string>{"a", "b"}), "['a','b']");
  EXPECT_EQ(prolog_terms({}), "[]");
}

TEST(PrologText, NumbersAreFloats) {
  EXPECT_EQ(prolog_number(3.0), "3.0");
  EXPECT_EQ(prolog_number(1e22), "1.0e+22");
  EXPECT_EQ(prolog_number(-0.1), "-0.10000000000000001");
}

TEST(PrologText, ReadsWhatIsSaid) {
  std::string read = "l3:s6:größe;s0:n2.5;s1:x";
  auto value = take_value(read);
  ASSERT_TRUE(value && *value);
  EXPECT_EQ(texts_of(**value), (std::vector<std::string>{"größe;", "", "2.5"}));
  EXPECT_EQ(read, "s1:x");
}

TEST(PrologText, WaitsForTheRest) {
  const std::string whole = "l2:s3:eäeln1e3;s2:üü";
  std::string read;
  for (std::size_t i = 0; i + 1 < std::string{"l2:s3:eäen1e3;"}.size(); ++i) {
    read = std::string{"l2:s3:eäen1e3;"}.substr(0, i);
    const std::string before = read;
    const auto value = take_value(read);
    ASSERT_TRUE(value) << before;
    EXPECT_FALSE(*value) << before;
    EXPECT_EQ(read, before);
  }
  read = whole;
  EXPECT_FALSE(take_value(read));  // l without a length
}

TEST(PrologText, RefusesWhatIsNoValue) {
  for (std::string text : {"x", "s:a", "s-1:a", "s1234567890:a", "nx;", "ninf;", "nnan;",
                           "l99999999999:", "l1:l1:l1:l1:l1:l1:l1:l1:l1:l1:n1;"})
    EXPECT_FALSE(take_value(text)) << text;
}

TEST(PrologText, ActionsHaveNamesAndPlainArguments) {
  const auto said = [](std::string text) { return term_of(*take_value(text).value()); };
  EXPECT_EQ(said("l3:s5:drives2:e1n2;").value(), (GologTerm{"drive", {"e1", 2.0}}));
  EXPECT_EQ(said("l0:").error().message, "an action has no name");
  EXPECT_EQ(said("l1:n3;").error().message, "an action has no name");
  EXPECT_EQ(said("l2:s1:al0:").error().message, "a: argument 1 is neither a name nor a number");
}

}  // namespace
}  // namespace docent::task_control
