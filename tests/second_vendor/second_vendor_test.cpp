#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "docent/messages/conversions.h"
#include "docent/transport/dds_bus.h"
#include "tour_content.h"

// Docent's bus and its programs against a base that speaks another vendor's DDS (fast_base.cpp).

namespace docent::second_vendor_test {
namespace {

using namespace std::chrono_literals;
using transport::DdsBus;

// Other tests run at the same time in other domains.
constexpr int kTourDomain = 191;
constexpr int kStampedDomain = 192;
constexpr int kRobotDomain = 193;

/// Another program and what it prints. Ended at the latest with this object.
class Program {
 public:
  explicit Program(std::vector<std::string> words) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return;
    pid_ = fork();
    if (pid_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      dup2(ends[1], STDERR_FILENO);
      std::vector<char*> arguments;
      for (auto& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      execv(arguments[0], arguments.data());
      _exit(127);
    }
    close(ends[1]);
    reader_ = std::jthread{[this, end = ends[0]] {
      std::array<char, 4096> buffer{};
      for (ssize_t count = 0; (count = read(end, buffer.data(), buffer.size())) > 0;)
        output_.append(buffer.data(), static_cast<std::size_t>(count));
      close(end);
      has_ended_ = true;
    }};
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  [[nodiscard]] bool has_ended() const { return has_ended_; }
  /// Waits for its end. @returns its exit code
  int wait() {
    reader_.join();
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// @pre it has ended
  [[nodiscard]] const std::string& output() const { return output_; }
  void signal(int number) const { ::kill(pid_, number); }

 private:
  pid_t pid_ = 0;
  std::string output_;
  std::atomic<bool> has_ended_ = false;
  std::jthread reader_;
};

/// Told what docs/connect-your-robot.md has a driver of Fast DDS told.
Program fast_base(const std::string& role, int domain, int number, const std::string& more = {}) {
  setenv("FASTRTPS_DEFAULT_PROFILES_FILE", DOCENT_SOURCES "/share/dds/fastdds.xml", 1);
  std::vector<std::string> words{DOCENT_FAST_BASE, role, std::to_string(domain), std::to_string(number)};
  if (!more.empty()) words.push_back(more);
  return Program{std::move(words)};
}

std::unique_ptr<DdsBus> bus_in(int domain, bool is_stamped = false) {
  transport::DdsOptions options{domain, "", {}};
  options.stamped_commands = is_stamped;
  auto bus = DdsBus::create(std::move(options));
  EXPECT_TRUE(bus.has_value()) << bus.error().message;
  return std::move(*bus);
}

/// Runs the bus until `done`, or for so long.
bool run_until(DdsBus& bus, Duration patience, const std::function<bool()>& done) {
  std::stop_source stop;
  const auto end = std::chrono::steady_clock::now() + patience;
  auto check = std::make_shared<std::function<void()>>();
  *check = [&, check_weak = std::weak_ptr{check}] {
    if (done() || std::chrono::steady_clock::now() > end) return void(stop.request_stop());
    bus.after(5ms, *check_weak.lock());
  };
  (*check)();
  bus.run(stop.get_token());
  return done();
}

std::uint32_t step_of(const builtin_interfaces::Time& stamp) {
  return static_cast<std::uint32_t>(stamp.sec - 1700000000) * 20 + stamp.nanosec / 50000000;
}

nav_msgs::OccupancyGrid map_of_the_tour() {
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "map";
  map.info.resolution = 0.05F;
  map.info.width = second_vendor::kMapWidth;
  map.info.height = second_vendor::kMapHeight;
  map.info.origin.position.x = -3.5;
  map.data.resize(std::size_t{second_vendor::kMapWidth} * second_vendor::kMapHeight);
  for (std::size_t i = 0; i < map.data.size(); ++i) map.data[i] = second_vendor::map_cell(i);
  return map;
}

/// The robot's side of a tour: takes in a step's sensors, answers it with a command and a frame.
class Tour {
 public:
  explicit Tour(DdsBus& bus)
      : bus_{bus}, command_{bus.publisher(topics::kCommandVelocity)}, frames_{bus.publisher(topics::kTransforms)} {
    bus.publisher(topics::kStaticMap).publish(map_of_the_tour());
    bus.subscribe<sensor_msgs::LaserScan>(topics::kScanFront, [this](const auto& scan) { hear(scan, 0); });
    bus.subscribe<sensor_msgs::LaserScan>(topics::kScanRear, [this](const auto& scan) { hear(scan, 7); });
    bus.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odometry) { hear(odometry); });
    bus.subscribe<sensor_msgs::BatteryState>(topics::kBattery, [this](const auto& battery) { hear(battery); });
    bus.subscribe<tf2_msgs::TFMessage>(topics::kTransforms, [this](const auto& frames) { hear(frames); });
    bus.subscribe<nav_msgs::OccupancyGrid>(topics::kLiveMap, [this](const auto& map) {
      has_map = map.data == map_of_the_tour().data && map.info.width == second_vendor::kMapWidth;
    });
  }

