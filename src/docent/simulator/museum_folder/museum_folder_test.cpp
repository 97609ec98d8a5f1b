#include "docent/simulator/museum_folder/museum_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "docent/base/files.h"
#include "docent/base/yaml.h"
#include "docent/simulator/office/office.h"

namespace docent::simulator {
namespace {

class MuseumFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "docent-museum-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(MuseumFolder, HoldsTheWorldAndWhatTheSurveySays) {
  const Office office = draw_office(5);
  const Survey surveyed = survey(office.world, {}, Rng{5});
  ASSERT_TRUE(write_museum(office, surveyed, folder_));
  const auto world = load_world(folder_ / "simulation.yaml");
  ASSERT_TRUE(world) << world.error().message;
  const auto map = load_map(folder_ / "map.yaml");
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map_hash(*map), map_hash(surveyed.map));
  EXPECT_FALSE(surveyed.moved.empty());
  EXPECT_FALSE(surveyed.missing.empty());
  const std::string museum = read_file(folder_ / "museum.yaml").value();
  for (const Stop& stop : office.stops) EXPECT_NE(museum.find("id: " + stop.id), std::string::npos);
  EXPECT_FALSE(write_museum(office, surveyed, folder_ / "map.yaml" / "inside a file"));
}

TEST_F(MuseumFolder, AnyTitleIsOne) {
  Office office = draw_office(5);
  office.title = "The \"old\" \\ mill:\n{new} # 7";
  ASSERT_TRUE(write_museum(office, survey(office.world, {}, Rng{5}), folder_));
  const auto museum = YamlFile::load(folder_ / "museum.yaml");
  ASSERT_TRUE(museum) << museum.error().message;
  EXPECT_EQ(museum->root()["name"]["en"].as<std::string>(), "The \"old\" \\ mill: {new} # 7");
}

TEST_F(MuseumFolder, TheWorldIsReadBackAsItWas) {
  const Office office = draw_office(4);
  const auto world = parse_world(to_yaml(office.world), "simulation.yaml");
  ASSERT_TRUE(world) << world.error().message;
  ASSERT_EQ(world->solids.size(), office.world.solids.size());
  for (std::size_t i = 0; i < world->solids.size(); ++i) {
    EXPECT_EQ(world->solids[i].id, office.world.solids[i].id);
    EXPECT_EQ(world->solids[i].movable, office.world.solids[i].movable);
    for (std::size_t k = 0; k < world->solids[i].polygon.size(); ++k) {
      EXPECT_NEAR(distance(world->solids[i].polygon[k], office.world.solids[i].polygon[k]), 0.0, 1e-9);
    }
  }
}

TEST_F(MuseumFolder, CeilingsMarksAndSmallThingsAreReadBack) {
  Office office = draw_office(4);
  EXPECT_EQ(to_yaml(office.world).find("ceiling_style"), std::string::npos) << "what is usual is not said";
  World& drawn = office.world;
  drawn.ceiling = {{{{1.0, 1.0}, {3.0, 1.0}, {3.0, 3.0}}, 7.5}};
  drawn.ceiling_style = {CeilingKind::periodic, 12};
  drawn.marks = {{"charger", 5, {1.5, 2.5}, 0.4, Angle::degrees(90.0), -0.5, 0.12}};
  drawn.solids.push_back(
      {"can-1", SolidKind::furniture, {{1.0, 1.0}, {1.1, 1.0}, {1.0, 1.1}}, 0.0, 0.12, false, SolidForm::can});
  const auto world = parse_world(to_yaml(drawn), "simulation.yaml");
  ASSERT_TRUE(world) << world.error().message;
  ASSERT_EQ(world->ceiling.size(), 1U);
  EXPECT_DOUBLE_EQ(world->ceiling[0].height, 7.5);
  EXPECT_EQ(world->ceiling[0].polygon, drawn.ceiling[0].polygon);
  EXPECT_EQ(world->ceiling_style.kind, CeilingKind::periodic);
  EXPECT_EQ(world->ceiling_style.seed, 12U);
  ASSERT_EQ(world->marks.size(), 1U);
  EXPECT_EQ(world->marks[0].tag, 5);
  EXPECT_NEAR(world->marks[0].heading.degrees(), 90.0, 1e-3);
  EXPECT_NEAR(world->marks[0].tilt, -0.5, 1e-4);
  EXPECT_EQ(world->solids.back().form, SolidForm::can);
}

TEST_F(MuseumFolder, KeepsTheRecordedPeopleInAFileOfTheirOwn) {
  Office office = draw_office(6);
  office.world.pedestrians_file = "pedestrians.txt";
  office.world.pedestrians = {{"eth", 12.0, {{2.0, {{1.0, 2.0}, {1.5, 2.25}, {2.0, 2.5}}}}}};
  ASSERT_TRUE(write_museum(office, survey(office.world, {}, Rng{6}), folder_));
  const auto world = load_world(folder_ / "simulation.yaml");
  ASSERT_TRUE(world) << world.error().message;
  ASSERT_EQ(world->pedestrians.size(), 1U);
  EXPECT_EQ(world->pedestrians[0].name, "eth");
  EXPECT_EQ(world->pedestrians[0].tracks.at(0).points, office.world.pedestrians[0].tracks[0].points);
  // Nothing that the robot reads names it.
  EXPECT_EQ(read_file(folder_ / "museum.yaml").value().find("pedestrians"), std::string::npos);
  std::filesystem::remove(folder_ / "pedestrians.txt");
  EXPECT_FALSE(load_world(folder_ / "simulation.yaml"));
}

}  // namespace
}  // namespace docent::simulator
