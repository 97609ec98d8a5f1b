#include "docent/collision_avoidance/virtual_measurements/virtual_measurements.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <numbers>

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

namespace docent::collision_avoidance {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kStep = 2.0 * kPi / VirtualMeasurements::kDirections;

std::uint8_t bin_of(double range) {
  return static_cast<std::uint8_t>(
      std::clamp(static_cast<int>(range / VirtualMeasurements::kBin), 0, VirtualMeasurements::kBins - 1));
}

std::uint64_t key_of(Point2 position, double lattice) {
  const auto column = static_cast<std::uint64_t>(std::llround(position.x / lattice));
  const auto line = static_cast<std::uint64_t>(std::llround(position.y / lattice));
  return (column << 32U) ^ (line & 0xffffffffU);
}

int wrapped(int direction) {
  const int rest = direction % VirtualMeasurements::kDirections;
  return rest < 0 ? rest + VirtualMeasurements::kDirections : rest;
}

}  // namespace

Result<void> VirtualMeasurementParams::validate() const {
  if (!(confidence > 0.5 && confidence < 1.0)) return fail("hazards.confidence must lie between 0.5 and 1");
  if (!(doubt_sigmas >= 0.0)) return fail("hazards.doubt_sigmas must be >= 0");
  if (!(cell_padding >= 0.0 && cell_padding < 0.5)) return fail("hazards.cell_padding must lie between 0 and 0.5 m");
  if (!(max_impossible >= 0.0 && max_impossible < 1.0)) return fail("hazards.max_impossible must lie in [0, 1)");
  return {};
}

VirtualMeasurements::VirtualMeasurements(Polygon area, std::vector<Polygon> hazards, VirtualMeasurementParams params,
                                         Ends ends)
    : area_{std::move(area)},
      hazards_{std::move(hazards)},
      params_{params},
      ends_{ends},
      histogram_(static_cast<std::size_t>(kDirections) * kBins) {
  if (ends_ != Ends::hazards && area_.size() >= 3) borders_ = sides(area_);
  if (ends_ == Ends::border) {
    params_.cell_padding = 0.0;  // of the centre: the margin to the border holds it
    return;
  }
  for (const auto& hazard : hazards_) {
    const auto outline = sides(hazard);
    borders_.insert(borders_.end(), outline.begin(), outline.end());
  }
}

bool VirtualMeasurements::is_in_area(Point2 position) const { return area_.size() < 3 || contains(area_, position); }

bool VirtualMeasurements::is_in_hazard(Point2 position) const {
  return std::any_of(hazards_.begin(), hazards_.end(),
                     [&](const Polygon& hazard) { return contains(hazard, position); });
}

bool VirtualMeasurements::is_possible(Point2 position) const { return is_in_area(position) && !is_in_hazard(position); }

Point2 VirtualMeasurements::led_inside(Point2 position) const {
  constexpr double kOff = 1.01 * kBin;
  if (area_.size() < 3) return position;
  Segment side{area_.back(), area_.front()};
  for (const auto& other : sides(area_)) {
    if (distance(other, position) < distance(side, position)) side = other;
  }
  const Point2 foot = nearest_point(side, position);
  const double away = distance(foot, position);
  const bool is_inside = contains(area_, position);
  if (is_inside && away >= kOff) return position;
  Point2 inwards = (is_inside ? 1.0 : -1.0) * (position - foot);
  if (away < 1e-6) {  // right on it: across the side
    const Point2 along = side.b - side.a;
    inwards = {-along.y, along.x};
    if (!contains(area_, foot + kOff / norm(inwards) * inwards)) inwards = -1.0 * inwards;
  }
  const Point2 led = foot + kOff / norm(inwards) * inwards;
  return contains(area_, led) ? led : position;
}

double VirtualMeasurements::border_distance(Point2 position) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& border : borders_) least = std::min(least, distance(border, position));
  return least;
}

double VirtualMeasurements::nearest(Point2 position) const {
  return is_possible(position) ? border_distance(position) : 0.0;
}

