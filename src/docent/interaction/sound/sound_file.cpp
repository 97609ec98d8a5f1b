#include "docent/interaction/sound/sound_file.h"

#include <samplerate.h>
#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <system_error>
#include <vector>

#include "docent/base/files.h"
#include "docent/base/random.h"

namespace docent::interaction {
namespace {

constexpr double kLongest = 1800.0;  ///< [s] of a file: no text is longer, and the clip stands in the memory
constexpr int kMostChannels = 8;

struct CloseFile {
  void operator()(SNDFILE* file) const { sf_close(file); }
};
using OpenFile = std::unique_ptr<SNDFILE, CloseFile>;

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

Result<OpenFile> open_to_read(const std::filesystem::path& path, SF_INFO& info) {
  OpenFile file{sf_open(path.c_str(), SFM_READ, &info)};
  if (!file) return fail(path.string() + ": " + sf_strerror(nullptr));
  if (info.frames <= 0 || info.samplerate <= 0) return fail(path.string() + ": has no samples");
  if (info.channels < 1 || info.channels > kMostChannels) return fail(path.string() + ": has too many channels");
  if (static_cast<double>(info.frames) > kLongest * info.samplerate)
    return fail(path.string() + ": is longer than half an hour");
  return file;
}

/// The samples at kSampleRate.
Result<Clip> resampled(const Clip& clip, int rate) {
  if (rate == kSampleRate) return clip;
  const double ratio = static_cast<double>(kSampleRate) / rate;
  if (src_is_valid_ratio(ratio) == 0) return fail("a sampling rate of " + std::to_string(rate) + " Hz is of no use");
  Clip result(static_cast<std::size_t>(static_cast<double>(clip.size()) * ratio) + 1);
  SRC_DATA data{};
  data.data_in = clip.data();
  data.input_frames = static_cast<long>(clip.size());
  data.data_out = result.data();
  data.output_frames = static_cast<long>(result.size());
  data.src_ratio = ratio;
  if (const int fault = src_simple(&data, SRC_SINC_FASTEST, 1); fault != 0) return fail(src_strerror(fault));
  result.resize(static_cast<std::size_t>(data.output_frames_gen));
  return result;
}

std::string little_endian(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFFU);
  return text;
}

}  // namespace

bool is_sound_file(const std::filesystem::path& path) {
  constexpr std::array<const char*, 3> kEndings{".wav", ".ogg", ".flac"};
  return std::find(kEndings.begin(), kEndings.end(), ending_of(path)) != kEndings.end();
}

Result<double> sound_duration(const std::filesystem::path& path) {
  SF_INFO info{};
  const auto file = open_to_read(path, info);
  if (!file) return tl::unexpected<Error>(file.error());
  return static_cast<double>(info.frames) / info.samplerate;
}

Result<Clip> read_clip(const std::filesystem::path& path) {
  SF_INFO info{};
  const auto file = open_to_read(path, info);
  if (!file) return tl::unexpected<Error>(file.error());
  const auto channels = static_cast<std::size_t>(info.channels);
  std::vector<float> frames(static_cast<std::size_t>(info.frames) * channels);
  const sf_count_t held = sf_readf_float(file->get(), frames.data(), info.frames);
  if (held <= 0) return fail(path.string() + ": has no samples");
  Clip mono(static_cast<std::size_t>(held));
  for (std::size_t i = 0; i < mono.size(); ++i) {
    for (std::size_t channel = 0; channel < channels; ++channel)
      mono[i] += frames[i * channels + channel] / static_cast<float>(channels);
  }
  auto clip = resampled(mono, info.samplerate);
  if (!clip) return fail(path.string() + ": " + clip.error().message);
  return clip;
}

std::string shared_name(std::string_view content, const std::filesystem::path& file) {
  char name[32];
  std::snprintf(name, sizeof name, "%016llx", static_cast<unsigned long long>(hash_of(content)));
  return name + ending_of(file);
}

SharedSound shared_sound(const Clip& clip) {
  constexpr std::uint32_t kRate = kSampleRate;
  std::string samples;
  samples.reserve(2 * clip.size());
  for (const float sample : clip) samples += little_endian(static_cast<std::uint16_t>(to_pcm(sample)), 2);
  const auto size = static_cast<std::uint32_t>(samples.size());
  SharedSound sound;
  sound.duration_s = duration_s(clip);
  sound.content = "RIFF" + little_endian(36 + size, 4) + "WAVEfmt " + little_endian(16, 4) + little_endian(1, 2) +
                  little_endian(1, 2) + little_endian(kRate, 4) + little_endian(2 * kRate, 4) + little_endian(2, 2) +
                  little_endian(16, 2) + "data" + little_endian(size, 4) + samples;
  sound.file = shared_name(sound.content, "sound.wav");
  return sound;
}

Result<void> write_shared(const SharedSound& sound, const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder / sound.file, error)) return {};
  std::filesystem::create_directories(folder, error);
  if (error) return fail(folder.string() + ": " + error.message());
  return write_file_atomically(folder / sound.file, sound.content);
}

void WavWriter::Close::operator()(void* file) const { sf_close(static_cast<SNDFILE*>(file)); }

Result<WavWriter> WavWriter::create(const std::filesystem::path& path) {
  SF_INFO info{};
  info.samplerate = kSampleRate;
  info.channels = 1;
  info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
  SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
  if (file == nullptr) return fail(path.string() + ": " + sf_strerror(nullptr));
  sf_command(file, SFC_SET_UPDATE_HEADER_AUTO, nullptr, SF_TRUE);
  return WavWriter{path.string(), file};
}

Result<void> WavWriter::write(std::span<const std::int16_t> samples) {
  auto* file = static_cast<SNDFILE*>(file_.get());
  const auto count = static_cast<sf_count_t>(samples.size());
  if (sf_write_short(file, samples.data(), count) != count) return fail(name_ + ": " + sf_strerror(file));
  return {};
}

}  // namespace docent::interaction