  struct Counts {
    std::uint32_t scans = 0, odometry = 0, batteries = 0, frames = 0, wrong = 0;
  };
  Counts counts;
  bool has_map = false;

 private:
  void expect(bool is_right) { counts.wrong += is_right ? 0 : 1; }

  void hear(const sensor_msgs::LaserScan& scan, std::uint32_t shift) {
    ++counts.scans;
    const std::uint32_t step = step_of(scan.header.stamp);
    bool is_right = scan.ranges.size() == second_vendor::kBeams && scan.header.frame_id == "laser" &&
                    scan.range_max == 12.0F && scan.intensities.size() == (shift == 0 ? 0 : step % 5);
    for (int i = 0; is_right && i < second_vendor::kBeams; ++i)
      is_right = scan.ranges[static_cast<std::size_t>(i)] == second_vendor::range_of(step + shift, i);
    expect(is_right);
    came(step);
  }
  void hear(const nav_msgs::Odometry& odometry) {
    ++counts.odometry;
    const std::uint32_t step = step_of(odometry.header.stamp);
    const double yaw = second_vendor::odometry_yaw(step);
    expect(odometry.child_frame_id == "base_link" && odometry.header.frame_id == "odom" &&
           odometry.pose.pose.position.x == second_vendor::odometry_x(step) && odometry.pose.pose.position.y == -2.0 &&
           odometry.pose.pose.orientation.z == std::sin(yaw / 2) &&
           odometry.pose.pose.orientation.w == std::cos(yaw / 2) && odometry.pose.covariance[35] == 0.25 &&
           odometry.twist.twist.linear.x == second_vendor::speed_of(step) &&
           odometry.twist.covariance[0] == 1.0 / (1.0 + step));
    came(step);
  }
  void hear(const sensor_msgs::BatteryState& battery) {
    ++counts.batteries;
    expect(battery.percentage == 0.5F && battery.cell_voltage.size() == 3 && battery.cell_voltage[2] == 3.9F &&
           battery.present && battery.serial_number == std::to_string(step_of(battery.header.stamp)));
  }
  void hear(const tf2_msgs::TFMessage& frames) {
    if (frames.transforms.empty() || frames.transforms.back().child_frame_id == "odom") return;  // its own
    ++counts.frames;
    const auto& frame = frames.transforms.back();
    expect(frames.transforms.size() == 2 && frame.header.frame_id == "odom" &&
           frame.child_frame_id == "base_footprint" && frame.transform.translation.y == 1.0 &&
           frame.transform.translation.x == second_vendor::odometry_x(step_of(frame.header.stamp)));
  }

  /// Both scans and the odometry of a step make it whole.
  void came(std::uint32_t step) {
    if (step != step_) {
      step_ = step;
      parts_ = 0;
    }
    if (++parts_ < 3) return;
    parts_ = 0;
    tf2_msgs::TFMessage frame;
    frame.transforms.resize(1);
    frame.transforms[0].header.frame_id = "map";
    frame.transforms[0].child_frame_id = "odom";
    frame.transforms[0].transform.translation.x = second_vendor::odometry_x(step);
    frames_.publish(frame);
    geometry_msgs::Twist command;
    command.linear.x = second_vendor::speed_of(step);
    command.angular.z = second_vendor::turn_of(step);
    command.angular.x = step;
    command_.publish(command);
  }

