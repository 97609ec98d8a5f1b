#include "docent/vision/scene/contacts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"

namespace docent::vision {
namespace {

constexpr int kBlock = 4;
constexpr pictures::Color kGreyFloor{120, 125, 130}, kRedBox{150, 30, 30}, kBrownTable{150, 110, 60};

DepthCamera floor_camera() { return {320, 240, 290.0, 160.0, 120.0, {0.2, 0.0, 1.0, {}, Angle::degrees(30.0), {}}}; }

struct SeenBox {
  double x = 0.0, left = 0.0, right = 0.0;  ///< [m] base: its front, up to the picture's top
  pictures::Color color;
};

/// Floor with boxes on it, by rays; noise of 5 grey levels.
pictures::Image room(const std::vector<SeenBox>& boxes, Rng& rng) {
  const DepthCamera camera = floor_camera();
  pictures::Image image{camera.columns, camera.rows};
  for (int row = 0; row < camera.rows; ++row) {
    for (int column = 0; column < camera.columns; ++column) {
      const Eigen::Vector3d ray = camera.ray(column, row);
      double depth = ray.z() < 0.0 ? -camera.mount.z / ray.z() : 1e9;
      pictures::Color color = ray.z() < 0.0 ? kGreyFloor : pictures::Color{230, 230, 225};
      for (const SeenBox& box : boxes) {
        const double at = (box.x - camera.mount.x) / ray.x();
        const double y = at * ray.y();
        if (at > 0.0 && at < depth && y > box.right && y < box.left) {
          depth = at;
          color = box.color;
        }
      }
      const auto noisy = [&](std::uint8_t value) {
        return static_cast<std::uint8_t>(std::clamp(value + 5.0 * rng.normal(), 0.0, 255.0));
      };
      image.set(column, row, {noisy(color.red), noisy(color.green), noisy(color.blue)});
    }
  }
  return image;
}

/// Taught by a picture of which the right answer is known.
FloorColours taught(Rng& rng) {
  const SeenBox box{2.0, 0.5, -0.5, kRedBox};
  const RoughSites seen = rough_sites_of(room({box, {3.0, 2.0, 0.6, kBrownTable}}, rng), kBlock);
  const auto may_be = below_horizon(seen.sites, floor_camera(), 6.0);
  std::vector<SiteKind> kinds;
  for (std::size_t i = 0; i < seen.sites.cells.size(); ++i) {
    const Site& site = seen.sites.cells[i];
    kinds.push_back(may_be[i] == 0                     ? SiteKind::unknown
                    : std::abs(site.red_green) < 15.0F ? SiteKind::floor
                                                       : SiteKind::other);
  }
  FloorColours colours;
  EXPECT_TRUE(colours.is_empty());
  colours.learn(seen, kinds);
  colours.finish();
  EXPECT_FALSE(colours.is_empty());
  return colours;
}

TEST(Contacts, StandWhereTheFloorEndsAtABox) {
  Rng rng{1};
  const FloorColours colours = taught(rng);
  for (const double x : {1.4, 2.0, 2.8}) {
    const RoughSites seen = rough_sites_of(room({{x, 0.4, -0.4, kRedBox}}, rng), kBlock);
    const FloorMask mask = find_floor(seen, colours, floor_camera());
    const auto contacts = contacts_of(mask, floor_camera(), 6.0);
    ASSERT_GT(contacts.size(), 10U) << x;
    for (const Contact& contact : contacts) {
      if (std::abs(contact.place.y) > 0.35) continue;
      EXPECT_NEAR(contact.place.x, x, 0.1 * x);
      EXPECT_NEAR(contact.place.x, x, 4.0 * contact.distance_sigma);
    }
    const auto lines = lines_through(contacts);
    ASSERT_FALSE(lines.empty()) << x;
    EXPECT_NEAR(std::abs(direction(lines.front().line.a, lines.front().line.b).radians()), 1.5708, 0.15);
    EXPECT_GT(lines.front().across_sigma, 0.005);
  }
}

TEST(Contacts, FartherOnesAreLessSure) {
  FloorMask mask{80, 60, kBlock, std::vector<unsigned char>(4800, 1), {}};
  for (int column = 0; column < 80; ++column)
    for (int row = 0; row < (column < 40 ? 20 : 40); ++row) mask.is_floor[mask.index(column, row)] = 0;
  const auto contacts = contacts_of(mask, floor_camera(), 6.0);
  ASSERT_EQ(contacts.size(), 80U);
  EXPECT_GT(contacts.front().distance, contacts.back().distance);
  EXPECT_GT(contacts.front().distance_sigma, 1.5 * contacts.back().distance_sigma);
  EXPECT_GE(lines_through(contacts).size(), 2U);
}

TEST(Contacts, AFloorThatGoesOnHasNone) {
  const FloorMask mask{80, 60, kBlock, std::vector<unsigned char>(4800, 1), {}};
  EXPECT_TRUE(contacts_of(mask, floor_camera(), 6.0).empty());
  EXPECT_FALSE(floor_at(floor_camera(), 160.0, -500.0)) << "above the horizon";
}

TEST(FloorMask, WhatLooksLikeFloorAboveTheEndOfTheFloorIsNone) {
  Rng rng{2};
  const FloorColours colours = taught(rng);
  // A red box with a band of the floor's grey on it: a shelf.
  pictures::Image image = room({{1.6, 1.0, -1.0, kRedBox}}, rng);
  for (int row = 60; row < 80; ++row)
    for (int column = 100; column < 220; ++column) image.set(column, row, kGreyFloor);
  const FloorMask mask = find_floor(rough_sites_of(image, kBlock), colours, floor_camera());
  EXPECT_EQ(mask.is_floor[mask.index(40, 17)], 0);
  EXPECT_EQ(mask.is_floor[mask.index(40, 55)], 1);
}

}  // namespace
}  // namespace docent::vision
