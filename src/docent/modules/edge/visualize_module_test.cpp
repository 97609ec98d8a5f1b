#include "docent/modules/edge/visualize_module.h"

#include <gtest/gtest.h>

#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

/// `visualize`, and a viewer that keeps what it gets.
class Visualize : public testing::Test {
 protected:
  void start() {
    auto made = make_visualize({*bus_, museum_, config_, "", 1, true});
    ASSERT_TRUE(made) << made.error().message;
    module_ = std::move(*made);
    viewer_->subscribe<geometry_msgs::PoseArray>(topics::kBeliefPoses, [this](const auto& m) { clouds_.push_back(m); });
    viewer_->subscribe<nav2_msgs::ParticleCloud>(topics::kParticleCloud,
                                                 [this](const auto& m) { particles_.push_back(m); });
    viewer_->subscribe<diagnostic_msgs::DiagnosticArray>(topics::kDiagnostics,
                                                         [this](const auto& m) { diagnostics_.push_back(m); });
    viewer_->subscribe<visualization_msgs::MarkerArray>(topics::kPeopleMarkers,
                                                        [this](const auto& m) { people_.push_back(m); });
    viewer_->subscribe<visualization_msgs::MarkerArray>(topics::kMuseumMarkers,
                                                        [this](const auto& m) { museums_.push_back(m); });
  }
  /// Ten messages a second.
  void say(const docent_msgs::Belief& belief, const docent_msgs::People& people, int messages) {
    for (int i = 0; i < messages; ++i) {
      beliefs_publisher_.publish(belief);
      people_publisher_.publish(people);
      hub_.run_until(hub_.now() + seconds(0.1));
    }
  }
  static docent_msgs::Belief belief_at(float x) {
    docent_msgs::Belief belief;
    belief.header.frame_id = "map";
    belief.header.stamp.sec = 5;
    belief.cell_size = 0.2F;
    belief.cells.push_back({x, 1.0F, 0.0F, 1.0F});
    return belief;
  }
  static docent_msgs::People one_person() {
    docent_msgs::People people;
    people.header.frame_id = "map";
    people.people.push_back({1, 2.0F, 3.0F, 0.5F, 0.0F});
    return people;
  }

  transport::VirtualTimeHub hub_;
  std::unique_ptr<transport::Bus> bus_ = hub_.connect("visualize");
  std::unique_ptr<transport::Bus> viewer_ = hub_.connect("viewer");
  std::unique_ptr<transport::Bus> robot_ = hub_.connect("robot");
  transport::Publisher<docent_msgs::Belief> beliefs_publisher_ = robot_->publisher(topics::kBelief);
  transport::Publisher<docent_msgs::People> people_publisher_ = robot_->publisher(topics::kPeople);
  museum::Museum museum_;
  robot::RobotConfig config_;
  std::unique_ptr<Module> module_;
  std::vector<geometry_msgs::PoseArray> clouds_;
  std::vector<nav2_msgs::ParticleCloud> particles_;
  std::vector<diagnostic_msgs::DiagnosticArray> diagnostics_;
  std::vector<visualization_msgs::MarkerArray> people_;
  std::vector<visualization_msgs::MarkerArray> museums_;
};

TEST_F(Visualize, ShowsTheBeliefWhenItChangesAndNotMoreOftenThanIsAskedFor) {
  ASSERT_TRUE(config_.set("visualize.belief_poses=40"));
  ASSERT_TRUE(config_.set("visualize.belief_period=0.5"));
  start();
  say(belief_at(1.0F), {}, 30);
  ASSERT_EQ(clouds_.size(), 1U) << "the same belief is not told again";
  EXPECT_EQ(clouds_[0].header.frame_id, "map");
  EXPECT_EQ(clouds_[0].header.stamp.sec, 5);
  ASSERT_EQ(clouds_[0].poses.size(), 40U);
  for (const auto& pose : clouds_[0].poses) EXPECT_NEAR(pose.position.x, 1.0, 0.1001);
  ASSERT_EQ(particles_.size(), 1U);
  EXPECT_EQ(particles_[0].header.frame_id, "map");
  ASSERT_EQ(particles_[0].particles.size(), 40U);
  for (const auto& particle : particles_[0].particles) {
    EXPECT_NEAR(particle.pose.position.x, 1.0, 0.1001);
    EXPECT_DOUBLE_EQ(particle.weight, 1.0 / 40.0);
  }
  for (int i = 0; i < 30; ++i) say(belief_at(2.0F + 0.01F * static_cast<float>(i)), {}, 1);
  EXPECT_EQ(clouds_.size(), 7U) << "one each half second of three";
  say(belief_at(9.0F), {}, 6);
  ASSERT_EQ(clouds_.size(), 8U) << "the last change is told, if late";
  EXPECT_NEAR(clouds_.back().poses[0].position.x, 9.0, 0.1001);
}

TEST_F(Visualize, ShowsPeopleWhileThereAreAny) {
  start();
  say({}, one_person(), 20);
  EXPECT_EQ(people_.size(), 10U) << "five a second of ten";
  ASSERT_EQ(people_.front().markers.size(), 2U);
  EXPECT_EQ(people_.front().markers[0].header.frame_id, "map");
  const std::size_t before = people_.size();
  say({}, {}, 20);
  EXPECT_EQ(people_.size(), before);
}

TEST_F(Visualize, TellsTheDiagnosticsOnceASecond) {
  start();
  docent_msgs::Health health;
  health.module = "localize";
  health.state = "degraded";
  health.reason = "no scan";
  robot_->publisher(topics::kHealth).publish(health);
  hub_.run_until(time_from_seconds(3.5));
  ASSERT_EQ(diagnostics_.size(), 3U);
  ASSERT_EQ(diagnostics_[0].status.size(), 1U);
  EXPECT_EQ(diagnostics_[0].status[0].level, 1);
  EXPECT_EQ(diagnostics_[0].status[0].message, "no scan");
  EXPECT_EQ(diagnostics_[2].status[0].level, 3) << "it has fallen silent";
}

TEST_F(Visualize, ShowsTheMuseumToWhoComesLate) {
  museum_.area = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}};
  start();
  hub_.run_until(time_from_seconds(1.0));
  ASSERT_EQ(museums_.size(), 1U);
  EXPECT_EQ(museums_[0].markers.size(), 1U);
}

TEST_F(Visualize, SwitchedOffItIsSilent) {
  ASSERT_TRUE(config_.set("visualize.enabled=false"));
  start();
  say(belief_at(1.0F), one_person(), 20);
  EXPECT_TRUE(clouds_.empty());
  EXPECT_TRUE(people_.empty());
  EXPECT_TRUE(museums_.empty());
  EXPECT_TRUE(diagnostics_.empty());
  EXPECT_TRUE(hub_.topics_published_by("visualize").empty());
}

TEST_F(Visualize, DrawsNothingBeyondAllBounds) {
  start();
  auto belief = belief_at(1e7F);
  belief.cell_size = 1e7F;
  auto people = one_person();
  people.people[0].x = people.people[0].vx = 1e7F;
  say(belief, people, 10);
  EXPECT_TRUE(clouds_.empty());
  EXPECT_TRUE(people_.empty());
}

TEST_F(Visualize, WildParametersAreFaults) {
  for (const char* setting : {"visualize.belief_poses=0", "visualize.belief_period=0", "visualize.people_period=0.6"}) {
    robot::RobotConfig config;
    ASSERT_TRUE(config.set(setting));
    EXPECT_FALSE(make_visualize({*bus_, museum_, config, "", 1, true})) << setting;
  }
}

}  // namespace
}  // namespace docent::modules
