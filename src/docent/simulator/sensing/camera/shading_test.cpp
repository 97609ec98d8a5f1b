#include "docent/simulator/sensing/camera/shading.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <gtest/gtest.h>

#include <cmath>

#include "docent/simulator/sensing/camera/hall_for_test.h"
#include "docent/simulator/sensing/camera/optics/picture_sensor.h"
#include "docent/simulator/sensing/camera/renderer.h"
#include "docent/simulator/sensing/camera/things/marks.h"

/// How pictures show things.
namespace docent::simulator {
namespace {

double mean_difference(const RawPicture& a, const RawPicture& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.light.size(); ++i)
    sum += std::abs(static_cast<double>(a.light[i].green) - static_cast<double>(b.light[i].green));
  return sum / static_cast<double>(a.light.size());
}

TEST(Shading, APeriodicCeilingIsTheSameAfterAPeriodAndNoOtherIs) {
  const RayTable table{plain_lens(160, 120, 1.2)};
  const auto differences = [&](CeilingKind kind, double shift) {
    Renderer renderer;
    renderer.set_furnishing(furnish(wide_hall(kind)));
    const auto at = [&](double x) {
      return renderer.expose(viewpoint_of({.z = 1.3, .tilt = kUp}, {x, 12.0, Angle::degrees(20.0)}), table);
    };
    return mean_difference(at(7.3), at(7.3 + shift));
  };
  EXPECT_LT(differences(CeilingKind::periodic, 3.0), 0.003);
  EXPECT_LT(differences(CeilingKind::periodic, 6.0), 0.003);
  EXPECT_GT(differences(CeilingKind::periodic, 1.5), 0.05);
  EXPECT_LT(differences(CeilingKind::plain, 1.1), 0.001);
  EXPECT_GT(differences(CeilingKind::various, 3.0), 0.02);
}

TEST(Shading, LampsThatAreOffAreDarkAndSoIsWhatTheyLit) {
  Renderer renderer;
  renderer.set_furnishing(furnish(wide_hall(CeilingKind::various)));
  const RayTable table{plain_lens(160, 120, 1.5)};
  const auto brightest = [&](const Lighting& lighting) {
    float most = 0.0F;
    double sum = 0.0;
    for (const double x : {5.0, 9.0, 13.0}) {
      const auto raw = renderer.expose(viewpoint_of({.z = 1.3, .tilt = kUp}, {x, 12.0, Angle{}}), table, lighting);
      for (const Rgb& light : raw.light) most = std::max(most, light.green), sum += static_cast<double>(light.green);
    }
    return std::pair{most, sum};
  };
  Lighting off;
  off.circuits.fill(0.0F);
  off.daylight = 0.0F;
  const auto [shining, bright] = brightest({});
  const auto [dead, dim] = brightest(off);
  EXPECT_GT(shining, 2.0F);
  EXPECT_LT(dead, 0.2F);
  EXPECT_LT(dim, 0.2 * bright);
}

TEST(Shading, AMarkCanBeReadThroughABentLens) {
  World world = wide_hall();
  const Mark mark{"charger", 17, {12.0, 15.0}, 0.5, Angle::degrees(180.0), 0.1, 0.3};
  world.marks = {mark};
  Renderer renderer;
  renderer.set_furnishing(furnish(world));
  const LensModel lens = bent_lens();
  const Viewpoint view = viewpoint_of({.z = 0.6, .tilt = -0.1}, {11.0, 14.8, Angle::degrees(12.0)});
  const RawPicture raw = renderer.expose(view, RayTable{lens});
  const pictures::Image tag = picture_of_tag(17);
  const Vec3 out{-std::cos(0.1F), 0.0F, std::sin(0.1F)}, up{std::sin(0.1F), 0.0F, std::cos(0.1F)};
  const Vec3 right = cross(up, out);
  const float cell = 0.3F / 8.0F;
  for (int row = 0; row < 10; ++row)
    for (int column = 0; column < 10; ++column) {
      const Vec3 at = lifted(mark.position, mark.height) + (cell * (static_cast<float>(column) - 4.5F)) * right +
                      (cell * (4.5F - static_cast<float>(row))) * up;
      const auto pixel = lens.pixel(view.to_camera(at));
      ASSERT_TRUE(pixel);
      const auto i = static_cast<std::size_t>(static_cast<int>(pixel->y) * lens.width + static_cast<int>(pixel->x));
      EXPECT_EQ(raw.light[i].green > 0.4F, tag.at(column, row).green > 127) << row << " " << column;
    }
}

TEST(Shading, ADetectorFindsMarksOnAWallAndUnderTheCeiling) {
  World world = wide_hall(CeilingKind::various);
  world.marks = {{"wall", 17, {12.0, 15.0}, 0.5, Angle::degrees(180.0), 0.1, 0.16},
                 {"overhead", 301, {11.0, 15.0}, 2.9, {}, -kUp, 0.2}};
  Renderer renderer;
  renderer.set_furnishing(furnish(world));
  apriltag_family_t* family = tag36h11_create();
  apriltag_detector_t* detector = apriltag_detector_create();
  apriltag_detector_add_family(detector, family);
  const auto found = [&](const CameraMount& mount, Angle heading) {
    Rng rng{1};
    const RayTable lens{plain_lens(320, 240, 1.1)};
    const RawPicture raw = renderer.expose(viewpoint_of(mount, {11.0, 14.8, heading}), lens);
    std::vector<std::uint8_t> grey = develop_grey(raw, {}, rng);
    image_u8_t image{320, 240, 320, grey.data()};
    zarray_t* detections = apriltag_detector_detect(detector, &image);
    std::vector<int> ids;
    for (int i = 0; i < zarray_size(detections); ++i) {
      apriltag_detection_t* detection = nullptr;
      zarray_get(detections, i, &detection);
      ids.push_back(detection->id);
    }
    apriltag_detections_destroy(detections);
    return ids;
  };
  EXPECT_EQ(found({.z = 0.6, .tilt = -0.1}, Angle::degrees(12.0)), std::vector<int>{17});
  EXPECT_EQ(found({.z = 1.2, .tilt = kUp}, Angle::degrees(70.0)), std::vector<int>{301});
  apriltag_detector_destroy(detector);
  tag36h11_destroy(family);
}

}  // namespace
}  // namespace docent::simulator
