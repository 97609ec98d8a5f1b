#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

#include "docent/museum/museum.h"
#include "docent/simulator/world/survey.h"
#include "docent/simulator/world/world.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent {
namespace {

using simulator::Solid;
using simulator::SolidKind;
using simulator::World;

struct Shipped {
  const char* name;
  std::uint64_t seed;  ///< of the committed survey
};
std::ostream& operator<<(std::ostream& stream, const Shipped& shipped) { return stream << shipped.name; }

/// Distances [m] from every cell of a 10 cm grid over the building to what the robot must not touch.
struct Clearances {
  GridFrame frame;
  std::vector<float> sensed;    ///< to walls and furniture
  std::vector<float> unsensed;  ///< to glass, plates, stairs, low furniture
};

class Museums : public ::testing::TestWithParam<Shipped> {
 protected:
  void SetUp() override {
    const std::string folder = std::string{"museums/"} + GetParam().name;
    auto museum = museum::load_museum(folder);
    ASSERT_TRUE(museum) << museum.error().message;
    museum_ = std::move(*museum);
    auto world = simulator::load_world(*museum_.simulation_path);
    ASSERT_TRUE(world) << world.error().message;
    world_ = std::move(*world);
  }

  [[nodiscard]] double distance_to_solids(Point2 place) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Solid& solid : world_.solids) least = std::min(least, distance(solid.polygon, place));
    return least;
  }

  [[nodiscard]] Clearances clearances() const {
    Clearances result;
    result.frame = museum_.map.frame;
    result.frame.resolution *= 2.0;
    result.frame.columns /= 2;
    result.frame.rows /= 2;
    std::vector<bool> sensed(result.frame.size());
    std::vector<bool> unsensed(result.frame.size());
    for (int row = 0; row < result.frame.rows; ++row) {
      for (int column = 0; column < result.frame.columns; ++column) {
        const CellIndex cell{column, row};
        if (!contains(world_.floor, result.frame.centre(cell))) sensed[result.frame.index(cell)] = true;
      }
    }
    for (const Solid& solid : world_.solids) mark(solid, result.frame, is_seen_by_laser(solid) ? sensed : unsensed);
    result.sensed = distance_transform(result.frame, sensed);
    result.unsensed = distance_transform(result.frame, unsensed);
    return result;
  }

  static void mark(const Solid& solid, const GridFrame& frame, std::vector<bool>& cells) {
    Point2 low = solid.polygon[0];
    Point2 high = low;
    for (const Point2 corner : solid.polygon) {
      low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
      high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
    }
    const CellIndex first = frame.cell_at(low - Point2{0.1, 0.1});
    const CellIndex last = frame.cell_at(high + Point2{0.1, 0.1});
    for (int row = first.row; row <= last.row; ++row) {
      for (int column = first.column; column <= last.column; ++column) {
        const CellIndex cell{column, row};
        if (frame.holds(cell) && distance(solid.polygon, frame.centre(cell)) <= 0.05) cells[frame.index(cell)] = true;
      }
    }
  }

  /// Cells that the robot reaches from home where `open` holds, inside the operating area.
  [[nodiscard]] std::vector<bool> reached(const GridFrame& frame, const std::vector<bool>& open) const {
    std::vector<bool> seen(frame.size());
    std::vector<CellIndex> front{frame.cell_at(world_.home)};
    if (!open[frame.index(front[0])]) return seen;
    seen[frame.index(front[0])] = true;
    while (!front.empty()) {
      const CellIndex cell = front.back();
      front.pop_back();
      for (const CellIndex next : {CellIndex{cell.column + 1, cell.row}, CellIndex{cell.column - 1, cell.row},
                                   CellIndex{cell.column, cell.row + 1}, CellIndex{cell.column, cell.row - 1}}) {
        if (!frame.holds(next) || seen[frame.index(next)] || !open[frame.index(next)]) continue;
        seen[frame.index(next)] = true;
        front.push_back(next);
      }
    }
    return seen;
  }

  [[nodiscard]] std::vector<bool> open_cells(const Clearances& all, double from_sensed, double from_unsensed) const {
    std::vector<bool> open(all.frame.size());
    for (int row = 0; row < all.frame.rows; ++row) {
      for (int column = 0; column < all.frame.columns; ++column) {
        const std::size_t i = all.frame.index({column, row});
        open[i] = all.sensed[i] >= from_sensed && all.unsensed[i] >= from_unsensed &&
                  contains(world_.operating_area, all.frame.centre({column, row}));
      }
    }
    return open;
  }

  /// Home, charger, exhibits and viewpoints, with names.
  void for_each_place(const std::function<void(const std::string&, const Pose2&)>& f) const {
    f("home", museum_.home);
    if (museum_.charger) f("charger", *museum_.charger);
    for (const auto& exhibit : museum_.exhibits) {
      f(exhibit.id, exhibit.pose);
      for (std::size_t i = 0; i < exhibit.viewpoints.size(); ++i) {
        f(exhibit.id + ", viewpoint " + std::to_string(i + 1), exhibit.viewpoints[i]);
      }
    }
  }

  museum::Museum museum_;
  World world_;
};

