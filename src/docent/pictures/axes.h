#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/grid/occupancy_grid.h"
#include "docent/pictures/canvas.h"
#include "docent/pictures/ticks.h"

namespace docent::pictures {

/// What the colours of a layer mean, from `low` to `high`.
struct ColorBar {
  std::string label;                   ///< of the quantity, with its unit: "time [s]"
  std::function<Color(double)> color;  ///< of a value; where it is transparent, the floor of a map shines through
  double low = 0.0;
  double high = 1.0;  ///< > low
  bool logarithmic = false;
};

/// A rectangle of a figure in which places of data are drawn: layers, a frame with ticks and units, a colour bar.
class Axes {
 public:
  /// Shows low..high on `width` x `height` points. @pre high > low, in both
  Axes(Point2 low, Point2 high, double width, double height, std::string x_label, std::string y_label);
  /// Metres, as long to the right as up; the longer side takes `longest_side` points.
  [[nodiscard]] static Axes metres(Point2 low, Point2 high, double longest_side = 480.0);
  [[nodiscard]] static Axes metres(const GridFrame& frame, double longest_side = 480.0);

  [[nodiscard]] Point2 low() const { return low_; }
  [[nodiscard]] Point2 high() const { return high_; }
  [[nodiscard]] double width() const { return width_; }                       ///< [points]
  [[nodiscard]] double height() const { return height_; }                     ///< [points]
  [[nodiscard]] double scale() const { return width_ / (high_.x - low_.x); }  ///< [points a unit of x]
  /// Where a place of the data lies on the page, from the top left corner of the frame.
  [[nodiscard]] Point2 page(Point2 data) const {
    return {width_ * (data.x - low_.x) / (high_.x - low_.x), height_ * (high_.y - data.y) / (high_.y - low_.y)};
  }
  [[nodiscard]] std::vector<Point2> page(std::span<const Point2> data) const;

  void set_title(std::string title) { title_ = std::move(title); }
  void set_x_ticks(std::vector<Tick> ticks) { x_ticks_ = std::move(ticks); }
  void set_y_ticks(std::vector<Tick> ticks) { y_ticks_ = std::move(ticks); }
  void set_color_bar(ColorBar bar) { color_bar_ = std::move(bar); }
  /// Draws over what was added before, cut at the frame; the origin is the frame's top left corner.
  void add(std::function<void(Canvas&)> layer) { layers_.push_back(std::move(layer)); }

  /// Room [points] that title, ticks, labels and colour bar take around the frame.
  struct Margins {
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  };
  [[nodiscard]] Margins margins() const;
  /// The frame's top left corner at the origin.
  void draw(Canvas& canvas) const;
  /// What lies inside the frame.
  void draw_layers(Canvas& canvas) const;
  /// Labels, units and title, for readers who cannot see them.
  [[nodiscard]] std::string description() const;

 private:
  void draw_ticks(Canvas& canvas) const;
  void draw_color_bar(Canvas& canvas, const ColorBar& bar) const;

  Point2 low_;
  Point2 high_;
  double width_;
  double height_;
  std::string x_label_;
  std::string y_label_;
  std::string title_;
  std::vector<Tick> x_ticks_;
  std::vector<Tick> y_ticks_;
  std::optional<ColorBar> color_bar_;
  std::vector<std::function<void(Canvas&)>> layers_;
};

}  // namespace docent::pictures
