#include "docent/interaction/voice/voice_recognizer.h"

#include <pocketsphinx.h>
#include <samplerate.h>

#include <array>
#include <map>
#include <utility>

#include "docent/base/random.h"
#include "docent/interaction/voice/pronunciation.h"

namespace docent::interaction {
namespace {

constexpr int kHeardRate = 16'000;  // [Hz] of the model
constexpr const char* kCommandSearch = "commands";
constexpr const char* kAnyPhonemes = "phonemes";

struct FreeConfig {
  void operator()(cmd_ln_t* config) const { cmd_ln_free_r(config); }
};
struct FreeDecoder {
  void operator()(ps_decoder_t* decoder) const { ps_free(decoder); }
};

/// The samples at kHeardRate.
constexpr double kHiss = 2e-4;  // -74 dB of full scale

Result<std::vector<std::int16_t>> heard_samples(const Clip& clip) {
  const double ratio = static_cast<double>(kHeardRate) / kSampleRate;
  Clip resampled(static_cast<std::size_t>(static_cast<double>(clip.size()) * ratio) + 1);
  SRC_DATA data{};
  data.data_in = clip.data();
  data.input_frames = static_cast<long>(clip.size());
  data.data_out = resampled.data();
  data.output_frames = static_cast<long>(resampled.size());
  data.src_ratio = ratio;
  if (const int fault = src_simple(&data, SRC_SINC_FASTEST, 1); fault != 0) return fail(src_strerror(fault));
  resampled.resize(static_cast<std::size_t>(data.output_frames_gen));
  std::vector<std::int16_t> samples;
  samples.reserve(resampled.size());
  // A file's silence may be all zeros, which sound like nothing that the model knows: microphones have a little noise.
  Rng hiss{1};
  for (const float sample : resampled)
    samples.push_back(to_pcm(static_cast<double>(sample) + kHiss * hiss.uniform(-1.0, 1.0)));
  return samples;
}

}  // namespace

const char* to_text(HeardVoice::Verdict verdict) {
  constexpr std::array<const char*, 3> kWords{"nothing", "perhaps", "understood"};
  return kWords.at(static_cast<std::size_t>(verdict));
}

struct VoiceRecognizer::Decoder {
  std::unique_ptr<cmd_ln_t, FreeConfig> config;
  std::unique_ptr<ps_decoder_t, FreeDecoder> decoder;  ///< goes first
  std::map<std::string, std::string> word_of;          ///< of the tokens that stand for another word

  struct Path {
    std::string words;
    std::int32_t score = 0;
    int frames = 0;
  };
  Result<Path> best_path(const char* search, const std::vector<std::int16_t>& samples) {
    ps_decoder_t* const ps = decoder.get();
    if (ps_set_search(ps, search) < 0 || ps_start_utt(ps) < 0) return fail("PocketSphinx does not listen");
    const int read = ps_process_raw(ps, samples.data(), samples.size(), FALSE, TRUE);
    if (ps_end_utt(ps) < 0 || read < 0) return fail("PocketSphinx cannot hear this");
    Path path;
    const char* words = ps_get_hyp(ps, &path.score);
    if (words != nullptr) path.words = words;
    path.frames = ps_get_n_frames(ps);
    return path;
  }

  /// Teaches the words that the dictionary lacks.
  Result<std::map<std::string, std::string>> teach(const std::vector<std::string>& words) {
    std::map<std::string, std::string> token_of;
    std::vector<std::string> unknown;
    for (const std::string& word : words) {
      char* known = ps_lookup_word(decoder.get(), word.c_str());
      if (known == nullptr) unknown.push_back(word);
      ckd_free(known);
    }
    const auto sounds = pronounce(unknown);
    if (!sounds) return tl::unexpected(sounds.error());
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      std::string token = "unwritten" + std::to_string(i);
      if (ps_add_word(decoder.get(), token.c_str(), sounds->at(i).c_str(), i + 1 == unknown.size() ? TRUE : FALSE) < 0)
        return fail("'" + unknown[i] + "' sounds like '" + sounds->at(i) + "', which PocketSphinx does not take");
      word_of[token] = unknown[i];
      token_of[unknown[i]] = std::move(token);
    }
    return token_of;
  }
};

