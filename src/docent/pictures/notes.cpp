#include "docent/pictures/notes.h"

#include <algorithm>
#include <vector>

namespace docent::pictures {
namespace {

constexpr double kSize = 6.5;     // [points] of the letters
constexpr double kStep = 0.25;    // of a note's height
constexpr int kSteps = 12;        // up or down
constexpr double kNoteGap = 0.5;  // [points] between notes

/// A rectangle of the page [points].
struct Box {
  Point2 low, high;
};

bool overlap(const Box& a, const Box& b) {
  return a.low.x < b.high.x + kNoteGap && b.low.x < a.high.x + kNoteGap && a.low.y < b.high.y + kNoteGap &&
         b.low.y < a.high.y + kNoteGap;
}

/// The least that is inside [0, room], where `length` fits into it.
double pushed_inside(double low, double length, double room) {
  return std::clamp(low, 0.0, std::max(0.0, room - length));
}

}  // namespace

void draw_notes(Axes& axes, std::span<const Note> notes, std::span<const Point2> clear_of, double dot) {
  std::vector<Box> taken;
  for (const Point2 place : axes.page(clear_of))
    taken.push_back({place - Point2{0.5 * dot, 0.5 * dot}, place + Point2{0.5 * dot, 0.5 * dot}});
  for (const Note& note : notes) {
    const TextStyle style{.size = kSize, .anchor = {0.0, 0.0}};
    const Point2 size = text_size(note.text, style);
    const Point2 place = axes.page(note.in_map);
    const auto box_at = [&](double down) -> Box {
      const Point2 low{pushed_inside(place.x - note.anchor.x * size.x, size.x, axes.width()),
                       pushed_inside(place.y - note.anchor.y * size.y + down, size.y, axes.height())};
      return {low, low + size};
    };
    const auto is_free = [&](const Box& box) {
      return std::none_of(taken.begin(), taken.end(), [&](const Box& other) { return overlap(box, other); });
    };
    Box box = box_at(0.0);
    for (int step = 1; step <= kSteps && !is_free(box); ++step) {
      const double away = kStep * step * size.y;
      box = is_free(box_at(-away)) ? box_at(-away) : box_at(away);
    }
    if (!is_free(box)) box = box_at(0.0);
    taken.push_back(box);
    axes.add([=, at = box.low, text = note.text](Canvas& canvas) {
      canvas.draw_label(at, text, style, with_alpha(colors::kWhite, 150));
    });
  }
}

}  // namespace docent::pictures
