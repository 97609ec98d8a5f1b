// Tags on real photographs, beside the corners that AprilTag's authors expect.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "docent/base/files.h"
#include "docent/pictures/jpeg/jpeg.h"
#include "docent/vision/marks/tag_finder.h"

namespace docent::docking_by_tag {
namespace {

namespace fs = std::filesystem;

constexpr double kSame = 4.0;  // [pixels] between corners of one tag: the smallest there have sides of 14

vision::GreyPicture grey_of(const pictures::Image& image) {
  vision::GreyPicture grey{image.width(), image.height(), {}};
  const auto bytes = image.bytes();
  for (std::size_t i = 0; i < bytes.size(); i += 4)
    grey.shades.push_back(static_cast<std::uint8_t>((77 * bytes[i] + 150 * bytes[i + 1] + 29 * bytes[i + 2]) >> 8));
  return grey;
}

/// Lines of "id, (x y), (x y), (x y), (x y)".
std::vector<vision::SeenTag> expected_of(const fs::path& path) {
  std::vector<vision::SeenTag> tags;
  std::ifstream file{path};
  for (std::string line; std::getline(file, line);) {
    for (char& c : line)
      if (c == ',' || c == '(' || c == ')') c = ' ';
    std::istringstream words{line};
    vision::SeenTag tag;
    words >> tag.id;
    for (auto& corner : tag.corners) words >> corner.column >> corner.row;
    if (words) tags.push_back(tag);
  }
  return tags;
}

TEST(Tags, AreFoundOnPhotographsWhereTheirCornersAre) {
  const char* data = std::getenv("DOCENT_DATA");
  const fs::path folder = fs::path{data == nullptr ? "" : data} / "vision" / "tags";
  if (data == nullptr || !fs::is_directory(folder))
    GTEST_SKIP() << "no recorded data (DOCENT_DATA): no photographs of tags";
  int found = 0, all = 0, strange = 0;
  std::vector<double> off;
  for (const auto& entry : fs::directory_iterator{folder}) {
    if (entry.path().extension() != ".jpg") continue;
    const auto file = read_file(entry.path());
    ASSERT_TRUE(file);
    const auto image = pictures::decode_jpeg({reinterpret_cast<const std::uint8_t*>(file->data()), file->size()});
    ASSERT_TRUE(image);
    vision::TagFinder finder;
    const auto tags = finder.find(grey_of(*image));
    fs::path text = entry.path();
    const auto expected = expected_of(text.replace_extension(".txt"));
    std::vector<bool> is_met(tags.size());
    for (const auto& want : expected) {
      ++all;
      for (std::size_t i = 0; i < tags.size(); ++i) {
        double most = 0.0;
        for (std::size_t k = 0; k < 4; ++k)
          most = std::max(most, std::hypot(tags[i].corners[k].column - want.corners[k].column,
                                           tags[i].corners[k].row - want.corners[k].row));
        if (tags[i].id != want.id || most > kSame) continue;
        is_met[i] = true;
        off.push_back(most);
        ++found;
        break;
      }
    }
    strange += static_cast<int>(std::count(is_met.begin(), is_met.end(), false));
    for (std::size_t i = 0; i < tags.size(); ++i) {
      if (is_met[i]) continue;
      std::printf("  nobody expects: tag %d at (%.0f, %.0f), margin %.0f, in %s\n", tags[i].id,
                  tags[i].corners[0].column, tags[i].corners[0].row, tags[i].margin, entry.path().filename().c_str());
    }
  }
  ASSERT_GT(all, 0);
  std::sort(off.begin(), off.end());
  std::printf(
      "tags on photographs: %d of %d found, %d that nobody expects; the corner farthest off: median %.2f, p95 %.2f "
      "pixels\n",
      found, all, strange, off[off.size() / 2], off[off.size() * 19 / 20]);
  EXPECT_GE(found, all * 95 / 100);
  EXPECT_EQ(strange, 0);
  EXPECT_LT(off[off.size() / 2], 1.0);
}

}  // namespace
}  // namespace docent::docking_by_tag