TEST_P(Museums, MapAndHazardsAreTheSurveyOfTheWorld) {
  const auto survey = simulator::survey(world_, {}, Rng{GetParam().seed});
  EXPECT_EQ(survey.map.frame.columns, museum_.map.frame.columns);
  EXPECT_EQ(survey.map.frame.rows, museum_.map.frame.rows);
  EXPECT_TRUE(survey.map.cells == museum_.map.cells) << "survey again: docent survey --seed " << GetParam().seed;
  ASSERT_EQ(survey.hazards.size(), museum_.hazards.size());
  for (std::size_t i = 0; i < survey.hazards.size(); ++i) {
    EXPECT_EQ(survey.hazards[i].id, museum_.hazards[i].id);
    EXPECT_EQ(survey.hazards[i].kind, to_text(museum_.hazards[i].kind));
    EXPECT_EQ(survey.hazards[i].polygon, museum_.hazards[i].polygon);
  }
  EXPECT_FALSE(survey.moved.empty());
  EXPECT_FALSE(survey.missing.empty());
}

TEST_P(Museums, SurveyIsWrongButNotMuch) {
  for (const Solid& solid : world_.solids) {
    if (is_seen_by_laser(solid)) continue;
    const auto hazard = std::find_if(museum_.hazards.begin(), museum_.hazards.end(),
                                     [&](const museum::Hazard& candidate) { return candidate.id == solid.id; });
    if (hazard == museum_.hazards.end()) {
      const bool covered = std::any_of(
          museum_.hazards.begin(), museum_.hazards.end(),
          [&](const museum::Hazard& candidate) { return distance(candidate.polygon, solid.polygon[0]) < 0.06; });
      EXPECT_TRUE(solid.kind == SolidKind::furniture && covered) << solid.id << " is no hazard";
      continue;
    }
    ASSERT_EQ(hazard->polygon.size(), solid.polygon.size());
    for (std::size_t i = 0; i < solid.polygon.size(); ++i) {
      const double error = distance(hazard->polygon[i], solid.polygon[i]);
      EXPECT_GT(error, 0.002) << solid.id;
      EXPECT_LT(error, 0.038) << solid.id;
    }
  }
}

TEST_P(Museums, AreaIsTheOperatingAreaAndKeepsFromTheStairs) {
  ASSERT_EQ(museum_.area.size(), world_.operating_area.size());
  for (std::size_t i = 0; i < museum_.area.size(); ++i) {
    EXPECT_LT(distance(museum_.area[i], world_.operating_area[i]), 1e-6);
  }
  for (const Solid& solid : world_.solids) {
    if (solid.kind != SolidKind::stairs) continue;
    for (const auto& side : sides(world_.operating_area)) {
      for (double t = 0.0; t <= 1.0; t += 0.02) {
        EXPECT_GE(distance(solid.polygon, side.a + t * (side.b - side.a)), 0.2) << solid.id;
      }
    }
    for (const Point2 corner : solid.polygon) EXPECT_FALSE(contains(world_.operating_area, corner)) << solid.id;
  }
}

