#include "docent/modules/web/operators/maps_desk.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/telepresence/site.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

nav_msgs::OccupancyGrid grid(std::vector<std::int8_t> data) {
  nav_msgs::OccupancyGrid map;
  map.header.stamp = to_message(time_from_seconds(7.0));
  map.info.resolution = 0.5F;
  map.info.width = 3;
  map.info.height = 1;
  map.info.origin.position.x = 2.0;
  map.data = std::move(data);
  return map;
}

TEST(MapsDesk, ShowsTheValueFunctionAndWhatStandsThereNow) {
  transport::VirtualTimeHub hub;
  const auto robot = hub.connect("robot");
  const auto bus = hub.connect("web");
  MapsDesk desk{*bus};
  const auto server =
      telepresence::WebServer::start({}, std::make_shared<telepresence::Site>(), telepresence::WebServerHooks{});
  ASSERT_TRUE(server) << server.error().message;
  desk.begin(**server, 3);
  const auto shown = [&](const char* which) {
    hub.run_until(hub.now() + seconds(1.1));
    const auto raster = nlohmann::json::parse(desk.document()).at(which);
    return raster.at("levels").get<std::string>() + " " + std::to_string(raster.at("columns").get<int>());
  };
  EXPECT_EQ(shown("value"), " 0");
  robot->publisher(topics::kValueFunction).publish(grid({0, 100, -1}));
  EXPECT_EQ(shown("value"), "/wEA 3") << "255, 1, 0";
  robot->publisher(topics::kLiveMap).publish(grid({0, -1, 100}));
  EXPECT_EQ(shown("live"), "AAD/ 3") << "0, 0, 255";

  docent_msgs::LiveMapUpdate update;
  update.base = to_message(time_from_seconds(7.0));
  update.number = 1;
  update.width = update.height = 1;
  update.data = {100};
  const auto updates = robot->publisher(topics::kLiveMapUpdate);
  updates.publish(update);
  EXPECT_EQ(shown("live"), "/wD/ 3");
  update.number = 3;  // one is missing: what it says cannot be trusted
  update.data = {0};
  updates.publish(update);
  EXPECT_EQ(shown("live"), "/wD/ 3");
  update.number = 2;  // beside the map
  update.x = -5;
  updates.publish(update);
  EXPECT_EQ(shown("live"), "/wD/ 3");
}

}  // namespace
}  // namespace docent::modules
