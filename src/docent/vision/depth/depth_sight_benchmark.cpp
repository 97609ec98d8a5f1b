#include <benchmark/benchmark.h>

#include "docent/vision/depth/depth_sight.h"
#include "docent/vision/depth/testing.h"

namespace docent::vision {
namespace {

/// A picture of 320 x 240 from picture to lines. @param range(0)  boxes in view
void depth_picture(benchmark::State& state) {
  made_up_room::Scene scene;
  for (int i = 0; i < state.range(0); ++i) {
    const double x = 0.9 + 0.5 * i, y = i % 2 == 0 ? -0.3 : 0.3;
    scene.boxes.push_back({{x, y - 0.2, 0.0}, {x + 0.2, y + 0.2, i % 3 == 0 ? 1.2 : 0.3}});
  }
  scene.boxes.push_back({{3.5, -4.0, 0.0}, {3.6, 4.0, 2.5}});
  Rng rng{1};
  const DepthCamera camera = made_up_room::front_camera();
  const DepthPicture picture = made_up_room::picture_of(scene, camera, 0.0, rng);
  DepthSight sight{camera};
  for (auto _ : state) {
    benchmark::DoNotOptimize(sight.see(picture, {}));
    benchmark::DoNotOptimize(sight.lines({}));
  }
}
BENCHMARK(depth_picture)->Arg(0)->Arg(4)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace docent::vision
