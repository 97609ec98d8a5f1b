#include "docent/pictures/figure.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "docent/base/check.h"
#include "docent/base/files.h"

namespace docent::pictures {
namespace {

// All in points.
constexpr double kMargin = 6.0;    // of the page
constexpr double kBetween = 14.0;  // neighbouring axes
constexpr double kSampleWidth = 18.0;
constexpr double kSampleHeight = 9.0;
constexpr double kSampleGap = 5.0;  // between a sample and its text
constexpr double kEntryGap = 16.0;  // between entries of the legend
constexpr double kLegendRow = 14.0;

// Else Cairo writes the time of day, and no two files were the same.
constexpr const char* kNoDate = "1970-01-01T00:00:00Z";

const TextStyle kFigureTitle{.size = 10.5, .anchor = {0.5, 0.0}, .bold = true};
const TextStyle kLegendStyle{.size = 8.5, .anchor = {0.0, 0.5}};

using Surface = std::unique_ptr<cairo_surface_t, CairoDeleter>;
using Context = std::unique_ptr<cairo_t, CairoDeleter>;

cairo_status_t append(void* text, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&' || c == '<' || c == '>') {
      safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : "&gt;";
    } else if (static_cast<unsigned char>(c) >= 0x20) {
      safe += c;
    }
  }
  return safe;
}

/// Letters of an SVG are outlines: what they say stands in its description, for searches and for those who cannot see.
void describe(std::string& svg, const std::string& title, const std::string& description) {
  const std::size_t start = svg.find("<svg");
  const std::size_t inside = start == std::string::npos ? start : svg.find('>', start);
  if (inside == std::string::npos) return;
  const std::string name = title.empty() ? "" : "\n<title>" + escaped(title) + "</title>";
  svg.insert(inside + 1, name + "\n<desc>" + escaped(description) + "</desc>");
}

}  // namespace

Result<FigureFormat> figure_format(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".svg") return FigureFormat::svg;
  if (extension == ".pdf") return FigureFormat::pdf;
  if (extension == ".png") return FigureFormat::png;
  return fail(path.string() + ": the name of a picture must end in .svg, .pdf or .png");
}

LegendEntry legend_line(std::string text, double width, Color color) {
  return {std::move(text), [=](Canvas& canvas) {
            canvas.draw_line({-0.5 * kSampleWidth, 0.0}, {0.5 * kSampleWidth, 0.0}, width, color);
          }};
}

LegendEntry legend_disc(std::string text, double diameter, Color color) {
  return {std::move(text), [=](Canvas& canvas) {
            const Point2 centres[] = {{0.0, 0.0}};
            canvas.fill_discs(centres, diameter, color);
          }};
}

LegendEntry legend_ring(std::string text, double diameter, double width, Color color) {
  return {std::move(text), [=](Canvas& canvas) { canvas.draw_circle({0.0, 0.0}, 0.5 * diameter, width, color); }};
}

LegendEntry legend_area(std::string text, Color color, Color outline) {
  return {std::move(text), [=](Canvas& canvas) {
            const double x = 0.5 * kSampleWidth;
            const double y = 0.5 * kSampleHeight;
            const Point2 corners[] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
            canvas.fill_polygon(corners, color);
            canvas.draw_polygon(corners, 0.8, outline);
          }};
}

Axes& Figure::add(Axes axes, bool in_new_row) {
  if (rows_.empty() || in_new_row) rows_.emplace_back();
  rows_.back().push_back(std::make_unique<Axes>(std::move(axes)));
  return *rows_.back().back();
}

/// Places on the page.
struct Figure::Layout {
  std::vector<std::vector<Point2>> corners;  ///< of the axes' frames, top left
  std::vector<Point2> entries;               ///< of the legend: middle of the left edge
  double width = 0.0;
  double height = 0.0;
};

Figure::Layout Figure::layout() const {
  Layout layout;
  const Point2 title = text_size(title_, kFigureTitle);
  double top = kMargin + (title_.empty() ? 0.0 : title.y + 4.0);
  double widest = title.x;
  // Frames lie on lines: those at the left of all rows, and columns of rows with as many axes. Corners are whole
  // points, so that those of a bitmap fall on whole pixels.
  struct Column {
    double margin = 0.0;  ///< left of the frame
    double width = 0.0;   ///< of frame and margin at its right
  };
  std::map<std::size_t, std::vector<Column>> columns;  // by the number of axes in a row
  double left_margin = 0.0;
  for (const Row& row : rows_) {
    std::vector<Column>& mine = columns[row.size()];
    mine.resize(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
      const Axes::Margins margins = row[i]->margins();
      mine[i].margin = std::max(mine[i].margin, std::ceil(margins.left));
      mine[i].width = std::max(mine[i].width, std::ceil(row[i]->width() + margins.right));
    }
    left_margin = std::max(left_margin, mine.front().margin);
  }
  for (const Row& row : rows_) {
    double above = 0.0;
    double beneath = 0.0;
    for (const auto& axes : row) {
      above = std::max(above, axes->margins().top);
      beneath = std::max(beneath, axes->height() + axes->margins().bottom);
    }
    top = std::ceil(top + above);
    double left = kMargin;
    layout.corners.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) {
      const Column& column = columns[row.size()][i];
      left += i == 0 ? left_margin : column.margin;
      layout.corners.back().push_back({left, top});
      left += column.width + kBetween;
    }
    widest = std::max(widest, left - kBetween - kMargin);
    top += beneath + kBetween;
  }
  for (const LegendEntry& entry : legend_)
    widest = std::max(widest, kSampleWidth + kSampleGap + text_size(entry.text, kLegendStyle).x);
  layout.width = std::ceil(widest + 2.0 * kMargin);
  double left = kMargin;
  top += 0.5 * kLegendRow - (rows_.empty() ? 0.0 : 0.5 * kBetween);
  for (const LegendEntry& entry : legend_) {
    const double width = kSampleWidth + kSampleGap + text_size(entry.text, kLegendStyle).x;
    if (left > kMargin && left + width > layout.width - kMargin) {
      left = kMargin;
      top += kLegendRow;
    }
    layout.entries.push_back({left, top});
    left += width + kEntryGap;
  }
  layout.height = std::ceil(top + (legend_.empty() ? 0.0 : 0.5 * kLegendRow) + kMargin);
  return layout;
}

