#include "docent/museum/editing/museum_workshop.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <system_error>
#include <utility>

#include "docent/base/files.h"
#include "docent/base/yaml.h"

namespace docent::museum {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOriginal = "original.txt";  // in a trial: whose it is
constexpr const char* kBefore = "museum.yaml.before";
constexpr const char* kPictures = "pictures";
constexpr std::size_t kMostPictures = 200;  // that were sent; a museum of 50 exhibits with some changes

Result<void> failed(const fs::path& path, const std::error_code& why) {
  return fail(path.string() + ": " + why.message());
}

/// FNV-1a of 64 bits: tells one text from the next, not from a forger's.
std::string revision_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
  return digits.data();
}

std::string sentence_of(const Error& fault) {
  const std::string& text = fault.message;
  const auto file = text.find(kMuseumFile);
  if (file == std::string::npos) return text;
  const auto end = text.find(": ", file);
  return end == std::string::npos ? text : text.substr(end + 2);
}

}  // namespace

std::vector<std::string> sentences_of(const std::vector<Error>& faults) {
  std::vector<std::string> sentences;
  for (const Error& fault : faults) sentences.push_back(sentence_of(fault));
  return sentences;
}

MuseumWorkshop::MuseumWorkshop(fs::path folder, fs::path trial, const CheckedRobot& robot, Stage stage)
    : folder_{std::move(folder)}, trial_{std::move(trial)}, published_{folder_}, robot_{robot}, stage_{stage} {
  std::error_code error;
  if (!fs::equivalent(folder_, trial_, error) || error) return;
  auto original = read_file(trial_ / kOriginal);
  if (!original) return;
  is_trial_ = true;
  published_ = *original;
}

Result<MuseumWorkshop::Published> MuseumWorkshop::read_published() const {
  auto yaml = read_file(published_ / kMuseumFile);
  if (!yaml) return tl::unexpected<Error>(yaml.error());
  const auto file = YamlFile::parse(*yaml, kMuseumFile);
  if (!file) return tl::unexpected<Error>(file.error());
  std::string all = *yaml;
  (void)read_museum(*file, [&](const fs::path& relative) {
    auto text = read_file(published_ / relative);
    if (text) all += '\0' + *text;
    return text;
  });
  return Published{std::move(*yaml), revision_of(all)};
}

Result<MuseumWorkshop::Edition> MuseumWorkshop::read() const {
  const auto published = read_published();
  if (!published) return tl::unexpected<Error>(published.error());
  auto file = YamlFile::load(folder_ / kMuseumFile);
  if (!file) return tl::unexpected<Error>(file.error());
  auto source = read_museum(*file, [this](const fs::path& relative) { return read_file(folder_ / relative); });
  if (!source.faults.empty()) return tl::unexpected<Error>(source.faults.front());
  return Edition{std::move(source.museum), published->revision};
}

Result<EditedMuseum> MuseumWorkshop::edit(const std::string& yaml, const MuseumDraft& draft) const {
  return edit_museum(
      yaml, [this](const fs::path& relative) { return read_file(published_ / relative); }, draft);
}

Result<void> MuseumWorkshop::lay_out(const fs::path& where, const FolderFiles& files) const {
  std::error_code error;
  fs::remove_all(where, error);
  fs::create_directories(where, error);
  if (error) return failed(where, error);
  const fs::path original = fs::absolute(published_, error);
  for (auto entry = fs::recursive_directory_iterator{original, error}; !error && entry != fs::end(entry);
       entry.increment(error)) {
    const fs::path relative = entry->path().lexically_relative(original);
    if (entry->is_directory()) {
      fs::create_directories(where / relative, error);
    } else if (!files.contains(relative)) {
      fs::create_symlink(entry->path(), where / relative, error);
    }
    if (error) break;
  }
  if (error) return failed(where, error);
  for (const auto& [relative, content] : files) {
    fs::create_directories((where / relative).parent_path(), error);
    if (auto written = write_file_atomically(where / relative, content); !written) return written;
  }
  return write_file_atomically(where / kOriginal, original.string());
}

