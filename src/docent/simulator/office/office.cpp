#include "docent/simulator/office/office.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::simulator {
namespace {

constexpr double kPassage = 1.3;    // [m] that furniture leaves free in a corridor
constexpr double kTopOfDoor = 2.0;  // [m]

/// Axis-parallel, in the building's own frame [m].
struct Rect {
  double x0, y0, x1, y1;
  [[nodiscard]] double width() const { return x1 - x0; }
  [[nodiscard]] double depth() const { return y1 - y0; }
  [[nodiscard]] bool overlaps(const Rect& other, double gap) const {
    return x0 < other.x1 + gap && other.x0 < x1 + gap && y0 < other.y1 + gap && other.y0 < y1 + gap;
  }
};

/// A row of rooms between two corridors or between a corridor and the facade.
struct Row {
  double low, high;          // [m] y
  bool door_low, door_high;  // which of its long walls lie along a corridor
};

enum class Door { open, shut, doorway, glass_front };

class Architect {
 public:
  explicit Architect(const Rng& rng)
      : rng_{rng.stream("building")}, furniture_{rng.stream("furniture")}, doors_{rng.stream("doors")} {}

  Office draw() {
    length_ = rng_.uniform(24.0, 40.0);
    wall_ = rng_.uniform(0.10, 0.18);
    corridor_ = rng_.uniform(1.8, 2.6);
    const bool ring = rng_.chance(0.5);
    // Some architects align buildings with the street, some maps with the building.
    const double turn = rng_.chance(0.3) ? 0.0 : rng_.uniform(-45.0, 45.0);
    world_from_building_ = {rng_.uniform(-5.0, 5.0), rng_.uniform(-5.0, 5.0), Angle::degrees(turn)};

    double y = 0.0;
    std::vector<Row> rows;
    const auto add_row = [&](bool door_low, bool door_high) {
      rows.push_back({y, y + rng_.uniform(3.8, 6.0), door_low, door_high});
      y = rows.back().high;
    };
    const auto add_corridor = [&] {
      corridors_.push_back({0.0, y, length_, y + corridor_});
      y += corridor_;
    };
    add_row(false, true);
    add_corridor();
    add_row(true, ring);
    if (ring) {
      add_corridor();
      add_row(true, false);
    }
    height_ = y;
    for (std::size_t i = 0; i < rows.size(); ++i) build_row(rows[i], i == 1);
    build_shell();
    furnish_corridors();
    finish();
    return std::move(office_);
  }

 private:
  // ---- walls ----

