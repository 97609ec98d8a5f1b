#include "docent/simulator/office/office_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "docent/base/files.h"

namespace docent::simulator {
namespace {

class OfficeFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "docent-office-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(OfficeFolder, HoldsTheWorldAndWhatTheSurveySays) {
  const Office office = draw_office(Rng{5});
  const Survey surveyed = survey(office.world, {}, Rng{5});
  ASSERT_TRUE(write_office(office, surveyed, 5, folder_));
  const auto world = load_world(folder_ / "simulation.yaml");
  ASSERT_TRUE(world) << world.error().message;
  const auto map = load_map(folder_ / "map.yaml");
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map_hash(*map), map_hash(surveyed.map));
  EXPECT_FALSE(surveyed.moved.empty());
  EXPECT_FALSE(surveyed.missing.empty());
  const std::string museum = read_file(folder_ / "museum.yaml").value();
  for (const OfficeStop& stop : office.stops) EXPECT_NE(museum.find("id: " + stop.id), std::string::npos);
  EXPECT_FALSE(write_office(office, surveyed, 5, folder_ / "map.yaml" / "inside a file"));
}

TEST_F(OfficeFolder, TheWorldIsReadBackAsItWas) {
  const Office office = draw_office(Rng{4});
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

}  // namespace
}  // namespace docent::simulator
