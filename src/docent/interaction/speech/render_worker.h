#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "docent/base/result.h"
#include "docent/interaction/sound/clip.h"
#include "docent/interaction/speech/repertoire.h"

namespace docent::interaction {

/// A line that can be heard.
struct RenderedSpeech {
  RenderedLine line;
  SharedClip clip;    ///< null where nobody asked for it
  std::string fault;  ///< of a recording that could not be used; the voice speaks instead
};

/// Makes lines heard: plays what was recorded for the museum, and has the voice speak all else.
class LineRenderer {
 public:
  /// `program`: the voice, espeak-ng; empty: there is none. `folder`: where the files go that everybody may fetch.
  LineRenderer(std::string program, double timeout_s, std::filesystem::path folder, Recordings recordings);

  /// False: there is neither a recording nor a voice.
  [[nodiscard]] bool can_render(const SpokenLine& line) const;
  /// As `render_speech`; `with_clip`: reads it as well. @pre can_render(line)
  [[nodiscard]] Result<RenderedSpeech> render(const SpokenLine& line, bool with_clip,
                                              const std::atomic<bool>& stop) const;

 private:
  std::string program_;
  double timeout_s_;
  std::filesystem::path folder_;
  Recordings recordings_;
};

/// Renders one line at a time on a thread of its own; a newer line ends the one before. While nothing is ordered it
/// renders ahead what it was told to, at most a quarter of the time.
class RenderWorker {
 public:
  /// Called by the worker's thread. With an empty id: why it renders ahead no longer.
  using Done = std::function<void(std::string id, Result<RenderedSpeech>)>;

  /// `with_clips`: of the lines that are ordered.
  RenderWorker(LineRenderer renderer, std::vector<RepertoireLine> ahead, bool with_clips, Done done);
  RenderWorker(const RenderWorker&) = delete;
  RenderWorker& operator=(const RenderWorker&) = delete;
  ~RenderWorker();  ///< ends at once; the line in work is dropped

  [[nodiscard]] bool can_render(const SpokenLine& line) const { return renderer_.can_render(line); }
  void render(std::string id, SpokenLine line);

 private:
  void work();
  void work_ahead(const SpokenLine& line);

  LineRenderer renderer_;
  bool with_clips_;
  Done done_;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable wake_;
  std::optional<std::pair<std::string, SpokenLine>> next_;
  std::deque<SpokenLine> ahead_;
  bool is_ending_ = false;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace docent::interaction
