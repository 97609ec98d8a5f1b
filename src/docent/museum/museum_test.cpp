#include "docent/museum/museum.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

TEST(Museum, BonnIsFine) {
  for (const auto& fault : check_museum("museums/bonn")) ADD_FAILURE() << fault.message;
  const auto museum = load_museum("museums/bonn");
  ASSERT_TRUE(museum) << museum.error().message;
  EXPECT_EQ(museum->exhibits.size(), 14U) << "thirteen and the crew";
  std::size_t viewpoints = 0;
  for (const auto& exhibit : museum->exhibits) viewpoints += exhibit.viewpoints.size();
  EXPECT_EQ(viewpoints, 36U);
  EXPECT_TRUE(museum->find_exhibit("crew")->web_only);
}

TEST(Museum, SmithsonianIsFine) {
  for (const auto& fault : check_museum("museums/smithsonian")) ADD_FAILURE() << fault.message;
  const auto museum = load_museum("museums/smithsonian");
  ASSERT_TRUE(museum) << museum.error().message;
  EXPECT_EQ(museum->exhibits.size(), 23U);
  EXPECT_EQ(sensible_pairs(*museum), 77U);
  EXPECT_TRUE(museum->charger);
}

}  // namespace
}  // namespace docent
