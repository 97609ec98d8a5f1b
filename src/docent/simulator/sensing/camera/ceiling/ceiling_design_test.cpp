#include "docent/simulator/sensing/camera/ceiling/ceiling_design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "docent/simulator/sensing/camera/ceiling/ceiling_light.h"
#include "docent/simulator/sensing/camera/ceiling/ceiling_mesh.h"
#include "docent/simulator/sensing/camera/ceiling/ceiling_texture.h"

namespace docent::simulator {
namespace {

/// A hall of 40 x 30 m with an opening of 12 x 10 m, 15 m higher.
World hall_with_opening(CeilingKind kind = CeilingKind::various, std::uint64_t seed = 1) {
  World world;
  world.floor = {{0.0, 0.0}, {40.0, 0.0}, {40.0, 30.0}, {0.0, 30.0}};
  world.operating_area = world.floor;
  world.ceiling_height = 3.5;
  world.ceiling = {{{{14.0, 10.0}, {26.0, 10.0}, {26.0, 20.0}, {14.0, 20.0}}, 18.5}};
  world.ceiling_style = {kind, seed};
  return world;
}

std::vector<double> heights(const Ceiling& ceiling) {
  std::vector<double> all;
  for (double x = 0.25; x < 40.0; x += 0.5)
    for (double y = 0.25; y < 30.0; y += 0.5) all.push_back(ceiling.fields[ceiling.field_at({x, y})].height);
  return all;
}

TEST(CeilingDesign, HasTheHeightsOfTheWorldAndSoffitsAndSkylightsOfItsOwn) {
  const Ceiling ceiling = design_ceiling(hall_with_opening());
  const auto all = heights(ceiling);
  const auto share = [&](double low, double high) {
    return static_cast<double>(std::count_if(all.begin(), all.end(), [&](double h) { return h > low && h < high; })) /
           static_cast<double>(all.size());
  };
  EXPECT_NEAR(share(17.0, 19.5), 0.1, 0.005) << "the opening";
  EXPECT_GT(share(3.499, 3.501), 0.7) << "the ceiling";
  EXPECT_GT(share(2.6, 3.4), 0.005) << "soffits";
  EXPECT_GT(share(3.6, 4.6), 0.003) << "skylights";
  EXPECT_EQ(ceiling.fields[ceiling.field_at({14.2, 10.2})].height, 18.5);
}

TEST(CeilingDesign, IsTheSameForASeedAndAnotherForAnother) {
  const auto places = [](const World& world) {
    std::set<std::pair<double, double>> all;
    for (const Lamp& lamp : design_ceiling(world).lamps) all.insert({lamp.pose.x, lamp.pose.y});
    return all;
  };
  const auto first = places(hall_with_opening());
  EXPECT_GT(first.size(), 40U);
  EXPECT_EQ(first, places(hall_with_opening()));
  EXPECT_NE(first, places(hall_with_opening(CeilingKind::various, 2)));
  World own = hall_with_opening(), other = own;
  own.ceiling_style.seed.reset();
  other.ceiling_style.seed.reset();
  other.exhibits = {"engine"};
  EXPECT_NE(places(own), places(other)) << "a museum has a ceiling of its own";
  other.exhibits.clear();
  other.solids.push_back({"closed-1", SolidKind::wall, {{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}}});
  EXPECT_EQ(places(own), places(other)) << "which no scenario changes";
}

TEST(CeilingDesign, LampsAreOfSeveralKindsSomeDeadAllOverTheFloorAndBelowTheirField) {
  std::set<LampKind> kinds;
  std::size_t dead = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const World world = hall_with_opening(CeilingKind::various, seed);
    const Ceiling ceiling = design_ceiling(world);
    for (const Lamp& lamp : ceiling.lamps) {
      kinds.insert(lamp.kind);
      ++all;
      dead += lamp.is_dead ? 1 : 0;
      EXPECT_TRUE(contains(world.floor, lamp.pose.position()));
      EXPECT_EQ(lamp.ceiling, ceiling.fields[ceiling.field_at(lamp.pose.position())].height);
      EXPECT_LT(lamp.height, lamp.ceiling);
      EXPECT_GT(lamp.height, 2.2) << "over people's heads";
    }
    for (const Beam& beam : ceiling.beams) EXPECT_GT(beam.bottom, 2.5);
  }
  EXPECT_EQ(kinds.size(), 4U);
  EXPECT_NEAR(static_cast<double>(dead) / static_cast<double>(all), 0.12, 0.04);
}

TEST(CeilingDesign, ThePeriodicOneRepeatsAndThePlainOneIsEmpty) {
  const Ceiling periodic = design_ceiling(hall_with_opening(CeilingKind::periodic));
  std::set<std::pair<double, double>> phases;
  for (const Lamp& lamp : periodic.lamps) {
    const auto phase = [](double x) { return std::round(1e6 * std::remainder(x, 3.0)); };
    phases.insert({phase(lamp.pose.x), phase(lamp.pose.y)});
    EXPECT_FALSE(lamp.is_dead);
  }
  EXPECT_EQ(phases.size(), 1U);
  EXPECT_GT(periodic.lamps.size(), 100U);
  const Ceiling plain = design_ceiling(hall_with_opening(CeilingKind::plain));
  EXPECT_TRUE(plain.lamps.empty() && plain.beams.empty());
  EXPECT_EQ(plain.fields.size(), 2U);
}

TEST(CeilingTexture, PanelsHaveFatesAndThePeriodicOnesHaveNone) {
  CeilingField field;
  field.covering = Covering::panels;
  field.seed = 5;
  int dark = 0, brown = 0, all = 0;
  for (double x = 0.05; x < 60.0; x += 0.1)
    for (double y = 0.05; y < 60.0; y += 0.1) {
      const Rgb c = color_at(field, {x, y}, 0.005F);
      ++all;
      dark += c.green < 0.1F ? 1 : 0;
      brown += c.blue < 0.7F * c.red ? 1 : 0;
    }
  EXPECT_NEAR(static_cast<double>(dark) / all, 0.012, 0.008) << "missing";
  EXPECT_GT(static_cast<double>(brown) / all, 0.003) << "stained";
  field.covering = Covering::periodic;
  for (double x = 0.05; x < 20.0; x += 0.1)
    for (double y = 0.05; y < 3.0; y += 0.1) {
      const Rgb here = color_at(field, {x, y}, 0.005F), there = color_at(field, {x + 3.0, y + 3.0}, 0.005F);
      ASSERT_NEAR(here.green, there.green, 1e-3F) << x << " " << y;
    }
}

TEST(CeilingTexture, AveragesWhatIsTooFineToSee) {
  CeilingField field;
  field.covering = Covering::periodic;
  const float bar = color_at(field, {0.6, 0.3}, 0.001F).green, panel = color_at(field, {0.3, 0.3}, 0.001F).green;
  EXPECT_NEAR(bar, 0.72F * panel, 1e-4F);
  EXPECT_NEAR(color_at(field, {0.6, 0.3}, 0.048F).green, 0.5F * (bar + panel), 1e-3F) << "half of it is bar";
}

TEST(CeilingLight, IsUsualWithAllOnAndDarkerWhereACircuitIsOff) {
  const Ceiling ceiling = design_ceiling(hall_with_opening());
  const CeilingLight light{ceiling, {-3.0, -3.0}, {43.0, 33.0}};
  const auto mean = [&](const Lighting& lighting) {
    const auto field = light.field(lighting);
    double sum = 0.0;
    for (int x = 1; x < 40; ++x)
      for (int y = 1; y < 30; ++y) sum += static_cast<double>(field.at(static_cast<float>(x), static_cast<float>(y)));
    return sum / (39.0 * 29.0);
  };
  EXPECT_NEAR(mean({}), 0.8, 0.25);
  Lighting off;
  off.circuits.fill(0.0F);
  EXPECT_LT(mean(off), 0.6 * mean({}));
  off.daylight = 0.0F;
  EXPECT_LT(mean(off), 0.1);
  EXPECT_GT(mean(off), 0.0);
  const Lamp& lamp =
      *std::find_if(ceiling.lamps.begin(), ceiling.lamps.end(), [](const Lamp& l) { return !l.is_dead; });
  Lighting one_off;
  one_off.circuits[static_cast<std::size_t>(lamp.circuit)] = 0.0F;
  const auto under = [&](const Lighting& lighting) {
    return light.field(lighting).at(static_cast<float>(lamp.pose.x), static_cast<float>(lamp.pose.y));
  };
  EXPECT_LT(under(one_off), 0.9F * under({}));
  EXPECT_LT(light.field(one_off).share_at(static_cast<float>(lamp.pose.x), static_cast<float>(lamp.pose.y)), 0.9F);
  EXPECT_EQ(light.field({}).share_at(3.0F, 3.0F), 1.0F);
}

TEST(CeilingMesh, CoversTheRectangleAndItsEdgesAreUpright) {
  const Ceiling ceiling = design_ceiling(hall_with_opening(CeilingKind::plain));
  Mesh mesh;
  add_ceiling(mesh, ceiling, {-3.0, -3.0}, {43.0, 33.0});
  double level = 0.0, upright = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 twice = cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
    level += 0.5 * std::abs(static_cast<double>(twice.z));
    upright += 0.5 * static_cast<double>(std::sqrt(twice.x * twice.x + twice.y * twice.y));
    if (std::abs(twice.z) > 0.0F) {
      EXPECT_LT(mesh.normals[a].z, 0.0F) << "faces down";
    }
  }
  EXPECT_NEAR(level, 46.0 * 36.0, 0.1);
  EXPECT_NEAR(upright, 44.0 * 15.0, 0.1) << "the opening's edge";
}

}  // namespace
}  // namespace docent::simulator
