#include "docent/interaction/speech/render_worker.h"

#include <chrono>
#include <memory>

#include "docent/interaction/sound/sound_file.h"

namespace docent::interaction {
namespace {

constexpr int kRest = 3;  ///< times as long as it took to render a line ahead: the robot's computer has other work

}  // namespace

LineRenderer::LineRenderer(std::string program, double timeout_s, std::filesystem::path folder, Recordings recordings)
    : program_{std::move(program)},
      timeout_s_{timeout_s},
      folder_{std::move(folder)},
      recordings_{std::move(recordings)} {}

bool LineRenderer::can_render(const SpokenLine& line) const {
  return !program_.empty() || recordings_.find(line.language, line.text) != nullptr;
}

Result<RenderedSpeech> LineRenderer::render(const SpokenLine& line, bool with_clip,
                                            const std::atomic<bool>& stop) const {
  RenderedSpeech speech;
  const std::filesystem::path* recording = recordings_.find(line.language, line.text);
  if (recording != nullptr) {
    if (auto taken = take_recording(*recording, folder_)) {
      speech.line = std::move(*taken);
    } else {
      speech.fault = taken.error().message;
    }
  }
  if (speech.line.file.empty()) {
    auto spoken = render_speech(line, folder_, program_, timeout_s_, stop);
    if (!spoken) return tl::unexpected<Error>(spoken.error());
    speech.line = std::move(*spoken);
  }
  if (with_clip) {
    auto clip = read_clip(folder_ / speech.line.file);
    if (!clip) return tl::unexpected<Error>(clip.error());
    speech.clip = std::make_shared<const Clip>(std::move(*clip));
  }
  return speech;
}

RenderWorker::RenderWorker(LineRenderer renderer, std::vector<RepertoireLine> ahead, bool with_clips, Done done)
    : renderer_{std::move(renderer)}, with_clips_{with_clips}, done_{std::move(done)} {
  for (RepertoireLine& line : ahead) {
    if (renderer_.can_render(line.line)) ahead_.push_back(std::move(line.line));
  }
  thread_ = std::thread{[this] { work(); }};
}

RenderWorker::~RenderWorker() {
  {
    const std::scoped_lock lock{mutex_};
    is_ending_ = true;
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void RenderWorker::render(std::string id, SpokenLine line) {
  {
    const std::scoped_lock lock{mutex_};
    next_.emplace(std::move(id), std::move(line));
    stop_ = true;
  }
  wake_.notify_one();
}

void RenderWorker::work() {
  while (true) {
    std::optional<std::pair<std::string, SpokenLine>> ordered;
    SpokenLine ahead;
    {
      std::unique_lock lock{mutex_};
      wake_.wait(lock, [this] { return is_ending_ || next_ || !ahead_.empty(); });
      if (is_ending_) return;
      ordered = std::exchange(next_, std::nullopt);
      if (!ordered) ahead = ahead_.front();
      stop_ = false;
    }
    if (!ordered) {
      work_ahead(ahead);
      continue;
    }
    auto speech = renderer_.render(ordered->second, with_clips_, stop_);
    if (!stop_) done_(std::move(ordered->first), std::move(speech));
  }
}

void RenderWorker::work_ahead(const SpokenLine& line) {
  const auto begin = std::chrono::steady_clock::now();
  auto speech = renderer_.render(line, false, stop_);
  if (stop_) return;  // something was ordered: the line comes again
  const auto took = std::chrono::steady_clock::now() - begin;
  std::unique_lock lock{mutex_};
  ahead_.pop_front();
  if (!speech) ahead_.clear();  // the next ones would fail as well
  wake_.wait_for(lock, kRest * took, [this] { return is_ending_ || next_; });
  lock.unlock();
  if (!speech) done_("", std::move(speech));
}

}  // namespace docent::interaction
