#include "docent/localization/markov/range_table.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "docent/base/files.h"

namespace docent {

namespace {

struct Header {
  char magic[8];  // "DOCRNG01"
  std::uint64_t key;
  std::uint64_t places;
  std::uint64_t stride;
  std::uint64_t checksum;  ///< of the rows
  std::uint8_t rest[24];   ///< rows begin at a multiple of 64 bytes
};
static_assert(sizeof(Header) == 64);
constexpr char kMagic[9] = "DOCRNG01";

/// Eight bytes at a time: a table has tens of megabytes and is checked at every start. @pre size is a multiple of 8
std::uint64_t checksum_of(const std::uint8_t* data, std::size_t size) {
  std::uint64_t sum = 0x9e3779b97f4a7c15ULL;
  for (std::size_t i = 0; i < size; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, data + i, 8);
    sum = (sum ^ word) * 0xff51afd7ed558ccdULL;
    sum ^= sum >> 29U;
  }
  return sum;
}

std::uint64_t key_number(const std::string& key) {
  std::uint64_t number = 14695981039346656037ULL;
  for (const char c : key) number = (number ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return number;
}

std::size_t stride_of(int headings) {
  return (2 * static_cast<std::size_t>(headings) + RangeTable::kReadAhead + 63) / 64 * 64;
}

}  // namespace

RangeTable RangeTable::build(const StateSpace& space, const RayCaster& caster, const ProximityModel& model) {
  constexpr double kUnknownAllowance = 0.3;  // [m]: single unknown cells are gaps of mapping, not the end of the map
  const int headings = space.headings();
  const double max_range = model.centre(kNoReturn);
  const double behind = 0.5 * caster.frame().resolution;
  std::vector<Point2> directions;
  for (int h = 0; h < headings; ++h) directions.push_back(unit(Angle::radians(h * space.heading_step())));

  RangeTable table;
  table.stride_ = stride_of(headings);
  auto rows = std::make_shared<std::vector<std::uint8_t>>(space.places() * table.stride_, std::uint8_t{0});
  for (std::size_t place = 0; place < space.places(); ++place) {
    std::uint8_t* const row = rows->data() + place * table.stride_;
    const Point2 from = space.centre(place);
    for (int h = 0; h < headings; ++h) {
      const auto range = caster.cast(from, directions[static_cast<std::size_t>(h)], max_range, kUnknownAllowance);
      const int bin = !range ? kUnknownRange : *range >= max_range ? kNoReturn : model.bin(*range + behind);
      row[h] = static_cast<std::uint8_t>(bin);
    }
    for (std::size_t i = static_cast<std::size_t>(headings); i < table.stride_; ++i)
      row[i] = row[i - static_cast<std::size_t>(headings)];
  }
  table.data_ = rows->data();
  table.owner_ = std::move(rows);
  table.count(space.places(), headings);
  return table;
}

void RangeTable::count(std::size_t places, int headings) {
  std::array<std::uint64_t, kExpectedRanges> counts{};
  for (std::size_t place = 0; place < places; ++place)
    for (int h = 0; h < headings; ++h) ++counts[row(place)[h] & 127U];
  for (std::size_t i = 0; i < counts.size(); ++i) frequency_[i] = static_cast<double>(counts[i]);
}

Result<RangeTable> RangeTable::load(const std::filesystem::path& path, const std::string& key,
                                    const StateSpace& space) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return fail(path.string() + ": cannot be read");
  struct stat status {};
  const std::size_t expected = sizeof(Header) + space.places() * stride_of(space.headings());
  const bool whole = ::fstat(file, &status) == 0 && static_cast<std::size_t>(status.st_size) == expected;
  void* const memory = whole ? ::mmap(nullptr, expected, PROT_READ, MAP_PRIVATE, file, 0) : MAP_FAILED;
  ::close(file);
  if (memory == MAP_FAILED) return fail(path.string() + ": not a whole range table of this map");
  RangeTable table;
  table.owner_ =
      std::shared_ptr<const void>(memory, [expected](const void* p) { ::munmap(const_cast<void*>(p), expected); });
  table.data_ = static_cast<const std::uint8_t*>(memory) + sizeof(Header);
  table.stride_ = stride_of(space.headings());
  Header header{};
  std::memcpy(&header, memory, sizeof header);
  const bool right = std::memcmp(header.magic, kMagic, 8) == 0 && header.key == key_number(key) &&
                     header.places == space.places() && header.stride == table.stride_ &&
                     header.checksum == checksum_of(table.data_, expected - sizeof(Header));
  if (!right) return fail(path.string() + ": damaged, or of another map");
  table.count(space.places(), space.headings());
  return table;
}

RangeTable RangeTable::load_or_build(const std::filesystem::path& path, const std::string& key, const StateSpace& space,
                                     const RayCaster& caster, const ProximityModel& model) {
  if (auto loaded = load(path, key, space)) return std::move(*loaded);
  RangeTable table = build(space, caster, model);
  Header header{};
  std::memcpy(header.magic, kMagic, 8);
  header.key = key_number(key);
  header.places = space.places();
  header.stride = table.stride_;
  const std::size_t size = space.places() * table.stride_;
  header.checksum = checksum_of(table.data_, size);
  std::string content(sizeof(Header) + size, '\0');
  std::memcpy(content.data(), &header, sizeof header);
  std::memcpy(content.data() + sizeof header, table.data_, size);
  if (!write_file_atomically(path, content)) return table;
  if (auto loaded = load(path, key, space)) {
    return std::move(*loaded);
  }
  return table;
}

}  // namespace docent
