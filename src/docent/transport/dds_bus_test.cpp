#include "docent/transport/dds_bus.h"

#include <dds/dds.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <numeric>
#include <thread>

#include "docent/messages/conversions.h"
#include "docent/messages/random_message.h"
#include "docent/messages/schema.h"
#include "docent/transport/type_support.h"

extern "C" const dds_topic_descriptor_t* docent_topic_descriptor(const char* type);

namespace docent::transport {
namespace {

using namespace std::chrono_literals;
using topics::kHorn;
using topics::kStaticMap;

// Other tests run at the same time in other domains.
constexpr int kDomain = 40;
constexpr int kTypedDomain = 41;
constexpr int kPrefixDomain = 42;
constexpr int kDeafDomain = 39;

std::unique_ptr<DdsBus> bus_in(int domain, std::string prefix = {}) {
  auto bus = DdsBus::create({domain, std::move(prefix), {}});
  EXPECT_TRUE(bus.has_value()) << bus.error().message;
  return std::move(*bus);
}

/// Runs the bus until `done` or for ten seconds; asks after every 5 ms.
bool run_until(DdsBus& bus, const std::function<bool()>& done) {
  std::stop_source stop;
  const auto end = std::chrono::steady_clock::now() + 10s;
  auto check = std::make_shared<std::function<void()>>();
  *check = [&, check_weak = std::weak_ptr{check}] {
    if (done() || std::chrono::steady_clock::now() > end) return void(stop.request_stop());
    bus.after(5ms, *check_weak.lock());
  };
  (*check)();
  bus.run(stop.get_token());
  return done();
}

/// Another process at the bus: dds_peer ROLE DOMAIN. Killed at the latest with this object.
class Peer {
 public:
  Peer(const char* role, int domain) {
    const std::string number = std::to_string(domain);
    pid_ = fork();
    if (pid_ == 0) {
      execl(DOCENT_DDS_PEER, DOCENT_DDS_PEER, role, number.c_str(), nullptr);
      _exit(127);
    }
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  ~Peer() { kill_hard(); }
  void signal(int number) const { ::kill(pid_, number); }
  void kill_hard() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }

 private:
  pid_t pid_ = 0;
};

TEST(DdsBus, ScansOfAnotherProcessArriveAndItsDeathShows) {
  const auto bus = bus_in(kDomain);
  int scans = 0;
  sensor_msgs::LaserScan last;
  bus->subscribe<sensor_msgs::LaserScan>(topics::kScanFront, [&](const auto& scan) {
    ++scans;
    last = scan;
  });
  EXPECT_EQ(bus->alive_writers("scan_front"), 0);
  EXPECT_EQ(bus->alive_writers("sonar"), -1);
  Peer peer{"scans", kDomain};
  ASSERT_TRUE(run_until(*bus, [&] { return scans >= 20; }));
  ASSERT_EQ(last.ranges.size(), 360U);
  EXPECT_FLOAT_EQ(last.ranges[359], 3.59F);
  EXPECT_EQ(bus->alive_writers("scan_front"), 1);

  peer.kill_hard();
  const auto killed = std::chrono::steady_clock::now();
  ASSERT_TRUE(run_until(*bus, [&] { return bus->alive_writers("scan_front") == 0; }));
  EXPECT_LT(std::chrono::steady_clock::now() - killed, 3s);

  const int before = scans;
  Peer restarted{"scans", kDomain};
  EXPECT_TRUE(run_until(*bus, [&] { return scans > before + 5; })) << "a restarted writer is heard again";
}

/// Takes the ears of an entity and of all below it: DDS tells nobody any more that data are there.
void deafen(dds_entity_t entity) {
  dds_entity_t children[64] = {};
  const dds_return_t count = dds_get_children(entity, children, 64);
  for (dds_return_t i = 0; i < std::min(count, 64); ++i) deafen(children[i]);
  dds_set_listener(entity, nullptr);
}

/// Likewise of this process.
void deafen_in(int domain) {
  dds_entity_t participants[4] = {};
  const dds_return_t found = dds_lookup_participant(static_cast<dds_domainid_t>(domain), participants, 4);
  for (dds_return_t i = 0; i < std::min(found, 4); ++i) deafen(participants[i]);
}

TEST(DdsBus, AReaderThatHasGoneDeafIsMadeAnew) {
  const auto bus = bus_in(kDeafDomain);
  int scans = 0;
  bus->subscribe<sensor_msgs::LaserScan>(topics::kScanFront, [&](const auto&) { ++scans; });
  Peer peer{"scans", kDeafDomain};
  ASSERT_TRUE(run_until(*bus, [&] { return scans >= 40; }));
  deafen_in(kDeafDomain);
  const int before = scans;
  EXPECT_TRUE(run_until(*bus, [&] { return scans > before + 10; }));
  EXPECT_EQ(bus->counters().renewed, 1U);
}

TEST(DdsBus, OtherProgramsThatPublishOnATopicAreCounted) {
  const auto bus = bus_in(kDomain);
  const auto topic = topic_info(topics::kCommandVelocity);
  bus->publisher(topics::kCommandVelocity).publish({});
  bool is_over = false;
  bus->after(1500ms, [&] { is_over = true; });
  EXPECT_EQ(bus->other_writers(topic), 0);
  ASSERT_TRUE(run_until(*bus, [&] { return is_over; }));
  EXPECT_EQ(bus->other_writers(topic), 0) << "it does not count itself";
  Peer robot{"second_robot", kDomain};
  EXPECT_TRUE(run_until(*bus, [&] { return bus->other_writers(topic) == 1; }));
  robot.kill_hard();
  EXPECT_TRUE(run_until(*bus, [&] { return bus->other_writers(topic) == 0; })) << "its death shows";
  Peer joystick{"joystick", kDomain};
  EXPECT_TRUE(run_until(*bus, [&] { return bus->other_writers(topic) == 1; })) << "of another type";
}

TEST(DdsBus, CommandsMayBeStampedOnTheWire) {
  const auto stamped_bus = [] {
    DdsOptions options{kDomain, "", {}};
    options.stamped_commands = true;
    return std::move(*DdsBus::create(std::move(options)));
  };
  const auto robot = stamped_bus(), plain = bus_in(kDomain);
  std::vector<double> heard;
  int heard_plain = 0;
  const auto base = stamped_bus();
  base->subscribe<geometry_msgs::Twist>(topics::kCommandVelocity,
                                        [&](const auto& twist) { heard.push_back(twist.linear.x); });
  plain->subscribe<geometry_msgs::Twist>(topics::kCommandVelocity, [&](const auto&) { ++heard_plain; });
  robot->every(20ms, [out = robot->publisher(topics::kCommandVelocity)] { out.publish({{0.4, 0.0, 0.0}, {}}); });
  const std::jthread runs{[&](const std::stop_token& stop) { robot->run(stop); }};
  ASSERT_TRUE(run_until(*base, [&] { return heard.size() >= 5; }));
  EXPECT_EQ(heard.front(), 0.4);
  bool is_over = false;
  plain->after(300ms, [&] { is_over = true; });
  ASSERT_TRUE(run_until(*plain, [&] { return is_over; }));
  EXPECT_EQ(heard_plain, 0);
}

TEST(DdsBus, WhatCannotBeIsRefusedAndCounted) {
  const auto bus = bus_in(kDomain);
  std::vector<double> speeds;
  bus->subscribe<docent_msgs::Drive>(topics::kDrive, [&](const auto& drive) { speeds.push_back(drive.linear); });
  const auto publisher = bus->publisher(topics::kDrive);
  for (const double speed : {0.1, std::nan(""), 1e30, 0.2}) publisher.publish({{}, speed, 0.0});
  ASSERT_TRUE(run_until(*bus, [&] { return speeds.size() >= 2; }));
  EXPECT_EQ(speeds, (std::vector<double>{0.1, 0.2}));
  ASSERT_TRUE(bus->refusals().contains("docent/drive"));
  EXPECT_EQ(bus->refusals().at("docent/drive").count, 2U);
  EXPECT_EQ(bus->refusals().at("docent/drive").last.text(), "linear is no number of this world");
}

TEST(DdsBus, ALateJoinerGetsTheLatchedMap) {
  Peer peer{"map", kDomain};
  {
    // The writer is up and has published before this bus asks.
    const auto first = bus_in(kDomain);
    bool has_map = false;
    first->subscribe<nav_msgs::OccupancyGrid>(kStaticMap, [&](const auto&) { has_map = true; });
    ASSERT_TRUE(run_until(*first, [&] { return has_map; }));
  }
  const auto late = bus_in(kDomain);
  nav_msgs::OccupancyGrid map;
  late->subscribe<nav_msgs::OccupancyGrid>(kStaticMap, [&](const auto& message) { map = message; });
  ASSERT_TRUE(run_until(*late, [&] { return !map.data.empty(); }));
  ASSERT_EQ(map.data.size(), 2000U * 2000U);
  EXPECT_EQ(map.info.width, 2000U);
  EXPECT_EQ(map.data[12345], static_cast<std::int8_t>(12345 % 101));
}

nav_msgs::OccupancyGrid map_with_origin(double x) {
  nav_msgs::OccupancyGrid map;
  map.info.resolution = 0.1F;
  map.info.origin.position.x = x;
  map.info.width = map.info.height = 1000;
  map.data.resize(1000000);
  return map;
}

TEST(DdsBus, AStoppedReaderDoesNotHoldTheWriterUpAndGetsTheLastState) {
  const auto bus = bus_in(kDomain);
  const auto map = bus->publisher(kStaticMap);
  bool is_echoed = false;
  std::string reason;
  bus->subscribe<docent_msgs::Horn>(kHorn, [&](const auto& horn) {
    is_echoed = true;
    reason = horn.reason;
  });
  Peer peer{"map_echo", kDomain};  // answers each map with a horn that names its origin
  map.publish(map_with_origin(1.0));
  ASSERT_TRUE(run_until(*bus, [&] { return is_echoed; }));
  peer.signal(SIGSTOP);
  const auto start = std::chrono::steady_clock::now();
  for (int i = 2; i <= 50; ++i) {
    map.publish(map_with_origin(i));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, 3s);
  peer.signal(SIGCONT);
  EXPECT_TRUE(run_until(*bus, [&] { return reason == "50"; })) << reason;
}

TEST(DdsBus, WhoWasStoppedDoesNotObeyWhatIsOld) {
  const auto bus = bus_in(kDomain);
  const auto drive = bus->publisher(topics::kDrive);
  bus->every(20ms, [&] { drive.publish({{to_message(bus->now()), ""}, 0.5, 0.0}); });
  std::vector<double> ages;  // [s], of what the other process obeys
  bus->subscribe<docent_msgs::Horn>(kHorn, [&](const auto& horn) { ages.push_back(std::stod(horn.reason)); });
  Peer peer{"drive_echo", kDomain};
  ASSERT_TRUE(run_until(*bus, [&] { return ages.size() >= 20; }));
  peer.signal(SIGSTOP);
  const auto end = std::chrono::steady_clock::now() + 1500ms;
  ASSERT_TRUE(run_until(*bus, [&] { return std::chrono::steady_clock::now() > end; }));
  peer.signal(SIGCONT);
  ages.clear();
  ASSERT_TRUE(run_until(*bus, [&] { return ages.size() >= 20; }));
  EXPECT_LT(*std::max_element(ages.begin(), ages.end()), 0.5);
}

/// Says that it is a horn, and is not.
struct FalseHorn {
  static constexpr const char* kType = docent_msgs::Horn::kType;
  std::vector<std::uint32_t> numbers;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("numbers", m.numbers);
  }
};

}  // namespace