  void add(const std::string& name, SolidKind kind, const Polygon& in_building, double bottom, double top,
           bool movable) {
    Polygon polygon;
    for (const Point2 corner : in_building) {
      const Point2 p = world_from_building_ * corner;
      polygon.push_back({std::round(p.x * 1000.0) / 1000.0, std::round(p.y * 1000.0) / 1000.0});
    }
    office_.world.solids.push_back(
        {name + "-" + std::to_string(++count_), kind, std::move(polygon), bottom, top, movable});
  }
  void add(const std::string& name, SolidKind kind, const Rect& r, double top, bool movable) {
    add(name, kind, {{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}, 0.0, top, movable);
    taken_.push_back(r);
  }
  void wall(const Rect& rect) {
    if (rect.width() > 0.02 && rect.depth() > 0.02) add("wall", SolidKind::wall, rect, 3.0, false);
  }

  void build_shell() {
    constexpr double kFacade = 0.3;
    wall({-kFacade, -kFacade, length_ + kFacade, 0.0});
    wall({-kFacade, height_, length_ + kFacade, height_ + kFacade});
    wall({-kFacade, 0.0, 0.0, height_});
    wall({length_, 0.0, length_ + kFacade, height_});
  }

  /// Rooms of one row, from the left to the right; a middle row is crossed by corridors.
  void build_row(const Row& row, bool is_middle) {
    const bool ring = row.door_low && row.door_high;
    std::vector<Rect> gaps;  // crossing corridors
    if (is_middle) {
      const double left = ring && rng_.chance(0.6) ? 0.0 : rng_.uniform(3.0, 8.0);
      gaps.push_back({left, row.low, left + corridor_, row.high});
      if (ring) {
        const double right = rng_.chance(0.5) ? length_ - corridor_ : length_ - corridor_ - rng_.uniform(3.0, 8.0);
        gaps.push_back({right, row.low, right + corridor_, row.high});
      }
    }
    double x = 0.0;
    for (const Rect& gap : gaps) {
      build_rooms(row, x, gap.x0);
      corridors_.push_back(gap);
      x = gap.x1;
    }
    build_rooms(row, x, length_);
  }

  void build_rooms(const Row& row, double from, double to) {
    if (to - from < 0.3) {
      if (to > from) wall({from, row.low, to, row.high});
      return;
    }
    if (from > 0.0) wall({from, row.low, from + wall_, row.high});
    if (to < length_) wall({to - wall_, row.low, to, row.high});
    double x = from;
    while (x < to) {
      double end = x + rng_.uniform(2.8, 6.5);
      if (to - end < 2.8) end = to;
      build_room({x, row.low, end, row.high}, row);
      if (end < to) wall({end - 0.5 * wall_, row.low, end + 0.5 * wall_, row.high});
      x = end;
    }
  }

  void build_room(const Rect& room, const Row& row) {
    const bool low = row.door_low && (!row.door_high || rng_.chance(0.5));
    if (row.door_low && !low) wall({room.x0, room.y0, room.x1, room.y0 + wall_});
    if (row.door_high && low) wall({room.x0, room.y1 - wall_, room.x1, room.y1});
    const double face = low ? room.y0 : room.y1 - wall_;  // of the wall with the door
    const double width = rng_.uniform(1.0, 1.15);
    const double free = room.width() - width - 2.0 * wall_ - 0.3;
    if (free < 0.2) {
      wall({room.x0, face, room.x1, face + wall_});
      return;
    }
    const double at = room.x0 + wall_ + 0.15 + rng_.uniform(0.0, free);
    const Rect gap{at, face, at + width, face + wall_};
    const double dice = doors_.uniform();
    const Door door = dice < 0.5    ? Door::open
                      : dice < 0.75 ? Door::shut
                      : dice < 0.93 ? Door::doorway
                                    : Door::glass_front;
    if (door == Door::glass_front) {
      add("pane", SolidKind::glass,
          {{room.x0, face + 0.04}, {gap.x0, face + 0.04}, {gap.x0, face + 0.06}, {room.x0, face + 0.06}}, 0.0, 2.4,
          false);
      taken_.push_back({room.x0, face, gap.x0, face + wall_});
    } else {
      wall({room.x0, face, gap.x0, face + wall_});
    }
    wall({gap.x1, face, room.x1, face + wall_});
    hang_door(gap, door, low);
    const Rect way{gap.x0 - 0.3, low ? face : face - 1.3, gap.x1 + 0.3, low ? face + wall_ + 1.3 : face + wall_};
    kept_free_.push_back({gap.x0 - 0.2, low ? gap.y0 - 1.2 : gap.y0, gap.x1 + 0.2, low ? gap.y1 : gap.y1 + 1.2});
    kept_free_.push_back(way);
    furnish_room({room.x0 + wall_, room.y0 + wall_, room.x1 - wall_, room.y1 - wall_}, low);
  }

  void hang_door(const Rect& gap, Door door, bool room_is_above) {
    constexpr double kLeaf = 0.04;
    if (door == Door::shut) {
      // The leaf sits somewhere in the depth of the wall: a niche that sonars can tell.
      const double depth = gap.y0 + doors_.uniform(0.0, wall_ - kLeaf);
      add("door", SolidKind::furniture, {gap.x0, depth, gap.x1, depth + kLeaf}, kTopOfDoor, true);
    }
    if (door != Door::open) return;
    const bool left = doors_.chance(0.5);
    const Point2 hinge{left ? gap.x0 - kLeaf : gap.x1 + kLeaf, room_is_above ? gap.y1 : gap.y0};
    const double upwards = room_is_above ? 90.0 : -90.0;
    const double more = doors_.uniform(0.0, 60.0) * (left == room_is_above ? 1.0 : -1.0);
    const Pose2 building_from_leaf{hinge.x, hinge.y, Angle::degrees(upwards + more)};
    const double length = gap.width();
    Polygon leaf;
    for (const Point2 corner :
         {Point2{0.0, -kLeaf / 2}, Point2{length, -kLeaf / 2}, Point2{length, kLeaf / 2}, Point2{0.0, kLeaf / 2}}) {
      leaf.push_back(building_from_leaf * corner);
    }
    add("door", SolidKind::furniture, leaf, 0.0, kTopOfDoor, true);
    Rect box{leaf[0].x, leaf[0].y, leaf[0].x, leaf[0].y};
    for (const Point2 p : leaf) {
      box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x), std::max(box.y1, p.y)};
    }
    taken_.push_back(box);
  }

