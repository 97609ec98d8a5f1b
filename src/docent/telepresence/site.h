#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "docent/base/result.h"

namespace docent::telepresence {

/// What a GET is answered with.
struct SiteReply {
  int status = 200;
  std::string content_type = "text/plain; charset=utf-8";
  std::shared_ptr<const std::string> body;     ///< never null
  std::shared_ptr<const std::string> gzipped;  ///< the same body compressed; null where that saves nothing
  std::string taken;          ///< when it was made, by the robot's clock [s]: also its version; empty: it has none
  bool is_immutable = false;  ///< its name changes with its content: keep it for ever
};

/// Everything that can be fetched, by exact path. The page is read into memory once, so no path from outside ever
/// reaches the file system; audio files are, and their names may only be hexadecimal digits and an ending. What does
/// not change is compressed once, when it is set. Any thread may call it.
class Site {
 public:
  /// Reads all files under `folder` as "/…"; "/" is index.html, "/kiosk" kiosk.html and so on. Error: unreadable, no
  /// index.html, or over 64 MB.
  [[nodiscard]] Result<void> load_page(const std::filesystem::path& folder);
  /// Serves /audio/HASH.wav, .ogg and .flac from here.
  void set_audio_folder(std::filesystem::path folder) { audio_ = std::move(folder); }
  void set_document(const std::string& path, std::string content_type, std::string body);
  /// Likewise; the ending of the path says what it is.
  void set_file(const std::string& path, std::string content);
  /// A file that is replaced every now and then, such as a camera's picture; `taken` says when it was made [s], and
  /// whoever has that one already is told so instead. Not compressed. An empty body says that there is none yet (204).
  void set_changing(const std::string& path, std::string content_type, std::shared_ptr<const std::string> body,
                    std::string taken);
  /// A document made anew for each reader; `make` is called by the server's thread.
  void set_live_document(const std::string& path, std::string content_type, std::function<std::string()> make);

  /// `target` is the request's target as it came, with its query.
  [[nodiscard]] SiteReply get(std::string_view target) const;

 private:
  struct Live {
    std::string content_type;
    std::function<std::string()> make;
  };
  [[nodiscard]] SiteReply audio(std::string_view name) const;

  std::filesystem::path audio_;
  mutable std::mutex mutex_;
  std::map<std::string, SiteReply, std::less<>> documents_;
  std::map<std::string, Live, std::less<>> live_;
};

/// True when a reader whose Accept-Encoding (RFC 9110, 12.5.3) is this may be sent gzip.
[[nodiscard]] bool accepts_gzip(std::string_view accept_encoding);

/// True for 1 to 64 hexadecimal digits and ".wav", ".ogg" or ".flac": no other name can be a file of ours.
[[nodiscard]] bool is_audio_name(std::string_view name);

}  // namespace docent::telepresence