TEST_P(Museums, PlacesHaveRoomInTheTrueWorld) {
  for_each_place([&](const std::string& name, const Pose2& place) {
    EXPECT_GE(distance_to_solids(place.position()), 0.6) << name;
    EXPECT_TRUE(contains(world_.operating_area, place.position())) << name;
  });
  for (const auto& exhibit : museum_.exhibits) {
    EXPECT_GE(distance_to_solids(exhibit.pose.position()), 0.8) << exhibit.id;
    EXPECT_LT(distance(exhibit.pose.position(), exhibit.look_at), 4.0) << exhibit.id << " is too far to be shown";
    const Angle off = direction(exhibit.pose.position(), exhibit.look_at) - exhibit.pose.theta;
    EXPECT_LT(std::abs(off.degrees()), 20.0) << exhibit.id << ": the robot looks elsewhere";
  }
}

TEST_P(Museums, OperatingAreaIsOnePiece) {
  const Clearances all = clearances();
  const auto open = open_cells(all, 0.365, 0.365);
  const auto seen = reached(all.frame, open);
  const auto total = std::count(open.begin(), open.end(), true);
  EXPECT_GE(static_cast<double>(std::count(seen.begin(), seen.end(), true)), 0.985 * static_cast<double>(total));
}

TEST_P(Museums, PassagesAreWideEnough) {
  const Clearances all = clearances();
  // 1.3 m between walls, 1.5 m beside a hazard; the grid is wrong by up to half a cell.
  const auto seen = reached(all.frame, open_cells(all, 0.65, 0.75));
  for_each_place([&](const std::string& name, const Pose2& place) {
    const CellIndex cell = all.frame.cell_at(place.position());
    bool near = false;
    for (int row = -5; row <= 5; ++row) {
      for (int column = -5; column <= 5; ++column) {
        const CellIndex neighbour{cell.column + column, cell.row + row};
        near = near || (all.frame.holds(neighbour) && seen[all.frame.index(neighbour)]);
      }
    }
    EXPECT_TRUE(near) << name;
  });
}

TEST_P(Museums, AnyBlockedPassageCanBeBypassed) {
  const Clearances all = clearances();
  const auto open = open_cells(all, 0.365, 0.365);
  constexpr double kBlockade = 1.0;  // [m], radius of a group of people that stands in the way
  constexpr double kStep = 1.25;
  for (double y = all.frame.origin.y; y < all.frame.origin.y + all.frame.rows * all.frame.resolution; y += kStep) {
    for (double x = all.frame.origin.x; x < all.frame.origin.x + all.frame.columns * all.frame.resolution; x += kStep) {
      const Point2 group{x, y};
      const CellIndex middle = all.frame.cell_at(group);
      if (!all.frame.holds(middle) || !open[all.frame.index(middle)] || distance(group, world_.home) < 2.0) continue;
      auto rest = open;
      const int reach = static_cast<int>(kBlockade / all.frame.resolution) + 1;
      for (int row = -reach; row <= reach; ++row) {
        for (int column = -reach; column <= reach; ++column) {
          const CellIndex cell{middle.column + column, middle.row + row};
          if (all.frame.holds(cell) && distance(all.frame.centre(cell), group) < kBlockade) {
            rest[all.frame.index(cell)] = false;
          }
        }
      }
      const auto seen = reached(all.frame, rest);
      for (const auto& exhibit : museum_.exhibits) {
        if (distance(exhibit.pose.position(), group) < kBlockade + 0.7) continue;
        EXPECT_TRUE(seen[all.frame.index(all.frame.cell_at(exhibit.pose.position()))])
            << exhibit.id << " is cut off by people at " << x << ", " << y;
      }
    }
  }
}

