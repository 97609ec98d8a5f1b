#include "docent/apps/laboratory/train_sonar/sonar_worlds.h"

#include <cmath>
#include <memory>
#include <numbers>

#include "docent/apps/shared/command.h"
#include "docent/base/random.h"
#include "docent/simulator/crowd/walkable_floor.h"
#include "docent/simulator/office/office.h"
#include "docent/simulator/sensing/sonar.h"
#include "docent/simulator/world/world.h"

namespace docent::apps::train_sonar_command {
namespace {

constexpr double kSolid = 0.05;  // [m]: half a cell; what is nearer to a surface is occupied

}  // namespace

struct SonarWorld::Hall {
  simulator::World world;
  simulator::WalkableFloor floor;
  simulator::RayCaster walls;
  explicit Hall(simulator::World of) : world{std::move(of)}, floor{world}, walls{simulator::sonar_surfaces(world)} {}
};

SonarWorld::SonarWorld(std::unique_ptr<Hall> hall) : hall_{std::move(hall)} {}
SonarWorld::SonarWorld(SonarWorld&&) noexcept = default;
SonarWorld& SonarWorld::operator=(SonarWorld&&) noexcept = default;
SonarWorld::~SonarWorld() = default;

SonarWorld SonarWorld::office(std::uint64_t seed) {
  return SonarWorld{std::make_unique<Hall>(simulator::draw_office(seed).world)};
}

SonarWorld SonarWorld::museum(const std::string& folder) {
  const std::filesystem::path file = std::filesystem::path{folder} / "simulation.yaml";
  return SonarWorld{std::make_unique<Hall>(value_or_fail(simulator::load_world(file), 2))};
}

bool SonarWorld::is_occupied(Point2 in_world) const { return hall_->floor.clearance(in_world) < kSolid; }

std::pair<Point2, Point2> SonarWorld::bounds() const { return hall_->floor.bounds(); }

std::vector<SonarPlace> SonarWorld::places(std::size_t count, std::uint64_t seed) const {
  constexpr double kRoom = 0.32;  // [m]: the robot's radius and a little
  const Rng rng = Rng{seed}.stream("sonar places");
  Rng draw = rng.stream("where");
  simulator::SonarRing ring{{}, rng.stream("ring")};
  std::vector<SonarPlace> places;
  while (places.size() < count) {
    const auto at = hall_->floor.random_point(draw, kRoom);
    if (!at) throw CommandFailed{"a world without floor for a robot"};
    SonarPlace place{{at->x, at->y, Angle::radians(draw.uniform(-std::numbers::pi, std::numbers::pi))}, {}};
    place.view.ranges.assign(static_cast<std::size_t>(ring.params().count), ring.params().max_range);
    for (int group = 0; group < ring.groups(); ++group) {
      for (const simulator::Ping& ping : ring.fire(group, hall_->walls, {}, place.world_from_base)) {
        place.view.ranges[static_cast<std::size_t>(ping.index)] = ping.range;
      }
    }
    places.push_back(std::move(place));
  }
  return places;
}

mapping::SonarRingGeometry ring_of_data_sheet() {
  const simulator::SonarParams sheet;
  return {sheet.count, sheet.ring_radius, sheet.max_range, sheet.field_of_view};
}

SonarTrial drawn_trial(const SonarWorld& world, std::span<const SonarPlace> places, std::size_t cells, double reach,
                       std::uint64_t seed) {
  const mapping::SonarRingGeometry ring = ring_of_data_sheet();
  Rng rng = Rng{seed}.stream("sonar cells");
  SonarTrial trial;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t n = 0; n < cells; ++n) {
      const double least = ring.radius + 0.05;
      const double range = std::sqrt(rng.uniform(least * least, reach * reach));
      const Point2 at = range * unit(Angle::radians(rng.uniform(-std::numbers::pi, std::numbers::pi)));
      trial.examples.push_back(
          {sonar_cell(ring, places[i].view, at), world.is_occupied(places[i].world_from_base * at)});
      trial.of_place.push_back(i);
      trial.at.push_back(at);
    }
  }
  return trial;
}

}  // namespace docent::apps::train_sonar_command
