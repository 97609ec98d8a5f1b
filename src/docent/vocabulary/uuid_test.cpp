#include "docent/vocabulary/uuid.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent {
namespace {

TEST(Uuid, HasTimeVersionAndVariant) {
  Rng rng{1};
  const std::string id = make_uuid_v7(Time{0x0123456789ABLL * 1000000}, rng);
  EXPECT_EQ(id.substr(0, 15), "01234567-89ab-7");
  EXPECT_NE(std::string{"89ab"}.find(id[19]), std::string::npos);
  EXPECT_EQ(std::count(id.begin(), id.end(), '-'), 4);
  EXPECT_NE(make_uuid_v7(Time{}, rng), make_uuid_v7(Time{}, rng));
}

}  // namespace
}  // namespace docent