  // ---- furniture ----

  [[nodiscard]] bool is_free(const Rect& rect, double gap) const {
    const auto blocks = [&](const Rect& other) { return rect.overlaps(other, 0.0); };
    return std::none_of(kept_free_.begin(), kept_free_.end(), blocks) &&
           std::none_of(taken_.begin(), taken_.end(), [&](const Rect& other) { return rect.overlaps(other, gap); });
  }

  /// Tries to put a piece with its back to a wall of `room`: `side` 0 low, 1 high, 2 left, 3 right.
  void put_against(const Rect& room, int side, const std::string& name, double length, double depth, double top,
                   bool movable) {
    const bool along_x = side < 2;
    const double free = (along_x ? room.width() : room.depth()) - length;
    if (free < 0.05) return;
    const double at = furniture_.uniform(0.02, free);
    const double back = furniture_.uniform(0.005, 0.03);
    Rect r{};
    if (side == 0) r = {room.x0 + at, room.y0 + back, room.x0 + at + length, room.y0 + back + depth};
    if (side == 1) r = {room.x0 + at, room.y1 - back - depth, room.x0 + at + length, room.y1 - back};
    if (side == 2) r = {room.x0 + back, room.y0 + at, room.x0 + back + depth, room.y0 + at + length};
    if (side == 3) r = {room.x1 - back - depth, room.y0 + at, room.x1 - back, room.y0 + at + length};
    if (is_free(r, 0.0)) add(name, SolidKind::furniture, r, top, movable);
  }

  void furnish_room(const Rect& room, bool door_is_low) {
    const int far = door_is_low ? 1 : 0;
    put_against(room, far, "desk", furniture_.uniform(1.4, 1.8), furniture_.uniform(0.7, 0.85), 0.74, false);
    put_against(room, 2, "shelf", furniture_.uniform(0.8, 2.4), furniture_.uniform(0.3, 0.45), 1.9, false);
    put_against(room, 3, "cabinet", furniture_.uniform(0.8, 1.6), furniture_.uniform(0.4, 0.6), 1.4, false);
    const auto more = furniture_.integer(0, 3);
    for (std::int64_t i = 0; i < more; ++i) {
      put_against(room, static_cast<int>(furniture_.integer(0, 3)), "box", furniture_.uniform(0.3, 0.6),
                  furniture_.uniform(0.3, 0.5), 0.6, true);
    }
    if (room.width() > 4.4 && room.depth() > 4.4 && furniture_.chance(0.6)) {
      const double x = 0.5 * (room.x0 + room.x1) + furniture_.uniform(-0.2, 0.2);
      const double y = 0.5 * (room.y0 + room.y1) + furniture_.uniform(-0.2, 0.2);
      const Rect table{x - 0.8, y - 0.4, x + 0.8, y + 0.4};
      if (is_free(table, 0.9)) add("table", SolidKind::furniture, table, 0.74, true);
    }
  }

  void furnish_corridors() {
    keep_crossings_free();
    for (const Rect& corridor : corridors_) {
      const bool along_x = corridor.width() > corridor.depth();
      const double length = along_x ? corridor.width() : corridor.depth();
      const double spare = corridor_ - kPassage - 0.05;
      const auto tries = static_cast<int>(length / 4.0);
      for (int i = 0; i < tries; ++i) {
        const int side = static_cast<int>(furniture_.integer(0, 1)) + (along_x ? 0 : 2);
        const double dice = furniture_.uniform();
        if (dice < 0.35) {
          put_against(corridor, side, "cabinet", furniture_.uniform(0.8, 1.6), std::min(spare, 0.45), 1.9, false);
        } else if (dice < 0.55) {
          put_against(corridor, side, "copier", furniture_.uniform(0.6, 1.0), std::min(spare, 0.6), 1.1, true);
        } else if (dice < 0.75) {
          put_against(corridor, side, "plant", 0.4, std::min(spare, 0.4), 1.3, true);
        } else {
          put_against(corridor, side, "pillar", furniture_.uniform(0.3, 0.5), std::min(spare, 0.2), 3.0, false);
        }
        keep_opposite_free(corridor, along_x);
      }
    }
  }

