#include "docent/apps/eyes/object_pictures.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <system_error>

#include "docent/base/files.h"
#include "docent/pictures/jpeg/jpeg.h"

namespace docent::apps::objects_command {
namespace {

namespace fs = std::filesystem;

constexpr int kLongestSide = 16384;  // [pixels] that an image holds; telephones make 12,000
constexpr int kLeastSide = 32;       // [pixels] of a picture that shows anything
constexpr double kPanel = 260.0;     // [points] height of each half of the figure

/// Some systems leave "._NAME.jpg" beside what they copy: no picture.
bool is_jpeg(const fs::path& path) {
  if (path.filename().string().starts_with('.')) return false;
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".jpg" || extension == ".jpeg";
}

std::uint8_t shade(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F)); }

/// The colour whose mean and differences a site holds.
pictures::Color color_of(const vision::Site& site) {
  // luminance = (r + g + b) / 3, red_green = r - g, yellow_blue = (r + g) / 2 - b
  const float both = site.luminance + site.yellow_blue / 3.0F;  // (r + g) / 2
  return {shade(both + 0.5F * site.red_green), shade(both - 0.5F * site.red_green), shade(both - site.yellow_blue),
          255};
}

pictures::Image image_of(const vision::Segmentation& regions) {
  pictures::Image image{regions.columns, regions.rows};
  for (int row = 0; row < regions.rows; ++row)
    for (int column = 0; column < regions.columns; ++column) {
      const int site = row * regions.columns + column;
      const int region = regions.of[static_cast<std::size_t>(site)];
      image.set(column, row, color_of(regions.regions[static_cast<std::size_t>(region)].mean));
    }
  return image;
}

/// Lines between the thing and what is no thing, in sites.
std::vector<std::array<Point2, 2>> outline_of(const SeenPicture& seen) {
  std::vector<std::array<Point2, 2>> lines;
  const auto is_thing = [&](int column, int row) { return seen.thing.is_thing[seen.sites.index(column, row)]; };
  for (int row = 0; row < seen.sites.rows; ++row) {
    for (int column = 0; column < seen.sites.columns; ++column) {
      const double x = column, y = row;
      if (column + 1 < seen.sites.columns && is_thing(column, row) != is_thing(column + 1, row))
        lines.push_back({Point2{x + 1.0, y}, Point2{x + 1.0, y + 1.0}});
      if (row + 1 < seen.sites.rows && is_thing(column, row) != is_thing(column, row + 1))
        lines.push_back({Point2{x, y + 1.0}, Point2{x + 1.0, y + 1.0}});
    }
  }
  return lines;
}

pictures::Axes& add_panel(pictures::Figure& figure, const pictures::Image& image, const pictures::Image& sized,
                          const std::string& title) {
  const double width = sized.width(), height = sized.height();
  pictures::Axes axes{{0.0, 0.0}, {width, height},   kPanel * width / height,
                      kPanel,     "column [pixels]", "row from below [pixels]"};
  axes.set_title(title);
  pictures::Axes& added = figure.add(std::move(axes));
  added.add([image, &added](pictures::Canvas& canvas) {
    canvas.draw_image(image, {0.0, 0.0}, {added.width(), added.height()});
  });
  return added;
}

}  // namespace

Result<pictures::Image> read_picture(const fs::path& path) {
  const auto file = read_file(path);
  if (!file) return tl::unexpected<Error>(file.error());
  auto picture =
      pictures::decode_jpeg({reinterpret_cast<const std::uint8_t*>(file->data()), file->size()}, kLongestSide);
  if (!picture) return fail(path.string() + ": " + picture.error().message);
  if (std::min(picture->width(), picture->height()) < kLeastSide)
    return fail(path.string() + ": is " + std::to_string(picture->width()) + " x " + std::to_string(picture->height()) +
                " pixels; it takes at least " + std::to_string(kLeastSide) + " in both");
  return picture;
}

Result<std::vector<ObjectFolder>> object_folders(const fs::path& path) {
  std::error_code error;
  std::vector<ObjectFolder> folders;
  for (fs::directory_iterator entry{path, error}, end; !error && entry != end; entry.increment(error)) {
    std::error_code none;
    if (!entry->is_directory(none)) continue;
    ObjectFolder folder{entry->path().filename().string(), {}};
    for (const auto& file : fs::directory_iterator{entry->path(), none})
      if (is_jpeg(file.path())) folder.pictures.push_back(file.path());
    std::sort(folder.pictures.begin(), folder.pictures.end());
    if (!folder.pictures.empty()) folders.push_back(std::move(folder));
  }
  if (error) return fail(path.string() + ": cannot be read: " + error.message());
  std::sort(folders.begin(), folders.end(), [](const auto& a, const auto& b) { return a.object < b.object; });
  if (folders.empty())
    return fail(path.string() + ": has no folders with JPEG pictures; it takes one for each object, named after it");
  return folders;
}

pictures::Figure draw_regions(const pictures::Image& picture, const SeenPicture& seen, const std::string& title) {
  static constexpr pictures::Color kOutline{220, 0, 90, 255};
  pictures::Figure figure{title};
  add_panel(figure, picture, picture, "the picture");
  const vision::Segmentation found = vision::merge_regions(seen.sites);
  pictures::Axes& regions =
      add_panel(figure, image_of(found), picture, std::to_string(found.regions.size()) + " regions");
  const double scale = regions.width() / seen.sites.columns;
  regions.add([lines = outline_of(seen), scale](pictures::Canvas& canvas) {
    for (const auto& [from, to] : lines) canvas.draw_line(scale * from, scale * to, 1.0, kOutline);
  });
  figure.add_legend(pictures::legend_line("outline of what stands out from the ground", 1.0, kOutline));
  return figure;
}

}  // namespace docent::apps::objects_command