double VirtualMeasurements::square_range(Point2 centre, double half_diagonal) const {
  const double range = border_distance(centre) - half_diagonal;
  return range < 0.0 ? 0.0 : is_possible(centre) ? range : -1.0;
}

const VirtualMeasurements::Surroundings& VirtualMeasurements::surroundings_of(Point2 position) {
  const Point2 index{std::floor(position.x / params_.block), std::floor(position.y / params_.block)};
  const auto [entry, is_new] = surroundings_.try_emplace(key_of(index, 1.0));
  Surroundings& result = entry->second;
  if (!is_new) return result;
  const Point2 middle{(index.x + 0.5) * params_.block, (index.y + 0.5) * params_.block};
  const double reach = 0.5 * std::numbers::sqrt2 * params_.block + 1e-6;
  for (const auto& border : borders_) {
    if (distance(border, middle) - reach < kMaxRange + params_.cell_padding) result.borders.push_back(border);
  }
  const auto parts = [&](const Polygon& polygon) {
    return polygon.size() >= 3 && outline_distance(polygon, middle) <= reach;
  };
  const bool is_parted = parts(area_) || std::any_of(hazards_.begin(), hazards_.end(), parts);
  if (!is_parted) result.possible = is_possible(middle);
  return result;
}

void VirtualMeasurements::fill(Row& row, Point2 position, std::span<const Segment> borders) const {
  const double padding = params_.cell_padding;
  std::array<double, kDirections> ranges;
  ranges.fill(kMaxRange);
  for (const auto& border : borders) {
    const Point2 foot = nearest_point(border, position);
    const double nearest = distance(foot, position);
    if (nearest - padding >= kMaxRange) continue;
    const Point2 a = border.a - position;
    const Point2 b = border.b - position;
    const double first = std::atan2(a.y, a.x);
    const double turn = std::atan2(cross(a, b), dot(a, b));  // from a to b, less than half a turn
    const double low = std::min(first, first + turn);
    const double high = std::max(first, first + turn);
    const double line_distance = std::abs(cross(a, b)) / std::max(1e-9, norm(b - a));
    const Point2 along = (1.0 / std::max(1e-9, norm(b - a))) * (b - a);
    const Point2 to_line = a - dot(a, along) * along;
    const double normal = std::atan2(to_line.y, to_line.x);
    // A ray that starts up to `padding` beside the centre, or anywhere within its 2 degrees, may still hit.
    const double widening = 0.5 * kStep + std::asin(std::min(1.0, padding / std::max(nearest, 1e-9)));
    const int from = static_cast<int>(std::ceil((low - widening) / kStep));
    const int to = static_cast<int>(std::floor((high + widening) / kStep));
    for (int direction = from; direction <= to; ++direction) {
      double range = nearest;
      if (line_distance > 1e-3) {
        const double centre = direction * kStep;
        double start = std::clamp(centre - widening, low, high) - normal;
        double end = std::clamp(centre + widening, low, high) - normal;
        const double whole_turns = 2.0 * kPi * std::round(0.5 * (start + end) / (2.0 * kPi));
        start -= whole_turns;
        end -= whole_turns;
        const double best = start > 0.0 ? start : end < 0.0 ? end : 0.0;  // nearest to the foot of the normal
        const double cosine = std::cos(best);
        range = cosine > 1e-6 ? std::max(nearest, line_distance / cosine) : kMaxRange;
      }
      auto& least = ranges[static_cast<std::size_t>(wrapped(direction))];
      least = std::min(least, std::max(0.0, range - padding));
    }
  }
  for (std::size_t i = 0; i < ranges.size(); ++i) row.bins[i] = bin_of(ranges[i]);
}

std::optional<Point2> VirtualMeasurements::way_out(Point2 position) const {
  for (const Polygon& hazard : hazards_) {
    if (!contains(hazard, position)) continue;
    Point2 nearest = hazard.front();
    for (const Segment& side : sides(hazard))
      if (const Point2 foot = nearest_point(side, position); distance(foot, position) < distance(nearest, position))
        nearest = foot;
    return nearest - position;
  }
  return std::nullopt;
}

