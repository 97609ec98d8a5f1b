#include "docent/telepresence/site.h"

#include <algorithm>
#include <system_error>

#include "docent/base/files.h"

namespace docent {
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
      {".webp", "image/webp"},
      {".ico", "image/x-icon"},
      {".json", "application/json"},
      {".webmanifest", "application/manifest+json"},
      {".txt", "text/plain; charset=utf-8"},
  };
  const auto place = kTypes.find(path.extension().string());
  return place == kTypes.end() ? "application/octet-stream" : place->second;
}

SiteReply plain(int status, std::string text) {
  SiteReply reply;
  reply.status = status;
  reply.body = std::make_shared<const std::string>(std::move(text));
  return reply;
}

}  // namespace

bool is_audio_name(std::string_view name) {
  constexpr std::string_view kEnd = ".wav";
  if (name.size() <= kEnd.size() || name.size() > 64 + kEnd.size() || !name.ends_with(kEnd)) return false;
  name.remove_suffix(kEnd.size());
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
    SiteReply reply;
    reply.content_type = content_type_of(entry->path());
    reply.body = std::make_shared<const std::string>(std::move(*content));
    const std::string path = "/" + entry->path().lexically_relative(folder).generic_string();
    reply.is_immutable = path.starts_with("/assets/");
    page.insert_or_assign(path, std::move(reply));
  }
  if (error) return fail(folder.string() + ": cannot be read: " + error.message());
  const auto index = page.find("/index.html");
  if (index == page.end()) return fail(folder.string() + ": has no index.html (npm run build makes it)");
  page.insert_or_assign("/", index->second);
  const std::scoped_lock lock{mutex_};
  for (auto& [path, reply] : page) documents_.insert_or_assign(path, std::move(reply));
  return {};
}

void Site::set_document(const std::string& path, std::string content_type, std::string body) {
  SiteReply reply;
  reply.content_type = std::move(content_type);
  reply.body = std::make_shared<const std::string>(std::move(body));
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
  reply.content_type = "audio/wav";
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

}  // namespace docent