template <>
const TypeSupport& type_support<FalseHorn>() {
  static constexpr TypeSupport kSupport = support_of<FalseHorn>();
  return kSupport;
}

namespace {

TEST(DdsBus, DamagedSamplesAreDroppedAndCounted) {
  std::vector<std::string> warnings;
  auto created = DdsBus::create({kDomain, "", [&](const std::string& text) { warnings.push_back(text); }});
  ASSERT_TRUE(created.has_value());
  const auto bus = std::move(*created);
  int horns = 0;
  bus->subscribe<docent_msgs::Horn>(kHorn, [&](const auto&) { ++horns; });
  const auto hostile = bus_in(kDomain);
  constexpr Topic<FalseHorn> kFalseHorn{kHorn.name, Qos::command};
  const auto false_horn = hostile->publisher(kFalseHorn);
  const auto horn = bus->publisher(kHorn);
  false_horn.publish({{0xFFFFFFFFU, 0xFFFFFFFFU}});  // a string of 4 GB
  false_horn.publish({{}});                          // ends early
  ASSERT_TRUE(run_until(*bus, [&] { return bus->counters().damaged == 2; }));
  horn.publish({{}, "a good one"});
  EXPECT_TRUE(run_until(*bus, [&] { return horns == 1; }));
  EXPECT_EQ(bus->counters().damaged, 2U);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0], "damaged sample on docent/horn, dropped");
}

