#include "docent/simulator/office/office_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "docent/museum/museum.h"

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

TEST_F(OfficeFolder, EveryBuildingIsAMuseumThatCanWork) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    const Office office = draw_office(Rng{seed});
    const auto out = folder_ / std::to_string(seed);
    ASSERT_TRUE(write_office(office, survey(office.world, {}, Rng{seed}), seed, out));
    for (const Error& fault : check_museum(out)) ADD_FAILURE() << "seed " << seed << ": " << fault.message;
  }
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
