#include <benchmark/benchmark.h>

#include "docent/base/random.h"
#include "docent/simulator/simulated_museum.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::simulator {
namespace {

Polygon box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

/// 30 x 30 m, nine rooms with doors, sixty cases.
World museum() {
  World world;
  world.floor = box(0.0, 0.0, 30.0, 30.0);
  world.operating_area = box(0.5, 0.5, 29.5, 29.5);
  world.home = {2.0, 2.0};
  world.entrances = {{1.0, 1.0}};
  const auto add = [&](SolidKind kind, const Polygon& polygon, double top) {
    world.solids.push_back({"solid-" + std::to_string(world.solids.size()), kind, polygon, 0.0, top, false});
  };
  add(SolidKind::wall, box(-0.2, 0.0, 0.0, 30.0), 3.0);
  add(SolidKind::wall, box(30.0, 0.0, 30.2, 30.0), 3.0);
  add(SolidKind::wall, box(0.0, -0.2, 30.0, 0.0), 3.0);
  add(SolidKind::wall, box(0.0, 30.0, 30.0, 30.2), 3.0);
  for (const double at : {10.0, 20.0}) {
    for (const double from : {0.0, 10.0, 20.0}) {
      add(SolidKind::wall, box(at - 0.1, from, at + 0.1, from + 4.0), 3.0);
      add(SolidKind::wall, box(at - 0.1, from + 6.0, at + 0.1, from + 10.0), 3.0);
      add(SolidKind::wall, box(from, at - 0.1, from + 4.0, at + 0.1), 3.0);
      add(SolidKind::wall, box(from + 6.0, at - 0.1, from + 10.0, at + 0.1), 3.0);
    }
  }
  Rng rng{1};
  for (int i = 0; i < 60; ++i) {
    const Point2 corner{1.5 + 10.0 * (i % 3) + rng.uniform(0.0, 6.0), 1.5 + 10.0 * (i / 3 % 3) + rng.uniform(0.0, 6.0)};
    add(i % 4 == 0 ? SolidKind::glass : SolidKind::furniture, box(corner.x, corner.y, corner.x + 0.8, corner.y + 0.6),
        1.2);
    if (i % 3 == 0) world.attractions.push_back({"a", corner, 1.5, 1.0});
  }
  return world;
}

/// One virtual second of the whole simulator: body, sensors, crowd, truth, in the in-process bus.
void virtual_second(benchmark::State& state) {
  transport::VirtualTimeHub hub;
  const auto bus = hub.connect("simulator");
  const auto robot = hub.connect("robot");
  SimulationOptions options;
  options.world = museum();
  options.crowd_count = static_cast<std::size_t>(state.range(0));
  SimulatedMuseum simulated{*bus, *bus, std::move(options)};
  const auto commands = robot->publisher(topics::kCommandVelocity);
  robot->every(seconds(0.05), [&] {
    geometry_msgs::Twist twist;
    twist.linear.x = 0.3;
    twist.angular.z = 0.3;
    commands.publish(twist);
  });
  hub.run_until(time_from_seconds(5.0));
  for (auto _ : state) hub.run_until(hub.now() + seconds(1.0));
}
BENCHMARK(virtual_second)->Arg(0)->Arg(40)->Arg(60)->Arg(150)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace docent::simulator