Result<std::vector<std::string>> MuseumWorkshop::check(const fs::path& where, const MuseumDraft& draft) const {
  const auto published = read_published();
  if (!published) return tl::unexpected<Error>(published.error());
  auto edited = edit(published->yaml, draft);
  if (!edited) return tl::unexpected<Error>(edited.error());
  if (!edited->faults.empty()) return sentences_of(edited->faults);
  if (auto laid = lay_out(where, edited->files); !laid) return tl::unexpected<Error>(laid.error());
  return sentences_of(check_museum(where, robot_, stage_));
}

Result<std::vector<std::string>> MuseumWorkshop::check(const MuseumDraft& draft) const {
  const fs::path where = trial_.string() + ".check";
  auto faults = check(where, draft);
  std::error_code ignored;
  fs::remove_all(where, ignored);
  return faults;
}

Result<MuseumWorkshop::Outcome> MuseumWorkshop::try_out(const MuseumDraft& draft, const std::string& revision) const {
  const auto before = read_published();
  if (!before) return tl::unexpected<Error>(before.error());
  if (before->revision != revision) return Outcome{{}, true};
  // Laid out beside the trial first: the robot may be in that.
  const fs::path where = trial_.string() + ".next";
  auto faults = check(where, draft);
  if (!faults) return tl::unexpected<Error>(faults.error());
  std::error_code error;
  if (!faults->empty()) {
    fs::remove_all(where, error);
    return Outcome{std::move(*faults), false};
  }
  fs::remove_all(trial_, error);
  fs::rename(where, trial_, error);
  if (error) return tl::unexpected<Error>(failed(trial_, error).error());
  return Outcome{};
}

Result<MuseumWorkshop::Outcome> MuseumWorkshop::publish(const MuseumDraft& draft, const std::string& revision) const {
  const auto before = read_published();
  if (!before) return tl::unexpected<Error>(before.error());
  if (before->revision != revision) return Outcome{{}, true};
  auto faults = check(draft);
  if (!faults) return tl::unexpected<Error>(faults.error());
  if (!faults->empty()) return Outcome{std::move(*faults), false};
  auto edited = edit(before->yaml, draft);
  if (!edited) return tl::unexpected<Error>(edited.error());
  auto written = write_file_atomically(published_ / kBefore, before->yaml);
  for (const auto& [relative, content] : edited->files) {
    if (!written) break;
    std::error_code error;
    fs::create_directories((published_ / relative).parent_path(), error);
    if (relative != kMuseumFile) written = write_file_atomically(published_ / relative, content);
  }
  // Last: it names the texts.
  const auto museum = edited->files.find(kMuseumFile);
  if (written && museum != edited->files.end())
    written = write_file_atomically(published_ / kMuseumFile, museum->second);
  if (!written) return tl::unexpected<Error>(written.error());
  return Outcome{};
}

Result<fs::path> MuseumWorkshop::keep_picture(const std::string& content, const std::string& ending) const {
  const fs::path folder = published_ / kPictures;
  const fs::path relative = fs::path{kPictures} / (revision_of(content) + ending);
  if (const auto there = read_file(published_ / relative); there && *there == content) return relative;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return tl::unexpected<Error>(failed(folder, error).error());
  std::vector<fs::path> kept;
  for (auto entry = fs::directory_iterator{folder, error}; !error && entry != fs::end(entry); entry.increment(error))
    kept.push_back(entry->path());
  if (error) return tl::unexpected<Error>(failed(folder, error).error());
  if (kept.size() >= kMostPictures) {
    const std::string named =
        read_file(published_ / kMuseumFile).value_or("") + read_file(published_ / kBefore).value_or("");
    std::erase_if(kept, [&](const fs::path& picture) {
      const bool is_shown = named.find(picture.filename().string()) != std::string::npos;
      return !is_shown && fs::remove(picture, error);
    });
    if (kept.size() >= kMostPictures)
      return fail(folder.string() + ": more than " + std::to_string(kMostPictures) + " pictures");
  }
  if (auto written = write_file_atomically(published_ / relative, content); !written)
    return tl::unexpected<Error>(written.error());
  return relative;
}

}  // namespace docent::museum
