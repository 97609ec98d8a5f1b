#include "docent/modules/host/process_class.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

namespace docent::modules {
namespace {

/// The exit code of a process that does this; -signal.
int result_of(const std::function<int()>& action) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    _exit(action());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

bool may_be_realtime() {
  return result_of([] {
           sched_param wanted{};
           wanted.sched_priority = 1;
           return sched_setscheduler(0, SCHED_RR, &wanted);
         }) == 0;
}

TEST(ProcessClass, IsEnteredWhereItMayBeAndNamedWhereItMayNot) {
  const int told = result_of([] {
    const bool is_told = !enter_process_class({}).empty();
    return is_told == (sched_getscheduler(0) == SCHED_RR) ? 1 : 0;
  });
  EXPECT_EQ(told, 0) << "a class that is not had is told, and no other";
}

TEST(ProcessClass, WhoMayNothingIsToldSoAndGoesOn) {
  const int result = result_of([] {
    const rlimit nothing{0, 0};
    if (setrlimit(RLIMIT_RTPRIO, &nothing) != 0 || setrlimit(RLIMIT_NICE, &nothing) != 0) return 2;
    if (geteuid() == 0 && seteuid(65534) != 0) return 3;  // nobody: without CAP_SYS_NICE
    const std::string told = enter_process_class({});
    if (told.find("no real-time class") == std::string::npos) return 4;
    if (told.find("late") == std::string::npos) return 5;
    return sched_getscheduler(0) == SCHED_OTHER ? 0 : 6;
  });
  EXPECT_EQ(result, 0);
}

TEST(ProcessClass, NothingIsAskedForWhereTheConfigurationSaysSo) {
  ProcessParams params;
  params.urgent = "normal";
  EXPECT_EQ(
      result_of([&] { return enter_process_class(params).empty() && sched_getscheduler(0) == SCHED_OTHER ? 0 : 1; }),
      0);
}

TEST(ProcessClass, ARunawayIsEnded) {
  if (!may_be_realtime()) GTEST_SKIP() << "no real-time class here";
  ProcessParams params;
  params.most_ms = 50.0;
  const int result = result_of([&] {
    if (!enter_process_class(params).empty()) return 1;
    volatile unsigned turns = 0;
    for (const clock_t begin = clock(); clock() - begin < 5 * CLOCKS_PER_SEC;) turns = turns + 1;
    return 0;
  });
  EXPECT_TRUE(result == -SIGXCPU || result == -SIGKILL) << result;
}

TEST(ProcessParams, RefuseWhatMakesNoSense) {
  EXPECT_TRUE(ProcessParams{}.validate().has_value());
  EXPECT_FALSE((ProcessParams{"fast", 10, 500.0}).validate().has_value());
  EXPECT_FALSE((ProcessParams{"realtime", 0, 500.0}).validate().has_value());
  EXPECT_FALSE((ProcessParams{"realtime", 10, 0.0}).validate().has_value());
}

}  // namespace
}  // namespace docent::modules