VoiceRecognizer::VoiceRecognizer(VoiceGrammar grammar, const VoiceParams& params, std::unique_ptr<Decoder> decoder)
    : grammar_{std::move(grammar)}, params_{params}, decoder_{std::move(decoder)} {}
VoiceRecognizer::VoiceRecognizer(VoiceRecognizer&&) noexcept = default;
VoiceRecognizer& VoiceRecognizer::operator=(VoiceRecognizer&&) noexcept = default;
VoiceRecognizer::~VoiceRecognizer() = default;

Result<VoiceRecognizer> VoiceRecognizer::create(VoiceGrammar grammar, const VoiceParams& params) {
  const std::filesystem::path folder = params.model;
  const std::string sounds = (folder / "en-us").string();
  const std::string dictionary = (folder / "cmudict-en-us.dict").string();
  const std::string any = (folder / "en-us-phone.lm.bin").string();
  for (const std::string& file : {sounds, dictionary, any})
    if (!std::filesystem::exists(file)) return fail(file + " does not exist: install pocketsphinx-en-us");
  const std::string weight = std::to_string(params.grammar_weight);
  auto decoder = std::make_unique<Decoder>();
  // Silence is left in: where it is taken out, so are the first sounds of short commands.
  decoder->config.reset(cmd_ln_init(nullptr, ps_args(), TRUE, "-hmm", sounds.c_str(), "-dict", dictionary.c_str(),
                                    "-logfn", "/dev/null", "-lw", weight.c_str(), "-allphone_ci", "yes", "-maxhmmpf",
                                    "3000", "-remove_silence", "no", nullptr));
  if (!decoder->config) return fail("PocketSphinx does not take its settings");
  decoder->decoder.reset(ps_init(decoder->config.get()));
  if (!decoder->decoder) return fail(sounds + ": PocketSphinx cannot read the model");
  const auto tokens = decoder->teach(grammar.words());
  if (!tokens) return tl::unexpected(tokens.error());
  if (ps_set_jsgf_string(decoder->decoder.get(), kCommandSearch, grammar.jsgf(*tokens).c_str()) < 0)
    return fail("PocketSphinx does not take the grammar of commands");
  if (ps_set_allphone_file(decoder->decoder.get(), kAnyPhonemes, any.c_str()) < 0)
    return fail(any + ": PocketSphinx cannot read it");
  return VoiceRecognizer{std::move(grammar), params, std::move(decoder)};
}

Result<HeardVoice> VoiceRecognizer::hear(const Clip& utterance) {
  HeardVoice heard;
  if (duration_s(utterance) < params_.shortest_s || duration_s(utterance) > params_.longest_s) return heard;
  const auto samples = heard_samples(utterance);
  if (!samples) return tl::unexpected(samples.error());
  const auto commands = decoder_->best_path(kCommandSearch, *samples);
  if (!commands) return tl::unexpected(commands.error());
  if (commands->words.empty() || commands->frames == 0) return heard;
  const auto anything = decoder_->best_path(kAnyPhonemes, *samples);
  if (!anything) return tl::unexpected(anything.error());
  std::vector<std::string> words = said_words(commands->words);
  for (std::string& word : words) {
    if (const auto known = decoder_->word_of.find(word); known != decoder_->word_of.end()) word = known->second;
    heard.words += (heard.words.empty() ? "" : " ") + word;
  }
  heard.confidence = static_cast<double>(commands->score - anything->score) / commands->frames;
  heard.command = grammar_.command_of(words);
  if (!heard.command) return heard;
  heard.verdict = heard.confidence > params_.acts_above   ? HeardVoice::Verdict::understood
                  : heard.confidence > params_.asks_above ? HeardVoice::Verdict::perhaps
                                                          : HeardVoice::Verdict::nothing;
  return heard;
}

}  // namespace docent::interaction
