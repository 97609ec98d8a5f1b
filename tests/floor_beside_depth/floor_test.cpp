// Sixty recorded frames of a Kinect in a kitchen: the floor in the colour picture alone beside depth's, and distances
// to where it ends. The colours of the floor are learned from the depth of other stretches of the recording than the
// one that is judged. Prints the tables that docs/reports quotes; draws the frames to a folder that FLOOR_PICTURES
// names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "docent/geometry/polygon.h"
#include "docent/pictures/figure.h"
#include "docent/vision/regions/region_merging.h"
#include "docent/vision/scene/contacts.h"
#include "rgbd_frames.h"

namespace docent::floor_beside_depth {
namespace {

using vision::FloorMask;
using vision::SiteKind;

constexpr int kBlock = 4;             // [pixels] of a site
constexpr int kStretches = 4;         // of frames with floor
constexpr double kLeastFloor = 0.05;  // of a picture, by depth, to judge how well its outline is met

struct Judged {
  const Frame* frame = nullptr;
  vision::DepthCamera camera;
  DepthInColour depth;
  vision::RoughSites sites;
  std::vector<SiteKind> kinds;  ///< of sites, for learning
  double floor_share = 0.0;     ///< of the picture
  int stretch = -1;             ///< -1: too little floor
};

std::size_t pixel_at(const Judged& of, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(of.frame->colour.width()) + static_cast<std::size_t>(x);
}

/// Floor where nine tenths of what is known of a site's pixels are, another thing where none is.
void say_kinds(Judged& of) {
  const vision::Sites& sites = of.sites.sites;
  const auto may_be = vision::below_horizon(sites, of.camera, vision::FloorMaskParams{}.reach);
  for (int row = 0; row < sites.rows; ++row) {
    for (int column = 0; column < sites.columns; ++column) {
      int known = 0, floor = 0;
      for (int y = 0; y < kBlock; ++y) {
        for (int x = 0; x < kBlock; ++x) {
          const SiteKind kind = of.depth.kinds[pixel_at(of, column * kBlock + x, row * kBlock + y)];
          known += kind == SiteKind::unknown ? 0 : 1;
          floor += kind == SiteKind::floor ? 1 : 0;
        }
      }
      const bool is_known = 2 * known > kBlock * kBlock && may_be[sites.index(column, row)] != 0;
      of.kinds.push_back(!is_known || (floor > 0 && 10 * floor < 9 * known) ? SiteKind::unknown
                         : floor > 0                                        ? SiteKind::floor
                                                                            : SiteKind::other);
    }
  }
}

std::vector<Judged> judged_of(const std::vector<Frame>& frames, const WorldFloor& floor, double focal) {
  std::vector<Judged> all;
  for (const Frame& frame : frames) {
    Judged judged{&frame,
                  colour_camera_of(frame, floor),
                  depth_in_colour(frame, floor, focal),
                  vision::rough_sites_of(frame.colour, kBlock),
                  {},
                  0.0,
                  -1};
    say_kinds(judged);
    judged.floor_share =
        static_cast<double>(std::count(judged.depth.kinds.begin(), judged.depth.kinds.end(), SiteKind::floor)) /
        static_cast<double>(judged.depth.kinds.size());
    all.push_back(std::move(judged));
  }
  const auto enough = [](const Judged& judged) { return judged.floor_share >= kLeastFloor; };
  const auto count = std::count_if(all.begin(), all.end(), enough);
  std::ptrdiff_t i = 0;
  for (Judged& judged : all)
    if (enough(judged)) judged.stretch = static_cast<int>(i++ * kStretches / count);
  return all;
}

struct Overlap {
  double both = 0.0, either = 0.0, missed = 0.0, false_floor = 0.0, known = 0.0;
  [[nodiscard]] double share() const { return either > 0.0 ? both / either : 1.0; }
  void add(const Overlap& other) {
    both += other.both;
    either += other.either;
    missed += other.missed;
    false_floor += other.false_floor;
    known += other.known;
  }
};

Overlap overlap_of(const Judged& of, const FloorMask& mask) {
  Overlap overlap;
  for (int y = 0; y < of.frame->colour.height(); ++y) {
    for (int x = 0; x < of.frame->colour.width(); ++x) {
      const SiteKind kind = of.depth.kinds[pixel_at(of, x, y)];
      if (kind == SiteKind::unknown) continue;
      const bool truly = kind == SiteKind::floor, said = mask.is_floor[mask.index(x / kBlock, y / kBlock)] != 0;
      overlap.known += 1.0;
      overlap.both += truly && said ? 1.0 : 0.0;
      overlap.either += truly || said ? 1.0 : 0.0;
      overlap.missed += truly && !said ? 1.0 : 0.0;
      overlap.false_floor += said && !truly ? 1.0 : 0.0;
    }
  }
  return overlap;
}

/// The rule of 1994 alone: regions that touch the picture's foot are floor, below the horizon.
FloorMask regions_at_the_foot(const Judged& of) {
  const vision::Sites& sites = of.sites.sites;
  const vision::Segmentation found = vision::merge_regions(sites);
  std::vector<bool> is_at_foot(found.regions.size());
  for (int column = 0; column < sites.columns; ++column)
    is_at_foot[static_cast<std::size_t>(found.of[sites.index(column, sites.rows - 1)])] = true;
  FloorMask mask{sites.columns, sites.rows, sites.block, std::vector<unsigned char>(sites.cells.size()), {}};
  for (std::size_t i = 0; i < mask.is_floor.size(); ++i)
    mask.is_floor[i] = is_at_foot[static_cast<std::size_t>(found.of[i])] ? 1 : 0;
  return mask;
}

void draw(const Judged& of, const FloorMask& mask, const std::vector<vision::Contact>& contacts) {
  const char* folder = std::getenv("FLOOR_PICTURES");
  if (folder == nullptr) return;
  pictures::Image image = of.frame->colour;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const SiteKind kind = of.depth.kinds[pixel_at(of, x, y)];
      const bool truly = kind == SiteKind::floor, said = mask.is_floor[mask.index(x / kBlock, y / kBlock)] != 0;
      if (said) image.blend(x, y, kind == SiteKind::other ? pictures::colors::kViolet : pictures::colors::kGreen, 0.45);
      if (truly && !said) image.blend(x, y, pictures::colors::kBlue, 0.45);
    }
  }
  for (const auto& contact : contacts)
    for (int x = 0; x < kBlock; ++x)
      for (int y = -1; y <= 1; ++y)
        image.set(contact.column * kBlock + x, contact.row * kBlock + y, pictures::colors::kRed);
  pictures::Axes axes{{0.0, 0.0}, {640.0, 480.0}, 640.0, 480.0, "column [pixels]", "row from below [pixels]"};
  axes.set_title(of.frame->name);
  pictures::Figure figure{"The floor by colour: green right, violet wrong, blue missed; red: where it ends"};
  figure.add(std::move(axes)).add([image](pictures::Canvas& canvas) {
    canvas.draw_image(image, {0.0, 0.0}, {640.0, 480.0});
  });
  ASSERT_TRUE(figure.save(std::filesystem::path{folder} / (of.frame->name + ".png")));
}