  /// Where corridors meet nothing stands.
  void keep_crossings_free() {
    constexpr double kReach = 0.8;
    for (const Rect& r : corridors_) {
      if (r.width() > r.depth()) continue;
      kept_free_.push_back({r.x0 - kReach, r.y0 - corridor_, r.x1 + kReach, r.y0});
      kept_free_.push_back({r.x0 - kReach, r.y1, r.x1 + kReach, r.y1 + corridor_});
    }
  }

  /// What stood opposite of something else would close the corridor: a piece has 1.2 m of it for itself.
  void keep_opposite_free(const Rect& corridor, bool along_x) {
    for (; kept_until_ < taken_.size(); ++kept_until_) {
      const Rect& r = taken_[kept_until_];
      if (!r.overlaps(corridor, -0.1)) continue;
      if (along_x) kept_free_.push_back({r.x0 - 1.2, corridor.y0, r.x1 + 1.2, corridor.y1});
      if (!along_x) kept_free_.push_back({corridor.x0, r.y0 - 1.2, corridor.x1, r.y1 + 1.2});
    }
  }

  // ---- what else a world has ----

  [[nodiscard]] Polygon outline(double inset) const {
    Polygon result;
    for (const Point2 p : {Point2{inset, inset}, Point2{length_ - inset, inset},
                           Point2{length_ - inset, height_ - inset}, Point2{inset, height_ - inset}}) {
      result.push_back(world_from_building_ * p);
    }
    return result;
  }

  /// The middle of a free cross-section of a corridor, nearest to a share of its length.
  [[nodiscard]] Point2 place_in(const Rect& corridor, double share) const {
    const double y = 0.5 * (corridor.y0 + corridor.y1);
    const double wanted = corridor.x0 + share * corridor.width();
    for (int i = 0; i < 200; ++i) {
      const double x = wanted + (i % 2 == 0 ? 1.0 : -1.0) * 0.1 * (i / 2);
      const Rect spot{x - 0.7, corridor.y0, x + 0.7, corridor.y1};
      if (spot.x0 < 0.3 || spot.x1 > length_ - 0.3) continue;
      const auto stands_in = [&](const Rect& r) { return r.overlaps(spot, -0.05); };
      if (std::none_of(taken_.begin(), taken_.end(), stands_in)) return {x, y};
    }
    return {wanted, y};
  }

  void finish() {
    World& world = office_.world;
    world.floor = outline(0.0);
    world.operating_area = outline(0.3);
    world.visitors_per_hour = 6.0;
    world.tours = {"round"};
    const auto add_stop = [&](const Rect& corridor, double share) {
      const Point2 at = place_in(corridor, share);
      const std::string id = "stop-" + std::to_string(office_.stops.size() + 1);
      const Pose2 pose = world_from_building_ * Pose2{at.x, at.y, Angle::degrees(90.0)};
      const Point2 look_at = world_from_building_ * Point2{at.x, corridor.y1};
      office_.stops.push_back({id, pose, look_at, {}, {}});
      world.exhibits.push_back(id);
      world.attractions.push_back({id, look_at, 1.0, 1.0});
    };
    for (const Rect& corridor : corridors_) {
      if (corridor.width() < corridor.depth()) continue;
      for (const double share : {0.15, 0.5, 0.85}) add_stop(corridor, share);
    }
    office_.rounds = {{"round", "Round the floor", world.exhibits}};
    const Point2 home = place_in(
        *std::find_if(corridors_.begin(), corridors_.end(), [](const Rect& r) { return r.width() > r.depth(); }), 0.33);
    office_.home = world_from_building_ * Pose2{home.x, home.y, Angle{}};
    world.home = office_.home.position();
    world.entrances = {office_.stops.front().pose.position(), office_.stops.back().pose.position()};
  }

  Rng rng_;
  Rng furniture_;
  Rng doors_;
  Office office_;
  Pose2 world_from_building_;
  double length_ = 0.0;
  double height_ = 0.0;
  double wall_ = 0.1;
  double corridor_ = 2.0;  ///< [m] its width
  std::vector<Rect> corridors_;
  std::vector<Rect> taken_;      ///< by solids
  std::vector<Rect> kept_free_;  ///< ways
  std::size_t kept_until_ = 0;   ///< pieces whose corridor is kept free beside them
  int count_ = 0;
};

}  // namespace

Office draw_office(std::uint64_t seed) {
  Office office = Architect{Rng{seed}}.draw();
  office.title = "Office building " + std::to_string(seed);
  office.made_of = "Drawn and surveyed with seed " + std::to_string(seed);
  office.topic = "offices";
  return office;
}

}  // namespace docent::simulator