Point2 Figure::size() const {
  const Layout page = layout();
  return {page.width, page.height};
}

void Figure::draw(cairo_t* context) const {
  const Layout page = layout();
  Canvas canvas{context};
  canvas.fill_rectangle({0.0, 0.0}, {page.width, page.height}, colors::kWhite);
  canvas.draw_text({0.5 * page.width, kMargin}, title_, kFigureTitle);
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (std::size_t i = 0; i < rows_[row].size(); ++i)
      canvas.at(page.corners[row][i], [&](Canvas& at) { rows_[row][i]->draw(at); });
  for (std::size_t i = 0; i < legend_.size(); ++i) {
    canvas.at(page.entries[i] + Point2{0.5 * kSampleWidth, 0.0}, legend_[i].sample);
    canvas.draw_text(page.entries[i] + Point2{kSampleWidth + kSampleGap, 0.0}, legend_[i].text, kLegendStyle);
  }
}

std::string Figure::description() const {
  std::string text;
  for (const Row& row : rows_)
    for (const auto& axes : row) text += axes->description() + ". ";
  for (std::size_t i = 0; i < legend_.size(); ++i) text += (i == 0 ? "Legend: " : ", ") + legend_[i].text;
  return text;
}

namespace {

Surface pixels(Point2 size) {
  const auto whole = [](double points) { return static_cast<int>(std::lround(points * kPixelsPerPoint)); };
  return Surface{cairo_image_surface_create(CAIRO_FORMAT_RGB24, whole(size.x), whole(size.y))};
}

template <class Draw>
Image rasterized(Point2 size, const Draw& draw) {
  const Surface surface = pixels(size);
  {
    const Context context{cairo_create(surface.get())};
    cairo_scale(context.get(), kPixelsPerPoint, kPixelsPerPoint);
    draw(context.get());
    DOCENT_CHECK(cairo_status(context.get()) == CAIRO_STATUS_SUCCESS);
  }
  cairo_surface_flush(surface.get());
  Image image{cairo_image_surface_get_width(surface.get()), cairo_image_surface_get_height(surface.get())};
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, pixel_of(surface.get(), x, y), sizeof pixel);
      const auto channel = [pixel](unsigned shift) { return static_cast<std::uint8_t>(pixel >> shift & 0xFFU); };
      image.set(x, y, {channel(16), channel(8), channel(0)});
    }
  }
  return image;
}

}  // namespace

Result<void> Figure::save(const std::filesystem::path& path) const {
  const auto format = figure_format(path);
  if (!format) return tl::unexpected<Error>(format.error());
  std::string bytes;
  const Point2 page = size();
  const Surface surface{
      *format == FigureFormat::svg   ? cairo_svg_surface_create_for_stream(append, &bytes, page.x, page.y)
      : *format == FigureFormat::pdf ? cairo_pdf_surface_create_for_stream(append, &bytes, page.x, page.y)
                                     : pixels(page).release()};
  cairo_status_t status = CAIRO_STATUS_SUCCESS;
  {
    const Context context{cairo_create(surface.get())};
    if (*format == FigureFormat::png) cairo_scale(context.get(), kPixelsPerPoint, kPixelsPerPoint);
    if (*format == FigureFormat::pdf) {
      cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, title_.c_str());
      cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, kNoDate);
    }
    draw(context.get());
    status = cairo_status(context.get());
  }
  if (status == CAIRO_STATUS_SUCCESS && *format == FigureFormat::png)
    status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
  cairo_surface_finish(surface.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS)
    return fail(path.string() + ": cannot be drawn: " + cairo_status_to_string(status));
  if (*format == FigureFormat::svg) describe(bytes, title_, description());
  return write_file_atomically(path, bytes);
}

Image Figure::raster() const {
  return rasterized(size(), [this](cairo_t* context) { draw(context); });
}

Image raster_inside(const Axes& axes) {
  return rasterized({axes.width(), axes.height()}, [&axes](cairo_t* context) {
    Canvas canvas{context};
    canvas.fill_rectangle({0.0, 0.0}, {axes.width(), axes.height()}, colors::kWhite);
    axes.draw_layers(canvas);
  });
}

}  // namespace docent::pictures
