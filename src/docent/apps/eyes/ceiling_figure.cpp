#include "docent/apps/eyes/ceiling_figure.h"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "docent/pictures/map_picture.h"

namespace docent::apps::map_ceiling_command {
namespace {

constexpr double kSide = 480.0;  // [points] of a panel
constexpr double kDot = 2.0;     // [points]
constexpr pictures::Color kUnseen{70, 70, 95, 255};

std::string metres(double height) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m", height);
  return text;
}

pictures::Axes& add_panel(pictures::Figure& figure, const GridFrame& frame, const pictures::Image& image,
                          const std::string& title) {
  pictures::Axes& axes = figure.add(pictures::Axes::metres(frame, kSide));
  axes.set_title(title);
  axes.add([image, &axes](pictures::Canvas& canvas) {
    canvas.draw_image(image, {0.0, 0.0}, {axes.width(), axes.height()});
  });
  return axes;
}

}  // namespace

pictures::Image image_of(const vision::CeilingMosaic& mosaic) {
  pictures::Image image{mosaic.frame.columns, mosaic.frame.rows};
  for (int row = 0; row < mosaic.frame.rows; ++row)
    for (int column = 0; column < mosaic.frame.columns; ++column) {
      const std::size_t cell = mosaic.frame.index({column, row});
      const bool is_known = mosaic.part[cell] != vision::CeilingMosaic::kUnknown;
      const auto shade = static_cast<std::uint8_t>(std::clamp(255.0F * mosaic.brightness[cell], 0.0F, 255.0F));
      image.set(column, mosaic.frame.rows - 1 - row, is_known ? pictures::Color{shade, shade, shade, 255} : kUnseen);
    }
  return image;
}

pictures::Figure draw_stage(const vision::CeilingMosaic& mosaic, const vision::SolvedMosaic& solved,
                            const std::string& title) {
  pictures::Figure figure{title};
  pictures::Axes& axes = add_panel(figure, mosaic.frame, image_of(mosaic), "");
  std::vector<Point2> way;
  for (const auto& placed : solved.pictures) way.push_back(placed.map_from_robot.position());
  pictures::draw_points(axes, way, kDot, pictures::distinct(0));
  figure.add_legend(pictures::legend_disc("robot at a picture", kDot, pictures::distinct(0)));
  figure.add_legend(pictures::legend_area("not seen", kUnseen));
  return figure;
}

pictures::Figure draw_mosaic(const vision::CeilingMosaic& before, const vision::CeilingMosaic& found,
                             const std::string& title) {
  pictures::Figure figure{title};
  add_panel(figure, before.frame, image_of(before), "(a) by the believed poses, one light for all");
  add_panel(figure, found.frame, image_of(found), "(b) poses, heights and light solved");
  pictures::Image parts{found.frame.columns, found.frame.rows};
  for (int row = 0; row < found.frame.rows; ++row)
    for (int column = 0; column < found.frame.columns; ++column) {
      const std::uint8_t part = found.part[found.frame.index({column, row})];
      parts.set(column, found.frame.rows - 1 - row,
                part == vision::CeilingMosaic::kUnknown ? kUnseen : pictures::distinct(part));
    }
  add_panel(figure, found.frame, parts, "(c) parts of their own height");
  for (std::size_t part = 0; part < found.heights.size(); ++part)
    figure.add_legend(pictures::legend_area(metres(found.heights[part]), pictures::distinct(static_cast<int>(part))));
  figure.add_legend(pictures::legend_area("not seen", kUnseen));
  return figure;
}

}  // namespace docent::apps::map_ceiling_command
