#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "docent/interaction/speech/render_worker.h"

namespace docent::interaction {

/// Makes the lines of the robot heard.
class LineVoice {
 public:
  LineVoice() = default;
  LineVoice(const LineVoice&) = delete;
  LineVoice& operator=(const LineVoice&) = delete;
  virtual ~LineVoice() = default;

  [[nodiscard]] virtual bool can_render(const SpokenLine& line) const = 0;
  /// nullopt: it is told later. @pre can_render(line)
  [[nodiscard]] virtual std::optional<Result<RenderedSpeech>> render(const std::string& id, SpokenLine line) = 0;
};

/// In virtual time, which knows no waiting: a line is rendered when it is ordered.
class PromptVoice final : public LineVoice {
 public:
  explicit PromptVoice(LineRenderer renderer) : renderer_{std::move(renderer)} {}

  [[nodiscard]] bool can_render(const SpokenLine& line) const override { return renderer_.can_render(line); }
  [[nodiscard]] std::optional<Result<RenderedSpeech>> render(const std::string& /*id*/, SpokenLine line) override {
    const std::atomic<bool> go_on{false};
    return renderer_.render(line, true, go_on);
  }

 private:
  LineRenderer renderer_;
};

/// Under wall time: on a thread of its own.
class WorkerVoice final : public LineVoice {
 public:
  /// As RenderWorker.
  WorkerVoice(LineRenderer renderer, std::vector<RepertoireLine> ahead, bool with_clips, RenderWorker::Done done)
      : worker_{std::move(renderer), std::move(ahead), with_clips, std::move(done)} {}

  [[nodiscard]] bool can_render(const SpokenLine& line) const override { return worker_.can_render(line); }
  [[nodiscard]] std::optional<Result<RenderedSpeech>> render(const std::string& id, SpokenLine line) override {
    worker_.render(id, std::move(line));
    return std::nullopt;
  }

 private:
  RenderWorker worker_;
};

}  // namespace docent::interaction
