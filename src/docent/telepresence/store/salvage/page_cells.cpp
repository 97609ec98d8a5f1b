#include "docent/telepresence/store/salvage/page_cells.h"

#include <algorithm>
#include <bit>
#include <set>
#include <string>

#include "docent/telepresence/store/salvage/page_bytes.h"

namespace docent::telepresence {
namespace {

constexpr std::size_t kFileHeader = 100;
constexpr std::size_t kLeafHeader = 8;
constexpr std::size_t kInsideHeader = 12;
constexpr std::uint64_t kLongestRow = 64U << 20U;

/// Bytes of a value of this serial type; nullopt: there is no such type.
std::optional<std::uint64_t> size_of(std::uint64_t type) {
  constexpr std::uint64_t kSizes[] = {0, 1, 2, 3, 4, 6, 8, 8, 0, 0};
  if (type < 10) return kSizes[type];
  if (type < 12) return std::nullopt;
  return (type - 12) / 2;
}

Value value_of(std::uint64_t type, std::string_view bytes) {
  if (type == 0) return std::monostate{};
  if (type >= 12) return std::string{bytes};
  if (type == 8 || type == 9) return static_cast<std::int64_t>(type - 8);
  std::uint64_t bits = (static_cast<unsigned char>(bytes[0]) & 0x80U) != 0 && type != 7 ? ~std::uint64_t{0} : 0;
  for (const char byte : bytes) bits = bits << 8U | static_cast<unsigned char>(byte);
  if (type == 7) return std::bit_cast<double>(bits);
  return static_cast<std::int64_t>(bits);
}

/// A record: the types of its values, then the values. nullopt: it is none.
std::optional<std::vector<Value>> values_of(std::string_view record) {
  std::size_t at = 0;
  std::uint64_t header = 0;
  if (!take_varint(record, at, header) || header > record.size() || header < at) return std::nullopt;
  std::size_t data = header;
  std::vector<Value> values;
  while (at < header) {
    std::uint64_t type = 0;
    if (!take_varint(record.substr(0, header), at, type)) return std::nullopt;
    const auto size = size_of(type);
    if (!size || *size > record.size() - data) return std::nullopt;
    values.push_back(value_of(type, record.substr(data, *size)));
    data += *size;
  }
  if (at != header || data != record.size() || values.empty()) return std::nullopt;
  return values;
}

PageKind kind_of(std::string_view image, std::size_t begin) {
  const auto kind = static_cast<PageKind>(image.size() > begin + kInsideHeader ? big_endian<1>(image, begin) : 0);
  for (const PageKind known :
       {PageKind::index_inside, PageKind::table_inside, PageKind::index_leaf, PageKind::table_leaf})
    if (kind == known) return kind;
  return PageKind::other;
}

/// How much of a row stands in its page; the rest is in others.
std::size_t local_part(std::uint64_t length, std::size_t usable, bool is_table) {
  const std::size_t most = is_table ? usable - 35 : (usable - 12) * 64 / 255 - 23;
  if (length <= most) return length;
  const std::size_t least = (usable - 12) * 32 / 255 - 23;
  const std::size_t part = least + (length - least) % (usable - 4);
  return part <= most ? part : least;
}

/// The rest of a row, from a chain of pages.
bool add_overflow(const PageImages& images, std::uint32_t next, std::uint64_t length, std::string& record) {
  std::set<std::uint32_t> seen;
  while (record.size() < length) {
    const auto page = images.pages.find(next);
    if (page == images.pages.end() || !seen.insert(next).second) return false;
    record += page->second.substr(4, std::min<std::uint64_t>(length - record.size(), images.usable - 4));
    next = big_endian<4>(page->second, 0);
  }
  return true;
}

}  // namespace

TreePage::TreePage(const PageImages& images, std::uint32_t number, std::string_view image)
    : images_{images}, image_{image}, begin_{number == 1 ? kFileHeader : 0}, kind_{kind_of(image, begin_)} {}

/// Where its list says that cells stand.
std::vector<std::size_t> TreePage::listed(std::size_t header) const {
  std::vector<std::size_t> places;
  const std::size_t count = big_endian<2>(image_, begin_ + 3);
  for (std::size_t i = 0; i < count && begin_ + header + 2 * i + 2 <= images_.usable; ++i) {
    const std::size_t place = big_endian<2>(image_, begin_ + header + 2 * i);
    if (place < begin_ + header || place >= images_.usable) continue;
    places.push_back(place);
  }
  return places;
}

bool TreePage::is_empty() const { return big_endian<2>(image_, begin_ + 3) == 0; }

std::vector<std::uint32_t> TreePage::children() const {
  if (kind_ != PageKind::table_inside && kind_ != PageKind::index_inside) return {};
  std::vector<std::uint32_t> pages;
  for (const std::size_t place : listed(kInsideHeader))
    if (place + 4 <= images_.usable) pages.push_back(big_endian<4>(image_, place));
  pages.push_back(big_endian<4>(image_, begin_ + 8));
  return pages;
}

std::optional<Cell> TreePage::cell_at(std::size_t at, bool has_id, std::size_t& end) const {
  const std::string_view page = image_.substr(0, images_.usable);
  Cell cell;
  std::uint64_t length = 0;
  std::uint64_t id = 0;
  if (!take_varint(page, at, length) || length < 2 || length > kLongestRow) return std::nullopt;
  if (has_id && !take_varint(page, at, id)) return std::nullopt;
  cell.id = static_cast<std::int64_t>(id);
  const std::size_t here = local_part(length, images_.usable, has_id);
  if (at + here + (here < length ? 4 : 0) > page.size()) return std::nullopt;
  std::string record{page.substr(at, here)};
  end = at + here;
  if (here < length) {
    if (!add_overflow(images_, big_endian<4>(page, end), length, record)) return std::nullopt;
    end += 4;
  }
  auto values = values_of(record);
  if (!values) return std::nullopt;
  cell.values = std::move(*values);
  return cell;
}

/// Bytes between the cells, as the page's own chain has them; nullopt: it leads nowhere.
std::optional<std::size_t> TreePage::free_bytes() const {
  std::size_t free = big_endian<1>(image_, begin_ + 7);
  std::size_t at = big_endian<2>(image_, begin_ + 1);
  while (at != 0) {
    if (at + 4 > images_.usable) return std::nullopt;
    free += big_endian<2>(image_, at + 2);
    const std::size_t next = big_endian<2>(image_, at);
    if (next != 0 && next <= at) return std::nullopt;
    at = next;
  }
  return free;
}

/// Where cells may begin: as the page says, if that fits its list; before it lie remains of what was moved, or deleted.
std::size_t TreePage::first_cell() const {
  const std::size_t said = big_endian<2>(image_, begin_ + 5);
  const auto places = listed(kLeafHeader);
  const std::size_t count = big_endian<2>(image_, begin_ + 3);
  const bool fits = said >= begin_ + kLeafHeader + 2 * count && said <= images_.usable && places.size() == count &&
                    std::all_of(places.begin(), places.end(), [&](std::size_t place) { return place >= said; });
  return fits ? said : begin_ + kLeafHeader;
}

std::vector<Cell> TreePage::rows(const IsRow& is_row) const {
  std::vector<Cell> rows;
  if (image_.size() < images_.usable || images_.usable < begin_ + kLeafHeader) return rows;
  std::vector<bool> is_taken(images_.usable, false);
  const auto take = [&](std::size_t at) {
    std::size_t end = 0;
    auto cell = cell_at(at, true, end);
    if (!cell || !is_row(cell->values)) return false;
    const auto place = [&](std::size_t of) { return is_taken.begin() + static_cast<std::ptrdiff_t>(of); };
    std::fill(place(at), place(end), true);
    rows.push_back(std::move(*cell));
    return true;
  };
  bool is_whole = kind_ == PageKind::table_leaf;
  if (is_whole)
    for (const std::size_t place : listed(kLeafHeader)) is_whole = !is_taken[place] && take(place) && is_whole;
  const auto taken = static_cast<std::size_t>(std::count(is_taken.begin(), is_taken.end(), true));
  was_whole_ = is_whole && free_bytes() == images_.usable - big_endian<2>(image_, begin_ + 5) - taken;
  if (was_whole_) return rows;
  const std::size_t first = first_cell();
  for (std::size_t at = first; at + 3 < images_.usable; ++at)
    if (!is_taken[at] && image_[at] != 0) take(at);
  const std::size_t sure = rows.size();
  for (std::size_t at = begin_ + kLeafHeader; at < first; ++at)
    if (!is_taken[at] && image_[at] != 0) take(at);
  for (std::size_t i = sure; i < rows.size(); ++i) rows[i].is_remains = true;
  return rows;
}

std::vector<Cell> TreePage::entries() const {
  std::vector<Cell> entries;
  if (kind_ != PageKind::index_leaf && kind_ != PageKind::index_inside) return entries;
  const bool is_inside = kind_ == PageKind::index_inside;
  for (const std::size_t place : listed(is_inside ? kInsideHeader : kLeafHeader)) {
    std::size_t end = 0;
    if (auto cell = cell_at(place + (is_inside ? 4 : 0), false, end)) entries.push_back(std::move(*cell));
  }
  return entries;
}

}  // namespace docent::telepresence
