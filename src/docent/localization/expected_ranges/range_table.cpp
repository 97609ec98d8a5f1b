#include "docent/localization/expected_ranges/range_table.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

#include "docent/base/random.h"
#include "docent/localization/expected_ranges/range_table_cache.h"

namespace docent::localization {

namespace {

struct Header {
  char magic[8];  // kMagic
  std::uint64_t key;
  std::uint64_t places;
  std::uint64_t directions;
  std::uint64_t checksum;  ///< of the tiles
  std::uint8_t rest[24];   ///< tiles begin at a multiple of 64 bytes
};
static_assert(sizeof(Header) == 64);
constexpr char kMagic[9] = "DOCRNG02";

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

std::size_t tiles_of(std::size_t places) { return (places + RangeTable::kTile - 1) / RangeTable::kTile; }
std::size_t size_of(const StateSpace& space) {
  return tiles_of(space.places()) * static_cast<std::size_t>(space.headings()) * RangeTable::kTile;
}

std::shared_ptr<void> aligned_memory(std::size_t size) {
  return {::operator new (std::max<std::size_t>(size, 1), std::align_val_t{64}),
          [](void* p) { ::operator delete (p, std::align_val_t{64}); }};
}

/// Fills the tiles of a table. Each byte depends on its place and direction alone, so threads may share the work.
class Builder {
 public:
  Builder(const StateSpace& space, const sensor_models::RayCaster& caster, const sensor_models::ProximityModel& model)
      : space_{space}, caster_{caster}, model_{model}, max_range_{model.centre(sensor_models::kNoReturn)} {
    for (int h = 0; h < space.headings(); ++h) directions_.push_back(unit(Angle::radians(h * space.heading_step())));
  }

  void fill(std::uint8_t* data, const RangeTable::Building& how) const {
    const std::size_t tiles = tiles_of(space_.places());
    std::atomic<std::size_t> next{0};
    const auto work = [&](bool reports) {
      for (std::size_t tile = next++; tile < tiles; tile = next++) {
        fill_tile(tile, data + tile * directions_.size() * RangeTable::kTile);
        if (reports && how.progress) how.progress(static_cast<double>(tile + 1) / static_cast<double>(tiles));
      }
    };
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < how.threads; ++i) helpers.emplace_back(work, false);
    work(true);
  }

  /// Some tiles are cast again: a whole table of this map may be that of a program which casted rays otherwise.
  [[nodiscard]] bool agrees(const RangeTable& table) const {
    constexpr std::size_t kAsked = 8;  // less than a second of the largest halls
    const std::size_t tiles = tiles_of(space_.places());
    std::vector<std::uint8_t> tile(directions_.size() * RangeTable::kTile);
    for (std::size_t i = 0; i < tiles; i += (tiles + kAsked - 1) / kAsked) {
      fill_tile(i, tile.data());
      if (std::memcmp(tile.data(), table.tile(i), tile.size()) != 0) return false;
    }
    return true;
  }

 private:
  void fill_tile(std::size_t tile, std::uint8_t* out) const {
    constexpr double kUnknownAllowance = 0.3;  // [m]: single unknown cells are gaps of mapping, not the end of the map
    const double behind = 0.5 * caster_.frame().resolution;
    const std::size_t first = tile * RangeTable::kTile;
    const std::size_t count = std::min(RangeTable::kTile, space_.places() - first);
    std::memset(out, sensor_models::kUnknownRange, directions_.size() * RangeTable::kTile);
    for (std::size_t i = 0; i < count; ++i) {
      const Point2 from = space_.centre(first + i);
      for (std::size_t h = 0; h < directions_.size(); ++h) {
        const auto range = caster_.cast(from, directions_[h], max_range_, kUnknownAllowance);
        const int bin = !range                 ? sensor_models::kUnknownRange
                        : *range >= max_range_ ? sensor_models::kNoReturn
                                               : model_.bin(*range + behind);
        out[h * RangeTable::kTile + i] = static_cast<std::uint8_t>(bin);
      }
    }
  }