void VirtualMeasurements::fill_from_outside(Row& row, Point2 position) const {
  const auto out = way_out(position);
  const auto leads_back = [&](Point2 direction) {
    // Whatever is within reach lets the body go away from it alone: so it may go within 30 degrees of the way out.
    if (out) return dot(direction, *out) >= -0.5 * norm(*out);
    bool returns = false;
    for (double way = kBin; way <= params_.reentry && !returns; way += kBin)
      returns = is_possible(position + way * direction);
    return returns;
  };
  for (int i = 0; i < kDirections; ++i) {
    const bool is_free = leads_back(unit(Angle::radians(i * kStep)));
    row.bins[static_cast<std::size_t>(i)] = is_free ? static_cast<std::uint8_t>(kBins - 1) : std::uint8_t{1};
  }
}

std::uint32_t VirtualMeasurements::row_of(Point2 position) {
  const auto [entry, is_new] =
      index_.try_emplace(key_of(position, params_.lattice), static_cast<std::uint32_t>(rows_.size()));
  if (is_new) {
    const Point2 centre{params_.lattice * std::round(position.x / params_.lattice),
                        params_.lattice * std::round(position.y / params_.lattice)};
    Row& row = rows_.emplace_back();
    const Surroundings& around = surroundings_of(centre);
    row.possible = around.possible ? *around.possible : is_possible(centre);
    const Point2 from = ends_ == Ends::border ? led_inside(centre) : centre;
    const bool can_look = row.possible || (ends_ == Ends::border && is_in_area(from)) ||
                          (ends_ == Ends::hazards && !is_in_hazard(centre));
    can_look ? fill(row, from, around.borders) : fill_from_outside(row, centre);
  }
  return entry->second;
}

void VirtualMeasurements::sight(std::span<const WeightedPose> poses) {
  if (rows_.size() + poses.size() > params_.most_rows) {  // not in the middle of a belief
    rows_.clear();
    index_.clear();
  }
  sightings_.resize(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const WeightedPose& pose = poses[i];
    // Beliefs list the headings of a position one after the other.
    const bool is_same = i > 0 && pose.position == poses[i - 1].position;
    const std::uint32_t row = is_same ? sightings_[i - 1].row : row_of(pose.position);
    sightings_[i] = {row, wrapped(static_cast<int>(std::lround(pose.heading / kStep)) - kDirections / 2), pose.mass};
  }
}

double VirtualMeasurements::count(std::span<const WeightedSquare> rest, bool leave_out) {
  double counted = 0.0;
  rest_bins_.clear();
  std::array<double, kBins> masses{};  // the same in all directions
  squares_.resize(rest.size());
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const WeightedSquare& square = rest[i];
    if (!(square.mass > 0.0)) continue;
    KnownSquare& known = squares_[i];
    if (!(known.centre == square.centre && known.side == square.side)) {
      const double range = square_range(square.centre, 0.5 * std::numbers::sqrt2 * square.side);
      known = {square.centre, square.side, range >= 0.0, bin_of(std::max(0.0, range))};
    }
    if (!known.possible && leave_out) continue;  // the robot can be nowhere in it
    counted += square.mass;
    rest_bins_.push_back({known.bin, square.mass});
    masses[known.bin] += square.mass;
  }
  const std::size_t last = last_limit();
  for (std::size_t bin = 0; bin <= last; ++bin)
    std::fill_n(histogram_.data() + bin * kDirections, kDirections, masses[bin]);
  return counted;
}