TEST_P(Museums, PeopleFindWhatTheSimulationNames) {
  for (const auto& id : world_.exhibits) {
    const auto* exhibit = museum_.find_exhibit(id);
    ASSERT_NE(exhibit, nullptr) << id;
    EXPECT_FALSE(exhibit->web_only) << id;
  }
  for (const auto& id : world_.tours) EXPECT_NE(museum_.find_tour(id), nullptr) << id;
  for (const auto& exhibit : museum_.exhibits) {
    EXPECT_EQ(std::count(world_.exhibits.begin(), world_.exhibits.end(), exhibit.id), exhibit.web_only ? 0 : 1);
  }
  EXPECT_LT(distance(world_.home, museum_.home.position()), 0.5);
  for (const Point2 entrance : world_.entrances) EXPECT_GT(distance_to_solids(entrance), 0.2);
  for (const auto& attraction : world_.attractions) EXPECT_TRUE(contains(world_.floor, attraction.centre));
}

TEST_P(Museums, TextsCanBeSpoken) {
  for (const auto& exhibit : museum_.exhibits) {
    for (const auto& language : museum_.languages) {
      const std::string& brief = exhibit.short_text.at(language);
      EXPECT_GE(brief.size(), 100U) << exhibit.id << " " << language;
      EXPECT_LE(brief.size(), 400U) << exhibit.id << " " << language << ": more than about 25 s";
      if (exhibit.long_text.empty()) continue;
      EXPECT_GT(exhibit.long_text.at(language).size(), brief.size()) << exhibit.id << " " << language;
      EXPECT_LE(exhibit.long_text.at(language).size(), 1400U) << exhibit.id << " " << language;
    }
  }
}

TEST_P(Museums, SpeakThreeLanguagesAndShowEveryExhibit) {
  EXPECT_EQ(museum_.languages, (std::vector<std::string>{"en", "de", "fr"}));
  for (const auto& exhibit : museum_.exhibits) {
    for (const auto* texts : {&exhibit.title, &exhibit.short_text, &exhibit.long_text})
      EXPECT_EQ(texts->size(), museum_.languages.size()) << exhibit.id;
    EXPECT_EQ(exhibit.picture, "content/" + exhibit.id + ".svg") << "scripts/draw-exhibits draws it";
    EXPECT_TRUE(!exhibit.links.empty() || exhibit.web_only) << exhibit.id;
  }
  for (const auto& tour : museum_.tours) EXPECT_EQ(tour.title.size(), museum_.languages.size()) << tour.id;
}

TEST_P(Museums, ToursAreOfAllLengths) {
  std::size_t fixed = 0;
  bool six_minutes = false;
  for (const auto& tour : museum_.tours) {
    if (tour.minutes) six_minutes = six_minutes || *tour.minutes == 6.0;
    if (tour.exhibits.empty()) continue;
    ++fixed;
    EXPECT_GE(tour.exhibits.size(), 3U) << tour.id;
    EXPECT_LE(tour.exhibits.size(), 6U) << tour.id;
  }
  EXPECT_GE(fixed, 4U);
  EXPECT_TRUE(six_minutes);
}

INSTANTIATE_TEST_SUITE_P(All, Museums, ::testing::Values(Shipped{"bonn", 1995}, Shipped{"smithsonian", 1998}),
                         [](const auto& instance) { return std::string{instance.param.name}; });

TEST(Bonn, HasAPlateInTheMiddleAndAStaircase) {
  const auto world = simulator::load_world("museums/bonn/simulation.yaml").value();
  const auto has = [&](SolidKind kind, Point2 at) {
    return std::any_of(world.solids.begin(), world.solids.end(),
                       [&](const Solid& solid) { return solid.kind == kind && distance(solid.polygon, at) < 0.5; });
  };
  EXPECT_TRUE(has(SolidKind::plate, {14.5, 14.2}));
  EXPECT_TRUE(has(SolidKind::stairs, {22.8, 4.0}));
}

TEST(Smithsonian, CentreIsEmptyAndHigh) {
  const auto world = simulator::load_world("museums/smithsonian/simulation.yaml").value();
  for (const Solid& solid : world.solids) EXPECT_GE(distance(solid.polygon, world.home), 10.0) << solid.id;
  EXPECT_GT(world.ceiling_at(world.home), 2.0 * world.ceiling_at({5.0, 15.0}));
}

}  // namespace
}  // namespace docent
