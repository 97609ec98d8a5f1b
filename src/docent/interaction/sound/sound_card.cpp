#include "docent/interaction/sound/sound_card.h"

#include <alsa/asoundlib.h>

#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "docent/interaction/sound/clip.h"

namespace docent::interaction {
namespace {

constexpr unsigned kLatency = 100'000;  ///< [us] of the card's buffer: outlasts a busy computer's pauses
constexpr std::size_t kPeriod = 1024;   ///< [samples] 23 ms
constexpr auto kBetweenWrites =
    std::chrono::milliseconds{5};  ///< between two looks: a device that takes all at once is not flooded

void say_nothing(const char*, int, const char*, int, const char*, ...) {}  // ALSA prints what it also returns

}  // namespace

struct SoundCard::Body {
  ~Body() {
    is_ending = true;
    if (thread.joinable()) thread.join();
    if (pcm != nullptr) {
      snd_pcm_drop(pcm);
      snd_pcm_close(pcm);
    }
  }
  void play() {
    std::array<std::int16_t, kPeriod> samples{};
    while (!is_ending) {
      const snd_pcm_sframes_t room = snd_pcm_avail_update(pcm);
      snd_pcm_sframes_t status = room;
      if (room >= static_cast<snd_pcm_sframes_t>(kPeriod)) {
        fill(samples);
        status = snd_pcm_writei(pcm, samples.data(), kPeriod);
      }
      if (status < 0) status = snd_pcm_recover(pcm, static_cast<int>(status), 1);
      if (status < 0) {
        const std::scoped_lock lock{mutex};
        fault = name + ": " + snd_strerror(static_cast<int>(status));
        return;
      }
      std::this_thread::sleep_for(kBetweenWrites);
    }
  }

  std::string name;
  Fill fill;
  snd_pcm_t* pcm = nullptr;
  std::atomic<bool> is_ending{false};
  mutable std::mutex mutex;  ///< of `fault`
  std::string fault;
  std::thread thread;
};

Result<std::unique_ptr<SoundCard>> SoundCard::open(const std::string& device, Fill fill) {
  snd_lib_error_set_handler(say_nothing);
  auto body = std::make_unique<Body>();
  body->name = "sound card '" + device + "'";
  body->fill = std::move(fill);
  int status = snd_pcm_open(&body->pcm, device.c_str(), SND_PCM_STREAM_PLAYBACK, SND_PCM_NONBLOCK);
  if (status < 0) {
    body->pcm = nullptr;
    return docent::fail(body->name + ": " + snd_strerror(status));
  }
  status =
      snd_pcm_set_params(body->pcm, SND_PCM_FORMAT_S16, SND_PCM_ACCESS_RW_INTERLEAVED, 1, kSampleRate, 1, kLatency);
  if (status < 0) return docent::fail(body->name + ": " + snd_strerror(status));
  body->thread = std::thread{[raw = body.get()] { raw->play(); }};
  return std::unique_ptr<SoundCard>{new SoundCard{std::move(body)}};
}

SoundCard::SoundCard(std::unique_ptr<Body> body) : body_{std::move(body)} {}
SoundCard::~SoundCard() = default;

std::string SoundCard::fault() const {
  const std::scoped_lock lock{body_->mutex};
  return body_->fault;
}

}  // namespace docent::interaction
