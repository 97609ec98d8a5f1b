#include "docent/modules/guide/mingling.h"

#include <gtest/gtest.h>

#include "docent/base/files.h"
#include "docent/modules/guide/tour_rehearsal_for_test.h"

namespace docent::modules {
namespace {

/// A person who stands before the robot, as the tracker sees it.
class Person {
 public:
  explicit Person(transport::VirtualTimeHub& hub) : bus_{hub.connect("people")} {
    odometry_ = bus_->publisher(topics::kOdometry);
    people_ = bus_->publisher(topics::kPeopleInOdom);
    bus_->every(seconds(0.25), [this] {
      odometry_.publish({});
      docent_msgs::People people;
      if (is_there) people.people.push_back({7, 1.2F, 0.3F, 0.0F, 0.0F});
      people_.publish(std::move(people));
    });
  }
  bool is_there = false;

 private:
  std::unique_ptr<transport::Bus> bus_;
  transport::Publisher<nav_msgs::Odometry> odometry_;
  transport::Publisher<docent_msgs::People> people_;
};

TEST(Mingling, APhaseBeginsWhenSomebodyIsThereIsRememberedAndEndsWithAWish) {
  Rehearsal rehearsal{31, "mingling"};
  Person person{rehearsal.hub};
  rehearsal.run_for(60);
  EXPECT_EQ(rehearsal.mission.phase, "idle");
  EXPECT_EQ(rehearsal.task.kind, "") << "nobody is there";
  person.is_there = true;
  rehearsal.run_for(5);
  ASSERT_EQ(rehearsal.task.kind, "mingle");
  EXPECT_TRUE(parse<GazeStrategy>(rehearsal.task.gaze));
  EXPECT_TRUE(parse<Mood>(rehearsal.task.face));
  EXPECT_TRUE(parse<SpeechAct>(rehearsal.task.speech));
  EXPECT_EQ(rehearsal.mission.phase, "idle");
  EXPECT_EQ(rehearsal.task_state.look, "company");
  rehearsal.run_for(58);
  ASSERT_EQ(rehearsal.events_of("attraction_trial").size(), 1U);
  EXPECT_GT(rehearsal.events.back().value, 0.0) << "somebody was near all the time";

  while (rehearsal.task.kind != "mingle") rehearsal.run_for(1);
  rehearsal.run_for(20);
  rehearsal.kill("mission");
  rehearsal.run_for(1);
  rehearsal.start("mission");
  rehearsal.run_for(5);
  EXPECT_EQ(rehearsal.events_of("attraction_trial").size(), 1U) << "nobody knows how the rest of it went";
  while (rehearsal.task.kind != "mingle") rehearsal.run_for(1);
  rehearsal.run_for(20);
  rehearsal.client.wish_for("r1", "exhibit", "breeze");
  rehearsal.run_for(1);
  EXPECT_EQ(rehearsal.task.kind, "visit");
  EXPECT_EQ(rehearsal.events_of("attraction_trial").size(), 2U);
}

TEST(Mingling, ADamagedMemoryIsSetAsideAndSaid) {
  const auto state = std::filesystem::temp_directory_path() / ("docent-mingling-" + std::to_string(getpid()));
  std::filesystem::create_directories(state);
  ASSERT_TRUE(write_file_atomically(state / "attraction.json", "{", Survives::process_death));
  transport::VirtualTimeHub hub;
  const auto bus = hub.connect("mission");
  museum::Museum museum;
  robot::RobotConfig config;
  const Mingling mingling{{*bus, museum, config, state, 1, true}, {}};
  EXPECT_NE(mingling.fault().find("attraction.json.damaged"), std::string::npos) << mingling.fault();
  EXPECT_TRUE(std::filesystem::exists(state / "attraction.json.damaged"));
  std::filesystem::remove_all(state);
}

TEST(MinglingParams, HaveBounds) {
  EXPECT_TRUE(MinglingParams{}.validate());
  MinglingParams params;
  params.around_m = 0.0;
  EXPECT_FALSE(params.validate());
}

}  // namespace
}  // namespace docent::modules
