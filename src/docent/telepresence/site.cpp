#include "docent/telepresence/site.h"

#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include "docent/base/files.h"

namespace docent::telepresence {
namespace {

constexpr std::uintmax_t kMaxPageBytes = 64U << 20U;
constexpr std::uintmax_t kMaxAudioBytes = 32U << 20U;

std::string content_type_of(const std::filesystem::path& path) {
  static const std::map<std::string, std::string, std::less<>> kTypes = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".webp", "image/webp"},
      {".ico", "image/x-icon"},
      {".json", "application/json"},
      {".webmanifest", "application/manifest+json"},
      {".txt", "text/plain; charset=utf-8"},
  };
  const auto place = kTypes.find(path.extension().string());
  return place == kTypes.end() ? "application/octet-stream" : place->second;
}

/// Empty: no audio.
std::string_view audio_type_of(std::string_view name) {
  if (name.ends_with(".wav")) return "audio/wav";
  if (name.ends_with(".ogg")) return "audio/ogg";
  return name.ends_with(".flac") ? "audio/flac" : std::string_view{};
}

SiteReply plain(int status, std::string text) {
  SiteReply reply;
  reply.status = status;
  reply.body = std::make_shared<const std::string>(std::move(text));
  return reply;
}

/// `text` as a gzip file; empty when zlib fails.
std::string gzip(const std::string& text) {
  constexpr int kGzipWindow = 15 + 16;  // the largest window; 16 more asks for gzip's header
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzipWindow, 9, Z_DEFAULT_STRATEGY) != Z_OK) return {};
  std::string packed(deflateBound(&stream, static_cast<uLong>(text.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int status = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return status == Z_STREAM_END ? packed : std::string{};
}

/// A reply that stays as it is, with its compressed form where that saves at least a tenth: pictures are left alone.
SiteReply lasting(std::string content_type, std::string content) {
  SiteReply reply;
  reply.content_type = std::move(content_type);
  auto packed = gzip(content);
  if (!packed.empty() && packed.size() < content.size() - content.size() / 10) {
    reply.gzipped = std::make_shared<const std::string>(std::move(packed));
  }
  reply.body = std::make_shared<const std::string>(std::move(content));
  return reply;
}

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

bool equals_ignoring_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

bool accepts_gzip(std::string_view accept_encoding) {
  bool others = false;  // what "*" says of the encodings that are not named
  while (!accept_encoding.empty()) {
    const auto comma = accept_encoding.find(',');
    const std::string_view item = accept_encoding.substr(0, comma);
    accept_encoding.remove_prefix(comma == std::string_view::npos ? accept_encoding.size() : comma + 1);
    const auto semicolon = item.find(';');
    const std::string_view name = trimmed(item.substr(0, semicolon));
    double quality = 1.0;  // 0 means: never
    if (semicolon != std::string_view::npos) {
      const std::string_view weight = trimmed(item.substr(semicolon + 1));
      if (weight.size() < 3 || !equals_ignoring_case(weight.substr(0, 2), "q=")) continue;
      const std::string_view number = weight.substr(2);
      if (std::from_chars(number.data(), number.data() + number.size(), quality).ec != std::errc{}) continue;
    }
    if (equals_ignoring_case(name, "gzip") || equals_ignoring_case(name, "x-gzip")) return quality > 0.0;
    if (name == "*") others = quality > 0.0;
  }
  return others;
}

bool is_audio_name(std::string_view name) {
  constexpr std::size_t kLongest = 64;
  if (audio_type_of(name).empty()) return false;
  name = name.substr(0, name.rfind('.'));
  if (name.empty() || name.size() > kLongest) return false;
  return std::all_of(name.begin(), name.end(), [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

Result<void> Site::load_page(const std::filesystem::path& folder) {
  std::map<std::string, SiteReply, std::less<>> page;
  std::uintmax_t total = 0;
  std::error_code error;
  for (auto entry = std::filesystem::recursive_directory_iterator{folder, error};
       !error && entry != std::filesystem::recursive_directory_iterator{}; entry.increment(error)) {
    if (!entry->is_regular_file(error)) continue;
    total += entry->file_size(error);
    if (total > kMaxPageBytes) return fail(folder.string() + ": the page is larger than 64 MB");
    auto content = read_file(entry->path());
    if (!content) return tl::unexpected<Error>(content.error());
    SiteReply reply = lasting(content_type_of(entry->path()), std::move(*content));
    const std::string path = "/" + entry->path().lexically_relative(folder).generic_string();
    reply.is_immutable = path.starts_with("/assets/");
    page.insert_or_assign(path, std::move(reply));
  }
  if (error) return fail(folder.string() + ": cannot be read: " + error.message());
  const auto index = page.find("/index.html");
  if (index == page.end()) return fail(folder.string() + ": has no index.html (npm run build makes it)");
  page.insert_or_assign("/", index->second);
  constexpr std::string_view kPage = ".html";
  const auto files = page;
  for (const auto& [path, reply] : files)
    if (path.ends_with(kPage)) page.insert_or_assign(path.substr(0, path.size() - kPage.size()), reply);
  const std::scoped_lock lock{mutex_};
  for (auto& [path, reply] : page) documents_.insert_or_assign(path, std::move(reply));
  return {};
}

void Site::set_document(const std::string& path, std::string content_type, std::string body) {
  SiteReply reply = lasting(std::move(content_type), std::move(body));
  const std::scoped_lock lock{mutex_};
  documents_.insert_or_assign(path, std::move(reply));
}

void Site::set_file(const std::string& path, std::string content) {
  set_document(path, content_type_of(path), std::move(content));
}

void Site::set_changing(const std::string& path, std::string content_type, std::shared_ptr<const std::string> body,
                        std::string taken) {
  SiteReply reply;
  reply.content_type = std::move(content_type);
  if (body->empty()) reply.status = 204;  // there is none yet
  reply.body = std::move(body);
  reply.taken = std::move(taken);
  const std::scoped_lock lock{mutex_};
  documents_.insert_or_assign(path, std::move(reply));
}

void Site::set_live_document(const std::string& path, std::string content_type, std::function<std::string()> make) {
  const std::scoped_lock lock{mutex_};
  live_.insert_or_assign(path, Live{std::move(content_type), std::move(make)});
}

SiteReply Site::audio(std::string_view name) const {
  if (audio_.empty() || !is_audio_name(name)) return plain(404, "not found\n");
  const auto path = audio_ / std::string{name};
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error || size > kMaxAudioBytes) return plain(404, "not found\n");
  auto content = read_file(path);
  if (!content) return plain(404, "not found\n");
  SiteReply reply;
  reply.content_type = audio_type_of(name);
  reply.body = std::make_shared<const std::string>(std::move(*content));
  reply.is_immutable = true;
  return reply;
}

SiteReply Site::get(std::string_view target) const {
  const std::string_view path = target.substr(0, target.find('?'));
  constexpr std::string_view kAudio = "/audio/";
  if (path.starts_with(kAudio)) return audio(path.substr(kAudio.size()));
  std::function<std::string()> make;
  SiteReply reply;
  {
    const std::scoped_lock lock{mutex_};
    if (const auto place = documents_.find(path); place != documents_.end()) return place->second;
    const auto place = live_.find(path);
    if (place == live_.end()) return plain(404, "not found\n");
    make = place->second.make;
    reply.content_type = place->second.content_type;
  }
  reply.body = std::make_shared<const std::string>(make());
  return reply;
}

}  // namespace docent::telepresence
