#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/pictures/axes.h"

namespace docent::pictures {

/// Pixels a point of a figure that is written as a raster.
inline constexpr double kPixelsPerPoint = 2.0;

/// By the extension of the path: svg and pdf hold vectors, png pixels.
enum class FigureFormat { svg, pdf, png };
/// Error: another extension.
[[nodiscard]] Result<FigureFormat> figure_format(const std::filesystem::path& path);

/// What a kind of mark stands for. `sample` draws one about the origin, in a space of 18 x 9 points.
struct LegendEntry {
  std::string text;
  std::function<void(Canvas&)> sample;
};
[[nodiscard]] LegendEntry legend_line(std::string text, double width, Color color);
[[nodiscard]] LegendEntry legend_disc(std::string text, double diameter, Color color);
[[nodiscard]] LegendEntry legend_ring(std::string text, double diameter, double width, Color color);
/// A filled shape with an outline; clear: no outline.
[[nodiscard]] LegendEntry legend_area(std::string text, Color color, Color outline = {0, 0, 0, 0});

/// A page with axes in rows, a title above them and a legend beneath: the same as vectors and as pixels, and the same
/// bytes whenever it is written.
class Figure {
 public:
  explicit Figure(std::string title) : title_{std::move(title)} {}
  /// Beside the last ones, or in a new row beneath. The reference lasts as long as the figure.
  Axes& add(Axes axes, bool in_new_row = false);
  void add_legend(LegendEntry entry) { legend_.push_back(std::move(entry)); }

  /// Writes SVG, PDF or PNG, atomically.
  [[nodiscard]] Result<void> save(const std::filesystem::path& path) const;
  /// kPixelsPerPoint pixels a point, on white.
  [[nodiscard]] Image raster() const;
  /// Width and height of the page [points], whole numbers.
  [[nodiscard]] Point2 size() const;

 private:
  using Row = std::vector<std::unique_ptr<Axes>>;
  struct Layout;
  [[nodiscard]] Layout layout() const;
  void draw(cairo_t* context) const;
  [[nodiscard]] std::string description() const;

  std::string title_;
  std::vector<Row> rows_;
  std::vector<LegendEntry> legend_;
};

/// The inside of axes alone, without a frame.
[[nodiscard]] Image raster_inside(const Axes& axes);

}  // namespace docent::pictures