TEST(DdsBus, AQualityMismatchIsNotSilent) {
  std::vector<std::string> warnings;
  auto created = DdsBus::create({kDomain, "", [&](const std::string& text) { warnings.push_back(text); }});
  ASSERT_TRUE(created.has_value());
  const auto bus = std::move(*created);
  bus->subscribe<docent_msgs::Limits>(topics::kLimits, [](const auto&) {});
  const auto other = bus_in(kDomain);
  constexpr Topic<docent_msgs::Limits> kVolatileLimits{topics::kLimits.name, Qos::command};
  other->publisher(kVolatileLimits).publish({});
  ASSERT_TRUE(run_until(*bus, [&] { return !warnings.empty(); }));
  EXPECT_EQ(warnings[0], "a writer of docent/limits does not offer the durability that is asked for");
}

TEST(DdsBus, NamePrefixesKeepRobotsApart) {
  const auto rhino = bus_in(kPrefixDomain, "rhino");
  const auto minerva = bus_in(kPrefixDomain, "minerva");
  std::vector<std::string> heard;
  rhino->subscribe<docent_msgs::Horn>(kHorn, [&](const auto& horn) { heard.push_back(horn.reason); });
  minerva->publisher(kHorn).publish({{}, "minerva"});
  rhino->publisher(kHorn).publish({{}, "rhino"});
  ASSERT_TRUE(run_until(*rhino, [&] { return !heard.empty(); }));
  EXPECT_EQ(heard, std::vector<std::string>{"rhino"});
}

TEST(DdsBus, TimersSkipBeatsThatTheyMissed) {
  const auto bus = bus_in(kDomain);
  int beats = 0;
  bus->every(20ms, [&] {
    if (beats++ == 0) std::this_thread::sleep_for(205ms);  // ten beats are lost
  });
  std::stop_source stop;
  bus->after(400ms, [&] { stop.request_stop(); });
  bus->run(stop.get_token());
  EXPECT_GE(beats, 3);
  EXPECT_LE(beats, 11) << "no beat is made good";
  EXPECT_GT(bus->step_p99_ms(), 100.0);
}

TEST(DdsBus, PostRunsOnTheThreadOfTheBus) {
  const auto bus = bus_in(kDomain);
  std::thread::id ran_on;
  int count = 0;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        for (int i = 0; i < 250; ++i) {
          bus->post([&] {
            ++count;
            ran_on = std::this_thread::get_id();
          });
        }
      });
    }
    EXPECT_TRUE(run_until(*bus, [&] { return count == 1000; }));
  }
  EXPECT_EQ(ran_on, std::this_thread::get_id());
  Time last = bus->now();
  for (int i = 0; i < 1000; ++i) {
    const Time now = bus->now();
    EXPECT_GE(now, last);
    last = now;
  }
  EXPECT_NEAR(to_seconds(last), static_cast<double>(time(nullptr)), 2.0);
}