  DdsBus& bus_;
  transport::Publisher<geometry_msgs::Twist> command_;
  transport::Publisher<tf2_msgs::TFMessage> frames_;
  std::uint32_t step_ = 0;
  int parts_ = 0;
};

/// A tour between Docent's bus and a base of Fast DDS.
void exchange(int domain, int steps, bool is_stamped) {
  const auto bus = bus_in(domain, is_stamped);
  Tour tour{*bus};
  auto base = fast_base("tour", domain, steps, is_stamped ? "stamped" : "");
  run_until(*bus, 120s, [&] { return base.has_ended(); });
  EXPECT_EQ(base.wait(), 0);
  std::cout << base.output();
  EXPECT_EQ(tour.counts.wrong, 0U);
  EXPECT_TRUE(tour.has_map);
  EXPECT_GE(tour.counts.scans, 2U * static_cast<unsigned>(steps));
  EXPECT_GE(tour.counts.odometry, static_cast<unsigned>(steps));
  EXPECT_GE(tour.counts.frames, static_cast<unsigned>(steps));
  EXPECT_GE(tour.counts.batteries, static_cast<unsigned>(steps) / 20);
  EXPECT_EQ(bus->counters().damaged, 0U);
  for (const auto& [topic, refused] : bus->refusals())
    ADD_FAILURE() << topic << ": " << refused.count << " refused, " << refused.last.text();
}

TEST(SecondVendor, ATourOfTwentyMinutesBothWays) { exchange(kTourDomain, 24000, false); }

TEST(SecondVendor, CommandsWithAStamp) { exchange(kStampedDomain, 2400, true); }

/// Whether Docent tells ROS 2 its enclave and the hashes of its types.
template <class Options>
constexpr bool kTellsRos2 = requires(Options options) {
  options.node;
};

/// `docent COMMAND…` for the robot of these tests: one scanner and nothing else.
Program docent(std::vector<std::string> words, bool has_state) {
  words.insert(words.begin(), DOCENT_PROGRAM);
  const std::vector<std::string> robot{"--domain", std::to_string(kRobotDomain),
                                       "--robot",  DOCENT_SOURCES "/robots/one-scanner.yaml",
                                       "--set",    "body.sonars=0",
                                       "--set",    "body.infrareds=0",
                                       "--set",    "body.tactile=false",
                                       "--set",    "body.scanners=[{name: front, x: 0.0, topic: scan_front}]"};
  words.insert(words.end(), robot.begin(), robot.end());
  if (has_state) {
    const std::string state = ::testing::TempDir() + "second-vendor-" + words[1] + std::to_string(getpid());
    words.insert(words.end(), {"--state", state, "--no-cache", "--museum", DOCENT_SOURCES "/museums/bonn"});
  }
  return Program{std::move(words)};
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// What `docent ros check` says. @param code  with which it ended
std::string ros_check(int& code, const std::string& more = "--json") {
  auto check = docent({"ros", "check", "--seconds", "2", more}, false);
  code = check.wait();
  return check.output();
}

TEST(SecondVendor, TheCheckTellsABaseThatIsThereFromNone) {
  int code = 0;
  EXPECT_TRUE(says(ros_check(code), "nobody publishes it"));
  EXPECT_EQ(code, 1);
  const auto base = fast_base("drive", kRobotDomain, 60);
  const std::string heard = ros_check(code);
  EXPECT_EQ(code, 0) << heard;
  EXPECT_TRUE(says(heard, "\"vendor\": \"Fast DDS\""));
  EXPECT_TRUE(says(heard, "\"user_data\": \"enclave=/;\"")) << "as ROS 2 has it";
  EXPECT_TRUE(says(heard, "typehash=RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828;"))
      << "a LaserScan's of ROS 2";
  const std::string stamped = ros_check(code, "--set=body.stamped_commands=true");
  EXPECT_EQ(code, 1) << "the base wants a Twist";
  EXPECT_TRUE(says(stamped, "(body.stamped_commands: false)")) << stamped;
}

TEST(SecondVendor, TheRobotModuleDrivesABase) {
  const auto base = fast_base("drive", kRobotDomain, 60);
  const auto robot = docent({"run", "robot"}, true);
  const auto bus = bus_in(kRobotDomain);
  double x = 0.0;
  bus->subscribe<nav_msgs::Odometry>(topics::kOdometry,
                                     [&](const auto& odometry) { x = odometry.pose.pose.position.x; });
  const auto drives = bus->publisher(topics::kDrive);
  bus->every(50ms, [&] {
    docent_msgs::Drive drive;
    drive.header.stamp = to_message(bus->now());
    drive.linear = 0.4;
    drives.publish(drive);
  });
  EXPECT_TRUE(run_until(*bus, 30s, [&] { return x > 0.5; })) << x;

  auto listener = fast_base("list", kRobotDomain, 2);
  EXPECT_EQ(listener.wait(), 0);
  const std::string& found = listener.output();
  EXPECT_TRUE(says(found, "writer rt/cmd_vel geometry_msgs::msg::dds_::Twist_ reliable volatile")) << found;
  EXPECT_TRUE(says(found, "writer rt/tf_static tf2_msgs::msg::dds_::TFMessage_ reliable transient-local")) << found;
  EXPECT_TRUE(says(found, "reader rt/odom nav_msgs::msg::dds_::Odometry_ best-effort volatile")) << found;
  if constexpr (kTellsRos2<transport::DdsOptions>) {
    EXPECT_TRUE(says(found, "'enclave=/;'")) << found;
    EXPECT_TRUE(says(found,
                     "writer rt/cmd_vel geometry_msgs::msg::dds_::Twist_ reliable volatile "
                     "'typehash=RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a;'"))
        << found;
    EXPECT_TRUE(says(found, "writer ros_discovery_info ")) << found;
  }

  auto second = docent({"up", "--port", "18763"}, true);
  EXPECT_EQ(second.wait(), 1);
  EXPECT_TRUE(says(second.output(), "another robot without a name is on domain 193")) << second.output();
}

}  // namespace
}  // namespace docent::second_vendor_test
