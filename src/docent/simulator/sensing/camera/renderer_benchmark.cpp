#include <benchmark/benchmark.h>

#include "docent/simulator/sensing/camera/figures.h"
#include "docent/simulator/sensing/camera/renderer.h"

namespace docent::simulator {
namespace {

/// One picture of 320 x 240 in Bonn, with people in the hall; the robot's camera and the hall's.
void draw_bonn(benchmark::State& state, const Lens& lens) {
  const auto world = load_world("museums/bonn/simulation.yaml");
  if (!world) return state.SkipWithError(world.error().message.c_str());
  Renderer renderer;
  renderer.set_furnishing(furnish(*world));
  Mesh mesh;
  for (auto _ : state) {
    mesh.clear();
    for (std::uint32_t i = 0; i < 60; ++i)
      add_figure(mesh, {i, {2.0 + 0.43 * i, 8.0 + 3.0 * (i % 7), Angle::degrees(40.0 * i)}, 1.7, 0.3 * i, true});
    add_robot(mesh, {{9.0, 14.0, Angle{}}});
    renderer.set_figures(mesh);
    benchmark::DoNotOptimize(renderer.draw(lens));
  }
  state.counters["figures"] = 60;
}

void BM_RobotCamera(benchmark::State& state) { draw_bonn(state, {{9.2F, 14.0F, 1.38F}, 0.3, 0.0, 1.2, 320, 240}); }
void BM_SceneCamera(benchmark::State& state) { draw_bonn(state, {{9.0F, 9.0F, 2.8F}, 1.0, -0.3, 1.0, 320, 240}); }

/// What an up-looking camera of 320 x 240 has on its sensor, and what a depth camera meets, in an empty museum.
template <class Look>
void look_in_smithsonian(benchmark::State& state, double tilt, const Look& look) {
  const auto world = load_world("museums/smithsonian/simulation.yaml");
  if (!world) return state.SkipWithError(world.error().message.c_str());
  Renderer renderer;
  renderer.set_furnishing(furnish(*world));
  const RayTable lens{plain_lens(320, 240, 1.2)};
  const Viewpoint view = viewpoint_of({.z = 1.2, .tilt = tilt}, {24.0, 12.0, Angle::degrees(30.0)});
  for (auto _ : state) look(renderer, view, lens);
}
void BM_CeilingCamera(benchmark::State& state) {
  look_in_smithsonian(state, 1.57, [](const Renderer& renderer, const Viewpoint& view, const RayTable& lens) {
    benchmark::DoNotOptimize(renderer.expose(view, lens));
  });
}
void BM_DepthCamera(benchmark::State& state) {
  look_in_smithsonian(state, -0.5, [](const Renderer& renderer, const Viewpoint& view, const RayTable& lens) {
    benchmark::DoNotOptimize(renderer.probe(view, lens, 0.075));
  });
}
BENCHMARK(BM_CeilingCamera)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_DepthCamera)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_RobotCamera)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_SceneCamera)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace docent::simulator
