#include "docent/pictures/axes.h"

#include <algorithm>
#include <cmath>

#include "docent/base/check.h"

namespace docent::pictures {
namespace {

// All in points.
constexpr double kTick = 3.5;  // length of a tick
constexpr double kGap = 3.0;   // between ticks and their labels, and on to the next thing
constexpr double kXTickEvery = 52.0;
constexpr double kYTickEvery = 34.0;
constexpr double kLine = 0.8;  // width of frame and ticks
constexpr double kBarGap = 10.0;
constexpr double kBarWidth = 11.0;
// Frames of a film have the same size, so what the bar's labels say must not change it.
constexpr double kLeastBarLabel = 24.0;

const TextStyle kTickStyle{.size = 8.0};
const TextStyle kLabelStyle{.size = 9.0};
const TextStyle kTitleStyle{.size = 9.5};

TextStyle anchored(TextStyle style, Point2 anchor, bool upwards = false) {
  style.anchor = anchor;
  style.upwards = upwards;
  return style;
}

int most_ticks(double length, double every) { return std::max(2, static_cast<int>(length / every)); }

double widest(const std::vector<Tick>& ticks) {
  double width = 0.0;
  for (const Tick& tick : ticks) width = std::max(width, text_size(tick.label, kTickStyle).x);
  return width;
}

double text_height(const TextStyle& style) { return text_size("", style).y; }

std::vector<Tick> ticks_of(const ColorBar& bar, double length) {
  return bar.logarithmic ? power_ticks(bar.low, bar.high)
                         : round_ticks(bar.low, bar.high, most_ticks(length, kYTickEvery));
}

}  // namespace

Axes::Axes(Point2 low, Point2 high, double width, double height, std::string x_label, std::string y_label)
    : low_{low},
      high_{high},
      width_{width},
      height_{height},
      x_label_{std::move(x_label)},
      y_label_{std::move(y_label)} {
  DOCENT_CHECK(high.x > low.x && high.y > low.y && width > 0.0 && height > 0.0);
  x_ticks_ = round_ticks(low.x, high.x, most_ticks(width, kXTickEvery));
  y_ticks_ = round_ticks(low.y, high.y, most_ticks(height, kYTickEvery));
}

Axes Axes::metres(Point2 low, Point2 high, double longest_side) {
  DOCENT_CHECK(high.x > low.x && high.y > low.y);
  const double scale = longest_side / std::max(high.x - low.x, high.y - low.y);
  return {low, high, scale * (high.x - low.x), scale * (high.y - low.y), "x [m]", "y [m]"};
}

Axes Axes::metres(const GridFrame& frame, double longest_side) {
  const Point2 size{frame.columns * frame.resolution, frame.rows * frame.resolution};
  return metres(frame.origin, frame.origin + size, longest_side);
}

std::vector<Point2> Axes::page(std::span<const Point2> data) const {
  std::vector<Point2> places;
  places.reserve(data.size());
  for (const Point2& point : data) places.push_back(page(point));
  return places;
}

Axes::Margins Axes::margins() const {
  const double half_a_label = 0.5 * text_height(kTickStyle);  // of the ticks at the corners
  Margins margins;
  margins.left = kTick + kGap + widest(y_ticks_) + kGap + text_height(kLabelStyle);
  margins.bottom = kTick + text_height(kTickStyle) + kGap + text_height(kLabelStyle);
  margins.top = std::max(half_a_label, title_.empty() ? 0.0 : text_height(kTitleStyle) + kGap);
  margins.right = x_ticks_.empty() ? 0.0 : 0.5 * text_size(x_ticks_.back().label, kTickStyle).x;
  if (color_bar_) {
    const double labels = std::max(kLeastBarLabel, widest(ticks_of(*color_bar_, height_)));
    margins.right =
        std::max(margins.right, kBarGap + kBarWidth + kTick + kGap + labels + kGap + text_height(kLabelStyle));
  }
  return margins;
}

void Axes::draw_layers(Canvas& canvas) const {
  canvas.within({0.0, 0.0}, {width_, height_}, [&](Canvas& inside) {
    for (const auto& layer : layers_) layer(inside);
  });
}

void Axes::draw(Canvas& canvas) const {
  draw_layers(canvas);
  const Point2 corners[] = {{0.0, 0.0}, {width_, 0.0}, {width_, height_}, {0.0, height_}};
  canvas.draw_polygon(corners, kLine, colors::kInk);
  draw_ticks(canvas);
  if (!title_.empty()) canvas.draw_text({0.5 * width_, -kGap}, title_, anchored(kTitleStyle, {0.5, 1.0}));
  if (color_bar_) draw_color_bar(canvas, *color_bar_);
}

void Axes::draw_ticks(Canvas& canvas) const {
  for (const Tick& tick : x_ticks_) {
    const double x = page({tick.at, low_.y}).x;
    canvas.draw_line({x, height_}, {x, height_ + kTick}, kLine, colors::kInk);
    canvas.draw_text({x, height_ + kTick}, tick.label, anchored(kTickStyle, {0.5, 0.0}));
  }
  for (const Tick& tick : y_ticks_) {
    const double y = page({low_.x, tick.at}).y;
    canvas.draw_line({-kTick, y}, {0.0, y}, kLine, colors::kInk);
    canvas.draw_text({-kTick - kGap, y}, tick.label, anchored(kTickStyle, {1.0, 0.5}));
  }
  canvas.draw_text({0.5 * width_, height_ + kTick + text_height(kTickStyle) + kGap}, x_label_,
                   anchored(kLabelStyle, {0.5, 0.0}));
  canvas.draw_text({-kTick - kGap - widest(y_ticks_) - kGap, 0.5 * height_}, y_label_,
                   anchored(kLabelStyle, {0.5, 1.0}, true));
}

void Axes::draw_color_bar(Canvas& canvas, const ColorBar& bar) const {
  constexpr int kSteps = 256;
  const double left = width_ + kBarGap;
  const double right = left + kBarWidth;
  Image colors{1, kSteps, colors::kFloor};
  for (int i = 0; i < kSteps; ++i) {
    const double share = 1.0 - (i + 0.5) / kSteps;
    const double value =
        bar.logarithmic ? bar.low * std::pow(bar.high / bar.low, share) : bar.low + share * (bar.high - bar.low);
    colors.blend(0, i, bar.color(value));
  }
  canvas.draw_image(colors, {left, 0.0}, {right, height_});
  const Point2 corners[] = {{left, 0.0}, {right, 0.0}, {right, height_}, {left, height_}};
  canvas.draw_polygon(corners, kLine, colors::kInk);
  const std::vector<Tick> ticks = ticks_of(bar, height_);
  for (const Tick& tick : ticks) {
    const double share = bar.logarithmic ? std::log(tick.at / bar.low) / std::log(bar.high / bar.low)
                                         : (tick.at - bar.low) / (bar.high - bar.low);
    const double y = height_ * (1.0 - share);
    canvas.draw_line({right, y}, {right + kTick, y}, kLine, colors::kInk);
    canvas.draw_text({right + kTick + kGap, y}, tick.label, anchored(kTickStyle, {0.0, 0.5}));
  }
  const double labels = std::max(kLeastBarLabel, widest(ticks));
  canvas.draw_text({right + kTick + kGap + labels + kGap, 0.5 * height_}, bar.label,
                   anchored(kLabelStyle, {0.5, 0.0}, true));
}

std::string Axes::description() const {
  std::string text = title_.empty() ? "" : title_ + ": ";
  text += x_label_ + ", " + y_label_;
  if (color_bar_) text += ", " + color_bar_->label;
  return text;
}

}  // namespace docent::pictures