TEST(DdsBus, RefusesADomainThatDoesNotExist) {
  const auto bus = DdsBus::create({231, "", {}});
  ASSERT_FALSE(bus.has_value());
  EXPECT_EQ(bus.error().message, "DDS domain 231 is not in 0 … 230");
}

/// A reader and a writer made by Cyclone's own IDL compiler: reads the sample into its C struct and writes that again.
class TypedEcho {
 public:
  TypedEcho(const char* type, const std::string& in, const std::string& out) {
    participant_ = dds_create_participant(kTypedDomain, nullptr, nullptr);
    descriptor_ = docent_topic_descriptor(type);
    const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos{dds_create_qos(), dds_delete_qos};
    const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
    dds_qset_data_representation(qos.get(), 1, &representation);
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 32);
    const auto topic = [&](const std::string& name) {
      return dds_create_topic(participant_, descriptor_, ("rt/" + name).c_str(), nullptr, nullptr);
    };
    reader_ = dds_create_reader(participant_, topic(in), qos.get(), nullptr);
    writer_ = dds_create_writer(participant_, topic(out), qos.get(), nullptr);
  }
  TypedEcho(const TypedEcho&) = delete;
  TypedEcho& operator=(const TypedEcho&) = delete;
  ~TypedEcho() { dds_delete(participant_); }
  [[nodiscard]] bool is_good() const { return descriptor_ != nullptr && reader_ > 0 && writer_ > 0; }
  [[nodiscard]] std::string type_name() const { return descriptor_->m_typename; }
  void run() const {
    void* samples[16] = {};
    dds_sample_info_t infos[16];
    const dds_return_t count = dds_take(reader_, samples, infos, 16, 16);
    for (dds_return_t i = 0; i < count; ++i) {
      if (infos[i].valid_data) dds_write(writer_, samples[i]);
    }
    if (count > 0) dds_return_loan(reader_, samples, count);
  }

 private:
  dds_entity_t participant_ = 0;
  const dds_topic_descriptor_t* descriptor_ = nullptr;
  dds_entity_t reader_ = 0;
  dds_entity_t writer_ = 0;
};

template <class T>
void expect_idlc_agrees(Topic<T> declared) {
  SCOPED_TRACE(declared.name);
  const std::string in = std::string{"there/"} + declared.name;
  const std::string out = std::string{"back/"} + declared.name;
  const auto bus = bus_in(kTypedDomain);
  const TypedEcho echo{T::kType, in, out};
  ASSERT_TRUE(echo.is_good());
  EXPECT_EQ(echo.type_name(), dds_type_name(T::kType));
  std::vector<std::vector<std::uint8_t>> back;
  // Random messages are not fit for a robot.
  bus->add_subscription(topic_info(Topic<T>{out.c_str(), Qos::command}),
                        [&](const std::shared_ptr<const void>& message) {
                          back.push_back(encode_cdr(*static_cast<const T*>(message.get())));
                        });
  const auto publisher = bus->publisher(Topic<T>{in.c_str(), Qos::command});
  constexpr int kMessages = 8;
  for (std::uint64_t seed = 0; seed < kMessages; ++seed) publisher.publish(random_message<T>(seed));
  ASSERT_TRUE(run_until(*bus,
                        [&] {
                          echo.run();
                          return back.size() == kMessages;
                        }))
      << back.size() << " came back; damaged: " << bus->counters().damaged;
  for (std::uint64_t seed = 0; seed < kMessages; ++seed) {
    EXPECT_EQ(back[seed], encode_cdr(random_message<T>(seed))) << "seed " << seed;
  }
}

TEST(DdsBus, EveryMessageIsWhatItsIdlSays) {
  for_each_robot_topic([](auto topic) { expect_idlc_agrees(topic); });
  for_each_truth_topic([](auto topic) { expect_idlc_agrees(topic); });
}

}  // namespace
}  // namespace docent::transport