void VirtualMeasurements::count_within_limits(const Sighting& sighting) {
  const std::uint8_t* bins = rows_[sighting.row].bins.data();
  const std::uint8_t* limits = limits_.data() + (kDirections - sighting.first);
  // The last bin is never asked for: most of what is seen lies there.
  constexpr std::uint8_t kLastAsked = kBins - 2;
  const auto add = [&](int direction) {
    const int ahead = direction - sighting.first;
    const int robots = ahead < 0 ? ahead + kDirections : ahead;
    histogram_[static_cast<std::size_t>(bins[direction] * kDirections + robots)] += sighting.mass;
  };
#if defined(__x86_64__)
  constexpr int kVector = sizeof(__m128i);
  constexpr int kWord = 64;
  const __m128i last_asked = _mm_set1_epi8(static_cast<char>(kLastAsked));
  for (int first = 0; first < kStride; first += kWord) {
    std::uint64_t matters = 0;
    for (int part = 0; part < kWord; part += kVector) {
      const __m128i seen = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bins + first + part));
      const __m128i limit =
          _mm_min_epu8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(limits + first + part)), last_asked);
      const auto within = static_cast<unsigned>(_mm_movemask_epi8(_mm_cmpeq_epi8(_mm_min_epu8(seen, limit), seen)));
      matters |= std::uint64_t{within} << static_cast<unsigned>(part);
    }
    for (; matters != 0; matters &= matters - 1) add(first + std::countr_zero(matters));
  }
#else
  for (int direction = 0; direction < kDirections; ++direction) {
    if (bins[direction] <= std::min(limits[direction], kLastAsked)) add(direction);
  }
#endif
}

bool VirtualMeasurements::lower_limits(double allowed) {
  // Two directions at a time, over all directions before the next bin: no sum waits for the one before.
  using Masses [[gnu::vector_size(16)]] = double;
  using Counts [[gnu::vector_size(16)]] = std::int64_t;
  constexpr std::size_t kPairs = kDirections / 2;
  std::array<Masses, kPairs> below{};
  std::array<Counts, kPairs> bins{};  // those with less mass up to them than is allowed
  const Masses wanted{allowed, allowed};
  const std::size_t last = last_limit();
  for (std::size_t bin = 0; bin <= last && bin + 1 < kBins; ++bin) {
    const double* masses = histogram_.data() + bin * kDirections;
    for (std::size_t i = 0; i < kPairs; ++i) {
      Masses here;
      std::memcpy(&here, masses + 2 * i, sizeof(here));
      below[i] += here;
      bins[i] -= below[i] < wanted;
    }
  }
  bool all_reached = true;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const auto bin = static_cast<std::uint8_t>(bins[i / 2][i % 2]);
    all_reached = all_reached && bin <= limits_[i];
    limits_[i] = limits_[i + kDirections] = bin;
  }
  return all_reached;
}

std::size_t VirtualMeasurements::last_limit() const {
  return *std::max_element(limits_.begin(), limits_.begin() + kDirections);
}

void VirtualMeasurements::clear_histogram() {
  std::fill_n(histogram_.begin(), static_cast<std::ptrdiff_t>((last_limit() + 1) * kDirections), 0.0);
}

bool VirtualMeasurements::is_overstated(const Sighting& sighting) const {
  const std::uint8_t* bins = rows_[sighting.row].bins.data();
  const std::uint8_t* limits = limits_.data() + (kDirections - sighting.first);
  // No early end, and whole vectors, for what follows the row is far away: compilers compare many at a time.
  std::uint8_t is_nearer = 0;
  for (int direction = 0; direction < kStride; ++direction) is_nearer |= bins[direction] < limits[direction] ? 1 : 0;
  return is_nearer != 0;
}

