#include "docent/modules/edge/visualize_module.h"

#include <algorithm>
#include <optional>

#include "docent/messages/conversions.h"
#include "docent/visualization/belief_sample.h"
#include "docent/visualization/diagnostics.h"
#include "docent/visualization/museum_markers.h"
#include "docent/visualization/people_markers.h"

namespace docent::modules {
namespace {

constexpr Duration kDiagnosticsPeriod = std::chrono::seconds{1};  // what ROS 2's own drivers keep to

/// Section `visualize`: what rviz2, Foxglove and Lichtblick are shown.
struct VisualizeParams {
  bool enabled = true;         ///< false: nothing is read and nothing is published
  int belief_poses = 300;      ///< 1..5000: of the sample of the belief; more than some hundred arrows hide one another
  double belief_period = 0.5;  ///< [s], > 0: from one sample to the next at least; eyes need no more
  double people_period = 0.15;  ///< [s], > 0, <= 0.5: from one set of markers to the next, which live for 1 s
  template <class V>
  void visit(V& v) {
    v("enabled", enabled);
    v("belief_poses", belief_poses);
    v("belief_period", belief_period);
    v("people_period", people_period);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(belief_poses >= 1 && belief_poses <= 5000)) return fail("belief_poses must be 1..5000");
    if (!(belief_period > 0.0)) return fail("belief_period must be > 0");
    if (!(people_period > 0.0 && people_period <= 0.5)) return fail("people_period must be > 0 and <= 0.5");
    return {};
  }
};

/// Whether something is due again, once a period at most.
class Pace {
 public:
  explicit Pace(double period) : period_{seconds(period)} {}
  [[nodiscard]] bool is_due(Time now) const { return !last_ || now - *last_ >= period_; }
  void done(Time now) { last_ = now; }

 private:
  Duration period_;
  std::optional<Time> last_;
};

bool is_same(const Pose2& a, const Pose2& b) {
  return a.x == b.x && a.y == b.y && a.theta.radians() == b.theta.radians();
}

class VisualizeModule final : public Module {
 public:
  VisualizeModule(const ModuleContext& context, const VisualizeParams& params)
      : bus_{context.bus},
        params_{params},
        cloud_{bus_.publisher(topics::kParticleCloud)},
        poses_{bus_.publisher(topics::kBeliefPoses)},
        people_{bus_.publisher(topics::kPeopleMarkers)} {
    bus_.publisher(topics::kMuseumMarkers).publish(visualization::museum_markers(context.museum));
    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) { show(belief); });
    bus_.subscribe<docent_msgs::People>(topics::kPeople, [this](const auto& people) { show(people); });
    bus_.subscribe<docent_msgs::Health>(topics::kHealth,
                                        [this](const auto& health) { diagnostics_.hear(health, bus_.now()); });
    bus_.every(kDiagnosticsPeriod,
               [this, out = bus_.publisher(topics::kDiagnostics)] { publish(out, diagnostics_.message(bus_.now())); });
  }

 private:
  void show(const docent_msgs::Belief& belief) {
    const Time now = bus_.now();
    if (!belief_pace_.is_due(now)) return;
    auto sample = visualization::belief_sample(belief, params_.belief_poses);
    if (std::equal(sample.begin(), sample.end(), shown_.begin(), shown_.end(), is_same)) return;
    nav2_msgs::ParticleCloud cloud;
    geometry_msgs::PoseArray poses;
    cloud.header = poses.header = belief.header;
    for (const Pose2& pose : sample) {
      poses.poses.push_back(to_message(pose));
      cloud.particles.push_back({poses.poses.back(), 1.0 / static_cast<double>(sample.size())});
    }
    shown_ = std::move(sample);
    belief_pace_.done(now);
    publish(cloud_, std::move(cloud));
    publish(poses_, std::move(poses));
  }

  void show(const docent_msgs::People& people) {
    const Time now = bus_.now();
    if (people.people.empty() || !people_pace_.is_due(now)) return;
    people_pace_.done(now);
    publish(people_, visualization::people_markers(people));
  }

  /// What fits one by one may be beyond all bounds together.
  template <class T>
  static void publish(const transport::Publisher<T>& publisher, T message) {
    if (!fault_of(message)) publisher.publish(std::move(message));
  }

  transport::Bus& bus_;
  VisualizeParams params_;
  transport::Publisher<nav2_msgs::ParticleCloud> cloud_;
  transport::Publisher<geometry_msgs::PoseArray> poses_;  ///< the same for viewers that do not know Nav2
  transport::Publisher<visualization_msgs::MarkerArray> people_;
  Pace belief_pace_{params_.belief_period};
  Pace people_pace_{params_.people_period};
  std::vector<Pose2> shown_;
  visualization::Diagnostics diagnostics_;
};

class NoVisualization final : public Module {};

}  // namespace

Result<std::unique_ptr<Module>> make_visualize(const ModuleContext& context) {
  const auto params = context.config.section<VisualizeParams>("visualize");
  if (!params) return tl::unexpected<Error>(params.error());
  if (!params->enabled) return std::make_unique<NoVisualization>();
  return std::make_unique<VisualizeModule>(context, *params);
}

Result<robot::ParameterRows> parameters_of_visualize(const robot::RobotConfig& config) {
  return robot::list_parameters<VisualizeParams>(config, "visualize");
}

}  // namespace docent::modules
