#include "docent/telepresence/limits/descriptors.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace docent::telepresence {
namespace {

TEST(Descriptors, AreRaisedAsFarAsTheSystemLets) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  if (before.rlim_max < 700) GTEST_SKIP() << "skipped: the system lets this process open fewer than 700 files";
  rlimit few = before;
  few.rlim_cur = 600;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  EXPECT_EQ(allow_descriptors(650), 650U);
  EXPECT_EQ(allow_descriptors(100), 650U) << "never fewer";
  if (before.rlim_max != RLIM_INFINITY) {
    EXPECT_EQ(allow_descriptors(before.rlim_max + 1), before.rlim_max);
  }
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
}

}  // namespace
}  // namespace docent::telepresence