void VirtualMeasurements::lower_jointly(double allowed) {
  const auto lower = [&](std::size_t direction, std::uint8_t bin) {
    limits_[direction] = limits_[direction + kDirections] = std::min(limits_[direction], bin);
  };
  std::vector<Sighting> overstated;
  std::copy_if(sightings_.begin(), sightings_.end(), std::back_inserter(overstated),
               [&](const Sighting& sighting) { return is_overstated(sighting); });
  const auto is_far = [last = last_limit()](const RestBin& rest) { return rest.bin >= last; };
  std::erase_if(rest_bins_, is_far);
  double left = 0.0;
  for (const Sighting& sighting : overstated) left += sighting.mass;
  for (const RestBin& rest : rest_bins_) left += rest.mass;
  const auto is_likelier = [](const auto& a, const auto& b) { return a.mass > b.mass; };
  std::stable_sort(overstated.begin(), overstated.end(), is_likelier);
  for (const Sighting& sighting : overstated) {
    if (left < allowed) return;
    left -= sighting.mass;
    const auto& bins = rows_[sighting.row].bins;
    for (int direction = 0; direction < kDirections; ++direction)
      lower(static_cast<std::size_t>(wrapped(direction - sighting.first)), bins[static_cast<std::size_t>(direction)]);
  }
  std::stable_sort(rest_bins_.begin(), rest_bins_.end(), is_likelier);
  for (const RestBin& rest : rest_bins_) {
    if (left < allowed) return;
    left -= rest.mass;
    for (std::size_t direction = 0; direction < kDirections; ++direction) lower(direction, rest.bin);
  }
}

void VirtualMeasurements::remember_limits() { std::copy_n(limits_.begin(), kDirections, last_limits_.begin()); }

void VirtualMeasurements::recall_limits() {
  for (int i = 0; i < kDirections; ++i) {
    int farthest = 0;
    for (int near = i - params_.turned; near <= i + params_.turned; ++near)
      farthest = std::max<int>(farthest, last_limits_[static_cast<std::size_t>(wrapped(near))]);
    const auto direction = static_cast<std::size_t>(i);
    limits_[direction] = limits_[direction + kDirections] =
        static_cast<std::uint8_t>(std::min(farthest + params_.driven, kBins - 1));
  }
}

void VirtualMeasurements::sample_limits() {
  limits_.fill(kBins - 1);
  if (sightings_.size() < params_.few_poses) return;
  clear_histogram();
  double total = 0.0;
  const std::size_t step = sightings_.size() / params_.sample;
  for (std::size_t i = step / 2; i < sightings_.size(); i += step) {
    count_within_limits(sightings_[i]);
    total += sightings_[i].mass;
  }
  lower_limits(params_.ample * (1.0 - params_.confidence) * total);
}

VirtualMeasurements::Scan VirtualMeasurements::measure(std::span<const WeightedPose> poses,
                                                       std::span<const WeightedSquare> rest) {
  std::array<WeightedPose, 1> best;
  if (params_.best_pose_only && !poses.empty()) {
    best[0] =
        *std::max_element(poses.begin(), poses.end(), [](const auto& a, const auto& b) { return a.mass < b.mass; });
    poses = best;
    rest = {};
  }
  sight(poses);
  double all = 0.0;
  double possible = 0.0;
  for (const auto& sighting : sightings_) {
    all += sighting.mass;
    if (rows_[sighting.row].possible) possible += sighting.mass;
  }
  double rest_mass = 0.0;
  for (const auto& square : rest) rest_mass += square.mass;
  Scan scan;
  if (!(all + rest_mass > 0.0)) return scan;
  scan.possible_mass = all > 0.0 ? possible / all : 0.0;
  const bool leave_out = possible >= (1.0 - params_.max_impossible) * all;
  if (leave_out) std::erase_if(sightings_, [&](const Sighting& sighting) { return !rows_[sighting.row].possible; });

  double total = 0.0;
  const auto is_reached = [&] {
    total = count(rest, leave_out) + (leave_out ? possible : all);
    for (const auto& sighting : sightings_) count_within_limits(sighting);
    return lower_limits((1.0 - params_.confidence) * total);
  };
  recall_limits();
  if (!is_reached()) {  // a guess was too low somewhere: the next one, and then everything
    sample_limits();
    if (!is_reached()) {
      limits_.fill(kBins - 1);
      is_reached();
    }
  }
  remember_limits();
  if (params_.jointly) lower_jointly((1.0 - params_.confidence) * total);
  for (std::size_t i = 0; i < kDirections; ++i) scan.ranges[i] = kBin * limits_[i];
  return scan;
}

}  // namespace docent::collision_avoidance
