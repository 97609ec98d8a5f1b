#include "docent/telepresence/server/router.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

class RouterTest : public testing::Test {
 protected:
  RouterTest() { site_->set_document("/", "text/html; charset=utf-8", "<p>hello"); }
  [[nodiscard]] Route route(const RouteRequest& request, bool is_full = false) const {
    return Router{site_, {"museum.test"}, "0a1b"}.route(request, is_full);
  }
  [[nodiscard]] int status(const RouteRequest& request, bool is_full = false) const {
    const Route found = route(request, is_full);
    const auto* answer = std::get_if<HttpAnswer>(&found);
    return answer == nullptr ? 101 : answer->reply.status;
  }
  std::shared_ptr<Site> site_ = std::make_shared<Site>();
};

TEST_F(RouterTest, TheSiteAnswersGetAndHead) {
  for (const char* method : {"GET", "HEAD"}) {
    const HttpAnswer answer = std::get<HttpAnswer>(route({method, "/", false, {}}));
    EXPECT_EQ(answer.reply.status, 200);
    EXPECT_EQ(*answer.reply.body, "<p>hello");
    EXPECT_EQ(answer.is_head, std::string_view{method} == "HEAD");
    EXPECT_FALSE(answer.is_last);
    EXPECT_EQ(status({method, "/nothing", false, {}}), 404);
  }
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", ""}) {
    const HttpAnswer answer = std::get<HttpAnswer>(route({method, "/", false, {}}));
    EXPECT_EQ(answer.reply.status, 405) << method;
    EXPECT_TRUE(answer.is_last) << method;
  }
}

TEST_F(RouterTest, TheChannelIsOpenedOnItsPathAlone) {
  const Opening own{"http://robot.test", "robot.test", ""};
  EXPECT_EQ(std::get<OpenLive>(route({"GET", "/live", true, own})).role, Role::visitor);
  EXPECT_EQ(status({"GET", "/other", true, own}), 404);
  EXPECT_EQ(status({"GET", "/live", true, {"http://evil.test", "robot.test", ""}}), 403);
  EXPECT_EQ(status({"GET", "/live", true, {"http://museum.test", "robot.test", ""}}), 101);
  EXPECT_EQ(status({"GET", "/live", true, own}, true), 503);
  EXPECT_EQ(status({"GET", "/live", false, own}), 404) << "no document lies there";
}

TEST_F(RouterTest, FoxgloveIsForProgramsOfThisComputer) {
  const Opening program{"", "127.0.0.1:8080", ""};
  EXPECT_TRUE(std::holds_alternative<OpenFoxglove>(route({"GET", "/foxglove", true, program, true})));
  EXPECT_EQ(status({"GET", "/foxglove", true, program, false}), 403);
  EXPECT_EQ(status({"GET", "/foxglove", true, {"http://evil.test", "127.0.0.1:8080", ""}, true}), 403);
  EXPECT_EQ(status({"GET", "/foxglove", false, program, true}), 404) << "no document lies there";
  EXPECT_EQ(status({"GET", "/foxglove?live", true, program, true}), 404);
}

TEST_F(RouterTest, TheDeskAnswersItsPathsAndAdmitsOperators) {
  for (const char* method : {"GET", "POST", "PUT", "DELETE", "PATCH"})
    EXPECT_TRUE(std::holds_alternative<CallApi>(route({method, "/api/v1/forum?before=1", false, {}}))) << method;
  EXPECT_EQ(status({"GET", "/api/v1", false, {}}), 404);
  EXPECT_EQ(status({"GET", "/api/museum.json", false, {}}), 404);
  const Opening own{"http://robot.test", "robot.test", ""};
  EXPECT_TRUE(std::holds_alternative<OpenOperate>(route({"GET", "/operate", true, own})));
  EXPECT_EQ(status({"GET", "/operate", true, {"http://evil.test", "robot.test", ""}}), 403);
  EXPECT_EQ(status({"GET", "/operate?x", true, own}), 404);
  EXPECT_EQ(status({"GET", "/operate", false, own}), 404) << "no document lies there";
}

TEST_F(RouterTest, AFarGatewayHasADoorOfItsOwn) {
  EXPECT_EQ(status({"GET", "/uplink?key=5e6f", true, {"", "robot.test", ""}}), 404);
}

TEST_F(RouterTest, TheRobotsScreenComesWithItsKey) {
  const Opening own{"http://robot.test", "robot.test", ""};
  EXPECT_EQ(std::get<OpenLive>(route({"GET", "/live?screen=0a1b", true, own})).role, Role::kiosk);
  for (const char* target : {"/live?screen=0a1c", "/live?screen=0a1b&", "/live?screen=0a1"})
    EXPECT_EQ(status({"GET", target, true, own}), 403) << target;
  for (const char* target : {"/live?screen=", "/live?", "/live?key=0a1b"})
    EXPECT_EQ(status({"GET", target, true, own}), 404) << target;
  EXPECT_EQ(status({"GET", "/live?screen=0a1b", true, {"http://evil.test", "robot.test", ""}}), 403);
}

}  // namespace
}  // namespace docent::telepresence
