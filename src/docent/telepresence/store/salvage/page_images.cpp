#include "docent/telepresence/store/salvage/page_images.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <set>
#include <utility>

#include "docent/telepresence/store/salvage/page_bytes.h"

namespace docent::telepresence {
namespace {

constexpr std::string_view kMagic{"SQLite format 3\0", 16};
constexpr std::size_t kWalHeader = 32;
constexpr std::size_t kFrameHeader = 24;
constexpr std::size_t kDefaultPage = 4096;

bool is_page_size(std::size_t size) { return size >= 512 && size <= 65536 && std::has_single_bit(size); }

/// Fibonacci-weighted sums, in pairs of words of the WAL's byte order.
struct Checksum {
  std::uint32_t a = 0, b = 0;
  void add(std::string_view bytes, bool is_big_endian) {
    for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
      a += word(bytes, at, is_big_endian) + b;
      b += word(bytes, at + 4, is_big_endian) + a;
    }
  }
  static std::uint32_t word(std::string_view bytes, std::size_t at, bool is_big_endian) {
    const std::uint32_t big = big_endian<4>(bytes, at);
    return is_big_endian ? big : __builtin_bswap32(big);
  }
  bool operator==(const Checksum&) const = default;
};

struct Frame {
  std::uint32_t page = 0;
  bool ends_transaction = false;
  bool is_ours = false;  ///< its salts are those of the header, but for a byte
  bool is_good = false;  ///< so is its checksum
  bool is_left_out = false;
  std::string_view image;
};

struct Wal {
  std::size_t page_size = 0;
  bool has_good_header = false;
  std::size_t count = 0;  ///< of all frames that are whole
  std::vector<Frame> frames;
  std::vector<Frame> older;  ///< of what the WAL held before, the last first
  bool is_damaged = false;
};

std::string_view salts_of(std::string_view wal, std::size_t page_size, bool has_good_header) {
  if (has_good_header) return wal.substr(16, 8);
  // Two frames of three agree, also where one is spoiled.
  std::vector<std::string_view> salts;
  for (std::size_t at = kWalHeader; at + kFrameHeader + page_size <= wal.size() && salts.size() < 3;
       at += kFrameHeader + page_size)
    salts.push_back(wal.substr(at + 8, 8));
  if (salts.size() == 3 && salts[1] == salts[2]) return salts[1];
  return salts.empty() ? std::string_view{} : salts[0];
}

std::size_t spoiled_bytes(std::string_view one, std::string_view other) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < one.size() && i < other.size(); ++i) count += one[i] != other[i] ? 1 : 0;
  return count;
}

Wal parse_wal(std::string_view wal, std::size_t wanted_page_size, bool is_cut) {
  Wal found;
  if (wal.size() < kWalHeader) return found;
  Checksum of_header;
  const std::uint32_t magic = big_endian<4>(wal, 0);
  const bool is_big_endian = magic == 0x377f0683;
  of_header.add(wal.substr(0, 24), is_big_endian);
  found.has_good_header = (magic == 0x377f0682 || is_big_endian) &&
                          of_header == Checksum{big_endian<4>(wal, 24), big_endian<4>(wal, 28)} &&
                          is_page_size(big_endian<4>(wal, 8));
  found.page_size = found.has_good_header ? big_endian<4>(wal, 8) : wanted_page_size;
  const std::string_view salts = salts_of(wal, found.page_size, found.has_good_header);
  const std::size_t step = kFrameHeader + found.page_size;
  Checksum before{big_endian<4>(wal, 24), big_endian<4>(wal, 28)};
  for (std::size_t at = kWalHeader; at + step <= wal.size(); at += step) {
    Frame frame{big_endian<4>(wal, at),
                big_endian<4>(wal, at + 4) != 0,
                false,
                false,
                false,
                wal.substr(at + kFrameHeader, found.page_size)};
    const Checksum said{big_endian<4>(wal, at + 16), big_endian<4>(wal, at + 20)};
    frame.is_ours = spoiled_bytes(wal.substr(at + 8, 8), salts) <= 1;
    Checksum sum = before;
    sum.add(wal.substr(at, 8), is_big_endian);
    sum.add(frame.image, is_big_endian);
    frame.is_good = frame.is_ours && sum == said;
    before = said;
    found.frames.push_back(frame);
  }
  found.count = found.frames.size();
  // Behind the last of this generation stand those of older ones, which are in the file.
  while (!found.frames.empty() && !found.frames.back().is_ours) {
    found.older.push_back(found.frames.back());
    found.frames.pop_back();
  }
  found.is_damaged = std::any_of(found.frames.begin(), found.frames.end(),
                                 [&](const Frame& frame) { return !found.has_good_header || !frame.is_good; });
  // What was never committed is nobody's, unless the end of what was is gone.
  for (auto frame = found.frames.rbegin(); frame != found.frames.rend(); ++frame) {
    if (frame->ends_transaction || !frame->is_good) break;
    if (is_cut) frame->is_good = false;
    frame->is_left_out = !is_cut;
  }
  std::erase_if(found.frames, [](const Frame& frame) { return frame.is_left_out; });
  return found;
}

