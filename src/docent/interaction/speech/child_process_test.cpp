#include "docent/interaction/speech/child_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

namespace docent::interaction::child_process_test {
namespace {

int status_of(pid_t child) {
  int status = -1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(ChildProcess, RunsAProgramWithItsArguments) {
  const auto child = start_quietly({"test", "a b", "=", "a b"});
  ASSERT_TRUE(child) << child.error().message;
  EXPECT_EQ(status_of(*child), 0);
  const auto other = start_quietly({"test", "a", "=", "$HOME"});  // there is no shell
  ASSERT_TRUE(other);
  EXPECT_EQ(status_of(*other), 1);
}

TEST(ChildProcess, AMissingProgramIsNamed) {
  const auto child = start_quietly({"/nonexistent/program"});
  ASSERT_FALSE(child);
  EXPECT_NE(child.error().message.find("/nonexistent/program"), std::string::npos);
}

}  // namespace
}  // namespace docent::interaction::child_process_test
