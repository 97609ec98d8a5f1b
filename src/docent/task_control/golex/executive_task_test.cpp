#include "docent/task_control/golex/executive_task.h"

#include <gtest/gtest.h>

#include "docent/task_control/golex/executive_fixture.h"

namespace docent::task_control {
namespace {

using GreetingTest = ExecutiveTest;

TEST_F(GreetingTest, WhoFollowsATourIsGreetedOnce) {
  const auto stop = [&](const std::string& id) {
    ExecutiveTask task = visit(id);
    task.order.tour_id = "space";
    return task;
  };
  start(stop("t1"));
  EXPECT_EQ(said.back().id, "t1/greeting");
  start(visit("t2"));  // for somebody else, on the way
  start(stop("t3"));
  EXPECT_EQ(said.back().id, "t3/announcement") << "they came along";
  start({{"c", TaskKind::charge, "", {3, 4, {}}, "en", false, "space"}, "", "", ""});
  start(stop("t4"));
  EXPECT_EQ(said.back().id, "t4/announcement") << "they waited at the charger";
  start({{"d", TaskKind::charge, "", {3, 4, {}}, "en", false, ""}, "", "", ""});
  start(stop("t5"));
  EXPECT_EQ(said.back().id, "t5/greeting") << "it was not for them that it said a word, and they are others";
  start({{"h", TaskKind::home, "", {3, 4, {}}, "en", false, ""}, "", "", ""});
  start(stop("t6"));
  EXPECT_EQ(said.back().id, "t6/greeting") << "it came from home";
}

}  // namespace
}  // namespace docent::task_control