/// What depth says of a site: more floor than other things, the reverse, or neither.
SiteKind majority(const Judged& of, int column, int row) {
  int balance = 0;
  for (int y = row * kBlock; y < (row + 1) * kBlock; ++y) {
    for (int x = column * kBlock; x < (column + 1) * kBlock; ++x) {
      const SiteKind kind = of.depth.kinds[pixel_at(of, x, y)];
      balance += kind == SiteKind::floor ? 1 : kind == SiteKind::other ? -1 : 0;
    }
  }
  return balance > 0 ? SiteKind::floor : balance < 0 ? SiteKind::other : SiteKind::unknown;
}

/// [m] as depth measured it on the floor of a site, not by the ray; 0: nothing.
double measured_at(const Judged& of, int column, int row) {
  double sum = 0.0, count = 0.0;
  for (int y = row * kBlock; y < (row + 1) * kBlock; ++y) {
    for (int x = column * kBlock; x < (column + 1) * kBlock; ++x) {
      if (of.depth.kinds[pixel_at(of, x, y)] != SiteKind::floor) continue;
      sum += static_cast<double>(of.depth.away[pixel_at(of, x, y)]);
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// A distance by colour beside that by depth. [m]
struct DistancePair {
  double said = 0.0, truly = 0.0;
  bool is_of_line = false;  ///< said by a line through many columns, else by one column
};

/// Distances to where the floor ends by colour, and to where it ends by depth, in the same columns. Where depth is
/// silent above the end of its floor it has not seen what the floor ends at: such columns say nothing.
std::vector<DistancePair> distances_of(const Judged& of, const std::vector<vision::Contact>& contacts, double reach) {
  const vision::Sites& sites = of.sites.sites;
  FloorMask truth{sites.columns, sites.rows, sites.block, {}, {}};
  for (int row = 0; row < sites.rows; ++row)
    for (int column = 0; column < sites.columns; ++column)
      truth.is_floor.push_back(majority(of, column, row) == SiteKind::floor ? 1 : 0);
  std::vector<double> measured(static_cast<std::size_t>(sites.columns), 0.0);
  for (const vision::Contact& end : vision::contacts_of(truth, of.camera, reach))
    if (end.row > 0 && majority(of, end.column, end.row - 1) == SiteKind::other)
      measured[static_cast<std::size_t>(end.column)] = measured_at(of, end.column, end.row);
  std::vector<DistancePair> pairs;
  const Point2 eye{of.camera.mount.x, of.camera.mount.y};
  for (const vision::Contact& contact : contacts) {
    const double truly = measured[static_cast<std::size_t>(contact.column)];
    if (truly > 0.0) pairs.push_back({contact.distance, truly, false});
  }
  for (const vision::ContactLine& line : vision::lines_through(contacts)) {
    for (int i = line.first; i <= line.last; ++i) {
      const vision::Contact& contact = contacts[static_cast<std::size_t>(i)];
      const double truly = measured[static_cast<std::size_t>(contact.column)];
      const auto said = ray_distance(eye, unit(direction(eye, contact.place)), line.line);
      if (truly > 0.0 && said) pairs.push_back({*said, truly, true});
    }
  }
  return pairs;
}

void print_distances(const char* of, std::vector<double>& errors) {
  std::sort(errors.begin(), errors.end());
  const auto within = std::lower_bound(errors.begin(), errors.end(), 0.1) - errors.begin();
  const std::size_t count = errors.size();
  std::printf(
      "distances to where the floor ends, %s, up to 3 m: %zu columns, %.1f %% within 10 %%, median %.1f %%, p90 %.1f "
      "%%, p95 %.1f %%\n",
      of, count, 100.0 * static_cast<double>(within) / static_cast<double>(count), 100.0 * errors[count / 2],
      100.0 * errors[count * 9 / 10], 100.0 * errors[count * 19 / 20]);
}

class FloorBesideDepth : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("DOCENT_DATA");
    if (data != nullptr) frames_ = frames_of(std::filesystem::path{data} / "vision" / "rgbd", focal_);
    if (frames_.empty()) GTEST_SKIP() << "no recorded data (DOCENT_DATA): no frames of a depth camera";
    judged_ = judged_of(frames_, floor_of(frames_, focal_), focal_);
  }
  double focal_ = 0.0;
  std::vector<Frame> frames_;
  std::vector<Judged> judged_;
};

TEST_F(FloorBesideDepth, IsFoundByColoursLearnedElsewhereAndItsEndsAreMeasured) {
  const vision::FloorMaskParams params;
  Overlap all, elsewhere, at_foot;
  std::vector<double> stretches, frames, errors, line_errors;
  for (int stretch = -1; stretch < kStretches; ++stretch) {
    vision::FloorColours colours;
    for (const Judged& of : judged_)
      if (of.stretch != stretch || stretch < 0) colours.learn(of.sites, of.kinds);
    colours.finish();
    Overlap here;
    for (const Judged& of : judged_) {
      if (of.stretch != stretch) continue;
      const FloorMask mask = vision::find_floor(of.sites, colours, of.camera, params);
      const auto contacts = vision::contacts_of(mask, of.camera, params.reach);
      const Overlap overlap = overlap_of(of, mask);
      draw(of, mask, contacts);
      (stretch < 0 ? elsewhere : here).add(overlap);
      if (stretch < 0) continue;
      std::printf("%s: floor %4.1f %%, IoU %.3f, missed %.3f, false %.3f; plane %s, %.1f degrees off the calibration\n",
                  of.frame->name.c_str(), 100.0 * of.floor_share, overlap.share(), overlap.missed / overlap.either,
                  overlap.false_floor / overlap.either, of.depth.is_plane_seen ? "seen" : "not seen",
                  of.depth.off_degrees);
      frames.push_back(overlap.share());
      at_foot.add(overlap_of(of, regions_at_the_foot(of)));
      for (const auto& [said, truly, is_of_line] : distances_of(of, contacts, params.reach))
        if (truly <= 3.0) (is_of_line ? line_errors : errors).push_back(std::abs(said - truly) / truly);
    }
    if (stretch < 0) continue;
    stretches.push_back(here.share());
    all.add(here);
  }
  ASSERT_GE(frames.size(), 8U);
  ASSERT_GE(line_errors.size(), 200U);
  std::sort(frames.begin(), frames.end());
  std::sort(stretches.begin(), stretches.end());
  std::printf(
      "\nfloor by colour, %zu frames with at least %.0f %% of floor: IoU %.3f of all pixels; frames %.3f to %.3f, "
      "stretches %.3f to %.3f\n",
      frames.size(), 100.0 * kLeastFloor, all.share(), frames.front(), frames.back(), stretches.front(),
      stretches.back());
  Overlap together = all;
  together.add(elsewhere);
  std::printf("all %zu frames together, floor or not: IoU %.3f\n", judged_.size(), together.share());
  std::printf("regions at the picture's foot alone: IoU %.3f\n", at_foot.share());
  std::printf("the other %zu frames: %.2f %% of what is no floor is called floor (their colours were learned, too)\n",
              judged_.size() - frames.size(), 100.0 * elsewhere.false_floor / elsewhere.known);
  print_distances("column by column", errors);
  print_distances("by lines", line_errors);
  EXPECT_GE(all.share(), 0.85);
  EXPECT_GT(all.share(), at_foot.share());
  EXPECT_LE(line_errors[line_errors.size() * 95 / 100], 0.1);
  EXPECT_LT(elsewhere.false_floor / elsewhere.known, 0.05);
}

}  // namespace
}  // namespace docent::floor_beside_depth