std::size_t page_size_of(std::string_view file) {
  if (!has_sqlite_header(file) || file.size() < 100) return kDefaultPage;
  const std::size_t said = big_endian<2>(file, 16);
  const std::size_t size = said == 1 ? 65536 : said;
  return is_page_size(size) ? size : kDefaultPage;
}

}  // namespace

bool has_sqlite_header(std::string_view file) { return file.starts_with(kMagic); }

PageImages read_pages(std::string_view file, std::string_view wal, bool is_cut) {
  PageImages images;
  const Wal log = parse_wal(wal, page_size_of(file), is_cut);
  images.page_size = log.has_good_header ? log.page_size : page_size_of(file);
  images.usable = images.page_size;
  if (has_sqlite_header(file) && file.size() >= 100 && big_endian<1>(file, 20) < 64)
    images.usable -= big_endian<1>(file, 20);
  for (std::size_t at = 0; at + images.page_size <= file.size(); at += images.page_size)
    images.pages[static_cast<std::uint32_t>(at / images.page_size + 1)] = file.substr(at, images.page_size);
  const auto fill = [&](std::string_view begin) {
    std::string page{begin};
    page.resize(images.page_size, '\0');
    images.filled.push_back(std::make_shared<const std::string>(std::move(page)));
    return std::string_view{*images.filled.back()};
  };
  if (const std::size_t rest = file.size() % images.page_size; rest != 0)
    images.pages[static_cast<std::uint32_t>(file.size() / images.page_size + 1)] =
        fill(file.substr(file.size() - rest));
  std::set<std::uint32_t> newer;
  for (auto frame = log.frames.rbegin(); frame != log.frames.rend(); ++frame) {
    const bool is_newest = newer.insert(frame->page).second;
    if (!frame->is_good) {
      images.doubtful.push_back({frame->page, frame->image, is_newest});
      if (is_newest) newer.erase(frame->page);  // the newest good one is wanted too
    } else if (is_newest) {
      images.pages[frame->page] = frame->image;
    }
  }
  std::reverse(images.doubtful.begin(), images.doubtful.end());
  if (const std::size_t at = kWalHeader + log.count * (kFrameHeader + images.page_size); at + kFrameHeader < wal.size())
    images.doubtful.push_back({big_endian<4>(wal, at), fill(wal.substr(at + kFrameHeader)), true});
  for (const Frame& frame : log.older) images.older.emplace_back(frame.page, frame.image);
  return images;
}

WalReport look_at_wal(std::string_view wal) {
  const Wal log = parse_wal(wal, kDefaultPage, false);
  return {log.frames.size(), log.is_damaged};
}

std::size_t frames_only_in_wal(std::string_view index) {
  constexpr std::size_t kCopy = 48;  // the header stands there twice
  if (index.size() < 2 * kCopy + 4 || index.substr(0, kCopy) != index.substr(kCopy, kCopy)) return 0;
  const auto native = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, index.data() + at, sizeof value);
    return value;
  };
  const std::uint32_t frames = native(16);
  const std::uint32_t copied = native(2 * kCopy);
  return native(0) == 3007000 && copied <= frames ? frames - copied : 0;
}

}  // namespace docent::telepresence
