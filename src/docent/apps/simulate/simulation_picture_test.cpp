#include "docent/apps/simulate/simulation_picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/apps/shared/deployment.h"
#include "docent/base/files.h"
#include "docent/messages/conversions.h"

namespace docent::apps::simulate_command {
namespace {

TEST(SimulationPicture, HasTheSpanOfTimeAndSaysWhatIsDrawn) {
  SimulationPicture picture;
  for (int i = 0; i <= 100; ++i) {
    auto state = std::make_shared<docent_msgs::TrueState>();
    state->header.stamp = to_message(time_from_seconds(0.9 * i));
    state->x = 5.0 + 0.05 * i;
    state->y = 4.0;
    picture.add(transport::topic_info(topics::kTrueState), state);
  }
  const museum::Museum museum = museum::load_museum(default_museum()).value();
  const auto path = std::filesystem::temp_directory_path() / ("docent_way_" + std::to_string(getpid()) + ".svg");
  const auto svg_of = [&](const SimulationPicture& drawn) {
    EXPECT_TRUE(drawn.save(museum, path));
    const auto svg = read_file(path);
    std::filesystem::remove(path);
    return svg ? *svg : "";
  };
  const std::string svg = svg_of(picture);
  for (const char* word : {"<title>bonn, 0 to 90 s</title>", "x [m], y [m], time [s]",
                           "true trajectory, coloured by time", "start", "end", "exhibit", "hazard", "operating area"})
    EXPECT_NE(svg.find(word), std::string::npos) << word;
  EXPECT_EQ(svg.find("contact"), std::string::npos);
  auto contact = std::make_shared<docent_msgs::TrueContact>();
  contact->x = 6.0;
  contact->y = 4.0;
  picture.add(transport::topic_info(topics::kTrueContact), contact);
  EXPECT_NE(svg_of(picture).find("contact"), std::string::npos);
  EXPECT_FALSE(picture.save(museum, "way.jpg"));
}

}  // namespace
}  // namespace docent::apps::simulate_command
