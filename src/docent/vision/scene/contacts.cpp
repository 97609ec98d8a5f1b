#include "docent/vision/scene/contacts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::vision {
namespace {

/// The last site of the nearest floor in a column; nullopt: none, or it does not end.
std::optional<int> end_of_floor(const FloorMask& mask, int column, int gap) {
  int row = mask.rows - 1;
  while (row >= 0 && mask.is_floor[mask.index(column, row)] == 0) --row;
  if (row < 0) return std::nullopt;
  int last = row, missing = 0;
  for (--row; row >= 0 && missing < gap; --row) {
    if (mask.is_floor[mask.index(column, row)] != 0) {
      last = row;
      missing = 0;
    } else {
      ++missing;
    }
  }
  return missing >= gap ? std::optional{last} : std::nullopt;
}

/// Above the end of the floor there is something that does not look like it.
bool ends_at_something(const FloorMask& mask, int column, int row, const ContactParams& params) {
  if (mask.odds.empty()) return true;
  for (int above = row - 1; above >= std::max(0, row - params.beyond); --above)
    if (static_cast<double>(mask.odds[mask.index(column, above)]) < params.doubt) return true;
  return false;
}

/// The best line through contacts first..last, between the feet of its ends.
ContactLine fitted(const std::vector<Contact>& contacts, int first, int last) {
  double weights = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0, shared = 0.0;
  for (int i = first; i <= last; ++i) {
    const Contact& contact = contacts[static_cast<std::size_t>(i)];
    const double weight = 1.0 / (contact.distance_sigma * contact.distance_sigma);
    weights += weight;
    x += weight * contact.place.x;
    y += weight * contact.place.y;
    xx += weight * contact.place.x * contact.place.x;
    xy += weight * contact.place.x * contact.place.y;
    yy += weight * contact.place.y * contact.place.y;
    shared += contact.distance_sigma;
  }
  const Point2 middle{x / weights, y / weights};
  xx = xx / weights - middle.x * middle.x;
  xy = xy / weights - middle.x * middle.y;
  yy = yy / weights - middle.y * middle.y;
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const Point2 along{std::cos(angle), std::sin(angle)};
  const auto foot = [&](int i) {
    return middle + dot(contacts[static_cast<std::size_t>(i)].place - middle, along) * along;
  };
  ContactLine line{{foot(first), foot(last)}, 0.0, 0.0, first, last};
  // A tilted camera moves all contacts alike, so their number does not help.
  const double distance_sigma = shared / (last - first + 1);
  const double reach = norm(middle);
  line.across_sigma =
      reach > 0.0 ? std::max(0.01, distance_sigma * std::abs(cross(along, middle)) / reach) : distance_sigma;
  const double length = distance(line.line.a, line.line.b);
  line.angle_sigma = length > 0.0 ? std::atan2(line.across_sigma, 0.5 * length) : std::numbers::pi;
  return line;
}

void cut_contacts(const std::vector<Contact>& contacts, int first, int last, const ContactParams& params,
                  std::vector<ContactLine>& lines) {
  if (last - first + 1 < params.least) return;
  const Segment whole{contacts[static_cast<std::size_t>(first)].place, contacts[static_cast<std::size_t>(last)].place};
  double most = 0.0;
  int bend = first;
  for (int i = first + 1; i < last; ++i) {
    const double off = distance(whole, contacts[static_cast<std::size_t>(i)].place);
    if (off > most) bend = i;
    most = std::max(most, off);
  }
  if (most <= params.bend) {
    lines.push_back(fitted(contacts, first, last));
    return;
  }
  cut_contacts(contacts, first, bend, params, lines);
  cut_contacts(contacts, bend, last, params, lines);
}

}  // namespace

Result<void> ContactParams::validate() const {
  if (!(pixels > 0.0 && tilt >= 0.0)) return fail("contacts: pixels must be > 0 and tilt >= 0");
  if (!(gap >= 1 && beyond >= 1)) return fail("contacts: gap and beyond must be >= 1");
  if (!std::isfinite(doubt)) return fail("contacts: doubt must be finite");
  if (!(apart > 0.0 && bend > 0.0)) return fail("contacts: apart and bend must be > 0");
  if (!(least >= 2)) return fail("contacts: least must be >= 2");
  return {};
}

std::optional<Point2> floor_at(const DepthCamera& camera, double column, double row) {
  const Eigen::Vector3d ray = camera.ray(column, row);
  if (!(ray.z() < 0.0)) return std::nullopt;
  const Eigen::Vector3d at = camera.position() - camera.mount.z / ray.z() * ray;
  return Point2{at.x(), at.y()};
}

std::vector<Contact> contacts_of(const FloorMask& mask, const DepthCamera& camera, double reach,
                                 const ContactParams& params) {
  std::vector<Contact> contacts;
  const double tilt = params.tilt * std::numbers::pi / 180.0, pixel = params.pixels / camera.focal;
  const Eigen::Vector3d axis = camera.base_from_camera().col(2);
  for (int column = 0; column < mask.columns; ++column) {
    const auto row = end_of_floor(mask, column, params.gap);
    if (!row || !ends_at_something(mask, column, *row, params)) continue;
    const double x = (column + 0.5) * mask.block - 0.5, y = *row * mask.block - 0.5;
    const auto place = floor_at(camera, x, y);
    if (!place) continue;
    const Point2 from{camera.mount.x, camera.mount.y};
    const Point2 away = *place - from;
    const double along = axis.dot(Eigen::Vector3d{away.x, away.y, -camera.mount.z});
    constexpr double kWhole = 0.97;  // what ends at the reach has not ended
    if (along > kWhole * reach) continue;
    const double distance = norm(away), height = camera.mount.z;
    const double angle = std::sqrt(tilt * tilt + pixel * pixel);
    contacts.push_back({column, *row, *place, distance, (distance * distance + height * height) / height * angle,
                        std::hypot(distance, height) * angle});
  }
  return contacts;
}

std::vector<ContactLine> lines_through(const std::vector<Contact>& contacts, const ContactParams& params) {
  std::vector<ContactLine> lines;
  const int count = static_cast<int>(contacts.size());
  for (int first = 0; first < count;) {
    int last = first;
    while (last + 1 < count) {
      const Contact& here = contacts[static_cast<std::size_t>(last)];
      const Contact& next = contacts[static_cast<std::size_t>(last + 1)];
      if (next.column != here.column + 1 || distance(here.place, next.place) > params.apart) break;
      ++last;
    }
    cut_contacts(contacts, first, last, params, lines);
    first = last + 1;
  }
  return lines;
}

}  // namespace docent::vision