  const StateSpace& space_;
  const sensor_models::RayCaster& caster_;
  const sensor_models::ProximityModel& model_;
  double max_range_;
  std::vector<Point2> directions_;
};

using Mapping = std::shared_ptr<void>;
Mapping map_file(int file, std::size_t size, int protection, int flags) {
  void* const memory = ::mmap(nullptr, size, protection, flags, file, 0);
  if (memory == MAP_FAILED) return nullptr;
  return {memory, [size](void* p) { ::munmap(p, size); }};
}

/// A file of its own beside `path`, which is renamed when it is whole. Invalid when anything fails.
class NewFile {
 public:
  NewFile(const std::filesystem::path& path, std::size_t size)
      : path_{path}, part_{path.string() + RangeTableCache::kPart + "XXXXXX"} {
    file_ = ::mkostemp(part_.data(), O_CLOEXEC);  // nobody else's, not even another thread's of this process
    // Space is claimed now: a full disk must show here, not as a signal while the mapping is written.
    if (file_ >= 0 && ::posix_fallocate(file_, 0, static_cast<off_t>(size)) == 0)
      memory_ = map_file(file_, size, PROT_READ | PROT_WRITE, MAP_SHARED);
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile() {
    if (file_ >= 0) ::close(file_);
    if (file_ >= 0 && !kept_) ::unlink(part_.c_str());
  }
  [[nodiscard]] std::uint8_t* memory() const { return static_cast<std::uint8_t*>(memory_.get()); }
  [[nodiscard]] bool keep() {
    kept_ = ::fsync(file_) == 0 && ::rename(part_.c_str(), path_.c_str()) == 0;
    return kept_;
  }

 private:
  std::filesystem::path path_;
  std::string part_;
  int file_ = -1;
  Mapping memory_;
  bool kept_ = false;
};

}  // namespace

RangeTable RangeTable::build(const StateSpace& space, const sensor_models::RayCaster& caster,
                             const sensor_models::ProximityModel& model, const Building& how) {
  RangeTable table;
  table.directions_ = static_cast<std::size_t>(space.headings());
  const std::size_t size = size_of(space);
  const std::shared_ptr<void> memory = aligned_memory(size);
  auto* const data = static_cast<std::uint8_t*>(memory.get());
  Builder{space, caster, model}.fill(data, how);
  table.data_ = data;
  table.owner_ = memory;
  table.count(space.places());
  return table;
}

void RangeTable::count(std::size_t places) {
  std::array<std::uint64_t, sensor_models::kExpectedRanges> counts{};
  for (std::size_t i = 0; i < tiles_of(places); ++i) {
    const std::size_t used = std::min(kTile, places - i * kTile);
    const std::uint8_t* line = tile(i);
    for (std::size_t d = 0; d < directions_; ++d, line += kTile)
      for (std::size_t place = 0; place < used; ++place) ++counts[line[place] & 127U];
  }
  for (std::size_t i = 0; i < counts.size(); ++i) frequency_[i] = static_cast<double>(counts[i]);
}

RangeTable RangeTable::cones(const RangeTable& rays, const sensor_models::ProximityModel& rays_model,
                             const StateSpace& space, const sensor_models::ProximityModel& model, double opening) {
  std::array<std::uint8_t, 256> bin{};
  bin.fill(sensor_models::kUnknownRange);
  for (int o = 0; o < sensor_models::kUnknownRange; ++o)
    bin[static_cast<std::size_t>(o)] = static_cast<std::uint8_t>(model.bin(rays_model.centre(o)));
  RangeTable table;
  table.directions_ = rays.directions_;
  const std::size_t tiles = tiles_of(space.places());
  const std::shared_ptr<void> memory = aligned_memory(size_of(space));
  auto* const data = static_cast<std::uint8_t*>(memory.get());
  const auto half = static_cast<std::size_t>(std::lround(0.5 * opening / space.heading_step()));
  const std::size_t width = std::min(2 * half + 1, rays.directions_);
  std::vector<std::uint8_t> single(rays.directions_ * kTile);
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    const std::uint8_t* const from = rays.tile(tile);
    for (std::size_t i = 0; i < single.size(); ++i) single[i] = bin[from[i]];
    std::uint8_t* const to = data + tile * single.size();
    std::copy(single.begin(), single.end(), to);
    for (std::size_t d = 0; d < rays.directions_; ++d)
      for (std::size_t k = 0; k < width; ++k) {
        const std::uint8_t* const line = single.data() + (d + k + rays.directions_ - half) % rays.directions_ * kTile;
        for (std::size_t i = 0; i < kTile; ++i) to[d * kTile + i] = std::min(to[d * kTile + i], line[i]);
      }
  }
  table.data_ = data;
  table.owner_ = memory;
  table.count(space.places());
  return table;
}

Result<RangeTable> RangeTable::load(const std::filesystem::path& path, const std::string& key,
                                    const StateSpace& space) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe would let it wait for ever
  if (file < 0) return fail(path.string() + ": cannot be read");
  struct stat status {};
  const std::size_t expected = sizeof(Header) + size_of(space);
  const bool whole =
      ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && static_cast<std::size_t>(status.st_size) == expected;
  const Mapping memory = whole ? map_file(file, expected, PROT_READ, MAP_PRIVATE) : nullptr;
  if (memory) static_cast<void>(::futimens(file, nullptr));  // its age tells the cache how long nobody has wanted it
  ::close(file);
  if (!memory) return fail(path.string() + ": not a whole range table of this map");
  RangeTable table;
  table.owner_ = memory;
  table.data_ = static_cast<const std::uint8_t*>(memory.get()) + sizeof(Header);
  table.directions_ = static_cast<std::size_t>(space.headings());
  Header header{};
  std::memcpy(&header, memory.get(), sizeof header);
  const bool right = std::memcmp(header.magic, kMagic, 8) == 0 && header.key == hash_of(key) &&
                     header.places == space.places() && header.directions == table.directions_ &&
                     header.checksum == checksum_of(table.data_, expected - sizeof(Header));
  if (!right) return fail(path.string() + ": damaged, or of another map");
  table.count(space.places());
  return table;
}

RangeTable RangeTable::load_or_build(const std::filesystem::path& path, const std::string& key, const StateSpace& space,
                                     const sensor_models::RayCaster& caster, const sensor_models::ProximityModel& model,
                                     const Building& how) {
  const Builder builder{space, caster, model};
  if (auto loaded = load(path, key, space); loaded && builder.agrees(*loaded)) return std::move(*loaded);
  {
    NewFile file{path, sizeof(Header) + size_of(space)};
    if (std::uint8_t* const data = file.memory()) {
      builder.fill(data + sizeof(Header), how);
      Header header{};
      std::memcpy(header.magic, kMagic, 8);
      header.key = hash_of(key);
      header.places = space.places();
      header.directions = static_cast<std::uint64_t>(space.headings());
      header.checksum = checksum_of(data + sizeof(Header), size_of(space));
      std::memcpy(data, &header, sizeof header);
      static_cast<void>(file.keep());
    }
  }
  if (auto loaded = load(path, key, space)) return std::move(*loaded);
  return build(space, caster, model, how);
}

}  // namespace docent::localization
