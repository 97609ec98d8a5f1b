#include "docent/interaction/sound/microphone.h"

#include <alsa/asoundlib.h>

#include <algorithm>
#include <array>
#include <utility>

#include "docent/interaction/sound/sound_file.h"

namespace docent::interaction {
namespace {

constexpr unsigned kCaptureLatency = 500'000;  // [us] of the card's buffer: outlasts a module that listens

void pass_over(const char*, int, const char*, int, const char*, ...) {}  // ALSA prints what it also returns

class CardMicrophone final : public Microphone {
 public:
  explicit CardMicrophone(std::string device) : device_{std::move(device)} {}
  ~CardMicrophone() override { CardMicrophone::end(); }

  Result<void> begin(Time /*now*/) override {
    end();
    snd_lib_error_set_handler(pass_over);
    int status = snd_pcm_open(&pcm_, device_.c_str(), SND_PCM_STREAM_CAPTURE, SND_PCM_NONBLOCK);
    if (status < 0) pcm_ = nullptr;
    if (status >= 0)
      status = snd_pcm_set_params(pcm_, SND_PCM_FORMAT_S16, SND_PCM_ACCESS_RW_INTERLEAVED, 1, kSampleRate, 1,
                                  kCaptureLatency);
    if (status >= 0) status = snd_pcm_start(pcm_);
    if (status < 0) return fault(status);
    return {};
  }

  Result<Clip> read(Time /*now*/) override {
    Clip heard;
    if (pcm_ == nullptr) return tl::unexpected<Error>(Error{"microphone '" + device_ + "': is not open"});
    std::array<std::int16_t, 1024> samples{};
    while (true) {
      snd_pcm_sframes_t count = snd_pcm_readi(pcm_, samples.data(), samples.size());
      if (count == -EAGAIN || count == 0) return heard;
      if (count == -EPIPE) count = snd_pcm_recover(pcm_, static_cast<int>(count), 1);  // something was missed
      if (count < 0) return tl::unexpected<Error>(fault(static_cast<int>(count)).error());
      for (snd_pcm_sframes_t i = 0; i < count; ++i)
        heard.push_back(static_cast<float>(samples.at(static_cast<std::size_t>(i))) / 32768.0F);
      if (heard.size() > std::size_t{kSampleRate}) return heard;
    }
  }

  void end() override {
    if (pcm_ == nullptr) return;
    snd_pcm_drop(pcm_);
    snd_pcm_close(pcm_);
    pcm_ = nullptr;
  }

 private:
  Result<void> fault(int status) {
    end();
    return fail("microphone '" + device_ + "': " + snd_strerror(status));
  }

  std::string device_;
  snd_pcm_t* pcm_ = nullptr;
};

class FileMicrophone final : public Microphone {
 public:
  explicit FileMicrophone(std::filesystem::path path) : path_{std::move(path)} {}

  Result<void> begin(Time now) override {
    auto clip = read_clip(path_);
    if (!clip) return fail("microphone: " + clip.error().message);
    clip_ = std::move(*clip);
    begun_ = now;
    given_ = 0;
    return {};
  }

  Result<Clip> read(Time now) override {
    const auto due = static_cast<std::size_t>(std::max(0.0, to_seconds(now - begun_)) * kSampleRate);
    Clip heard;
    for (; given_ < due; ++given_) heard.push_back(given_ < clip_.size() ? clip_[given_] : 0.0F);
    return heard;
  }

 private:
  std::filesystem::path path_;
  Clip clip_;
  Time begun_{};
  std::size_t given_ = 0;
};

}  // namespace

std::unique_ptr<Microphone> open_microphone(const std::string& device) {
  return std::make_unique<CardMicrophone>(device);
}

std::unique_ptr<Microphone> file_microphone(const std::filesystem::path& path) {
  return std::make_unique<FileMicrophone>(path);
}

}  // namespace docent::interaction
