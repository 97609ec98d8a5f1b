#include "docent/simulator/pedestrians/recording.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "docent/base/files.h"
#include "docent/simulator/pedestrians/number_line.h"

namespace docent::simulator {
namespace {

constexpr double kFarthestSighting = 1000.0;  // [m] from the recording's origin
constexpr double kLongestGap = 2.0;           // [s] that a straight line bridges
constexpr double kFastestMedian = 4.0;        // [m/s] of all people: else these are no metres
constexpr double kMostFrames = 1e7;           // of a recording: days
constexpr double kEdinburghPixel = 0.0247;    // [m]
constexpr double kEdinburghFrame = 1.0 / 9;   // [s]

/// Someone, seen once.
struct Sighting {
  double frame = 0.0;  ///< later: [s]
  Point2 position{};   ///< [m]
  std::size_t line = 0;
};
using Sightings = std::map<std::int64_t, std::vector<Sighting>>;  ///< by person

/// The sightings of a file and what is wrong with it.
struct Source {
  Sightings people;
  std::optional<Error> fault;

  /// @returns why this cannot be, empty when it can
  std::string add(double person, const Sighting& sighting) {
    if (std::abs(person) > 1e9 || person != std::floor(person)) return "a person is a whole number";
    const double frame = sighting.frame;
    if (!(frame >= 0.0 && frame <= kMostFrames && frame == std::floor(frame))) {
      return "a frame is a whole number of 0 to 10000000";
    }
    if (std::abs(sighting.position.x) > kFarthestSighting || std::abs(sighting.position.y) > kFarthestSighting) {
      return "a person is more than 1000 m away";
    }
    people[static_cast<std::int64_t>(person)].push_back(sighting);
    return {};
  }
};

Source read_columns(std::string_view text, const std::string& name) {
  Source source;
  std::size_t columns = 0;
  for_each_line(text, [&](std::string_view line, std::size_t number) {
    const auto numbers = numbers_of(line);
    std::string why;
    if (!numbers) {
      why = numbers.error().message;
    } else if (numbers->size() != 4 && numbers->size() != 8) {
      why = "expected 4 columns (frame, person, x, y) or the 8 of obsmat, not " + std::to_string(numbers->size());
    } else if (columns != 0 && numbers->size() != columns) {
      why =
          "the lines before have " + std::to_string(columns) + " columns, this one " + std::to_string(numbers->size());
    } else {
      columns = numbers->size();
      const std::vector<double>& n = *numbers;
      why = source.add(n[1], {n[0], {n[2], columns == 8 ? n[4] : n[3]}, number});
    }
    if (!why.empty()) source.fault = Error{name + ":" + std::to_string(number) + ": " + why};
    return !source.fault;
  });
  return source;
}

/// The numbers of `[[x y frame];[x y frame];…]`, brackets and semicolons read as blanks.
Result<std::vector<double>> edinburgh_numbers(std::string_view matrix) {
  std::string words{matrix};
  for (char& c : words) {
    if (c == '[' || c == ']' || c == ';') c = ' ';
  }
  return numbers_of(words);
}

Source read_edinburgh(std::string_view text, const std::string& name) {
  Source source;
  double person = 0.0;
  for_each_line(text, [&](std::string_view line, std::size_t number) {
    const std::size_t equals = line.find('=');
    if (!line.starts_with("TRACK.") || equals == std::string_view::npos) return true;  // properties, of no use here
    const auto numbers = edinburgh_numbers(line.substr(equals + 1));
    std::string why;
    if (!numbers) why = numbers.error().message;
    if (numbers && numbers->size() % 3 != 0) why = "expected [x y frame] again and again";
    for (std::size_t i = 0; why.empty() && i < numbers->size(); i += 3) {
      const std::vector<double>& n = *numbers;
      why = source.add(person, {n[i + 2], {kEdinburghPixel * n[i], -kEdinburghPixel * n[i + 1]}, number});
    }
    // The tracker now and then has someone at two places at a time.
    auto& seen = source.people[static_cast<std::int64_t>(person)];
    seen.erase(std::unique(seen.begin(), seen.end(), [](auto& a, auto& b) { return a.frame == b.frame; }), seen.end());
    ++person;
    if (!why.empty()) source.fault = Error{name + ":" + std::to_string(number) + ": " + why};
    return !source.fault;
  });
  return source;
}

/// The commonest difference of a person's successive frames; 0 when nobody was seen twice.
double commonest_step(const Sightings& people) {
  std::map<double, int> counts;
  for (const auto& [person, seen] : people) {
    for (std::size_t i = 1; i < seen.size(); ++i) ++counts[seen[i].frame - seen[i - 1].frame];
  }
  const auto more = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto best = std::max_element(counts.begin(), counts.end(), more);
  return best == counts.end() ? 0.0 : best->first;
}

/// Points every kTrackStep from the first sighting to the last; frames are seconds here.
Track resampled(const std::vector<Sighting>& seen, std::size_t first, std::size_t last) {
  Track track;
  track.start = seen[first].frame;
  std::size_t before = first;
  for (int i = 0;; ++i) {
    const double time = track.start + kTrackStep * i;
    if (time > seen[last].frame + 1e-6) break;
    while (before + 1 < last && seen[before + 1].frame <= time) ++before;
    const Sighting& a = seen[before];
    const Sighting& b = seen[before + 1];
    const double share = std::clamp((time - a.frame) / (b.frame - a.frame), 0.0, 1.0);
    track.points.push_back((1.0 - share) * a.position + share * b.position);
  }
  return track;
}

void add_tracks(const std::vector<Sighting>& seen, std::vector<Track>& tracks) {
  std::size_t first = 0;
  for (std::size_t i = 1; i <= seen.size(); ++i) {
    if (i < seen.size() && seen[i].frame - seen[i - 1].frame <= kLongestGap) continue;
    if (i - first >= 2) {
      Track track = resampled(seen, first, i - 1);
      if (track.points.size() >= 2) tracks.push_back(std::move(track));
    }
    first = i;
  }
}

double median_speed(const std::vector<Track>& tracks) {
  std::vector<double> speeds;
  for (const Track& track : tracks) {
    for (std::size_t i = 1; i < track.points.size(); ++i) {
      speeds.push_back(distance(track.points[i - 1], track.points[i]) / kTrackStep);
    }
  }
  const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
  std::nth_element(speeds.begin(), middle, speeds.end());
  return *middle;
}

}  // namespace

Result<Recording> parse_recording(std::string_view text, const std::string& name) {
  const bool is_edinburgh = text.find("TRACK.") != std::string_view::npos;
  Source source = is_edinburgh ? read_edinburgh(text, name) : read_columns(text, name);
  if (source.fault) return tl::unexpected<Error>(*source.fault);
  std::erase_if(source.people, [](const auto& one) { return one.second.empty(); });
  double begin = kMostFrames;
  for (auto& [person, seen] : source.people) {
    std::stable_sort(seen.begin(), seen.end(), [](const Sighting& a, const Sighting& b) { return a.frame < b.frame; });
    for (std::size_t i = 1; i < seen.size(); ++i) {
      if (seen[i].frame > seen[i - 1].frame) continue;
      return fail(name + ":" + std::to_string(seen[i].line) + ": person " + std::to_string(person) +
                  " is in two places at frame " + std::to_string(std::llround(seen[i].frame)));
    }
    begin = std::min(begin, seen.front().frame);
  }
  const double step = commonest_step(source.people);
  if (!(step > 0.0)) return fail(name + ": nobody was seen twice");
  const double seconds = is_edinburgh ? kEdinburghFrame : kTrackStep / step;
  Recording recording;
  for (auto& [person, seen] : source.people) {
    for (Sighting& sighting : seen) sighting.frame = seconds * (sighting.frame - begin);
    add_tracks(seen, recording.tracks);
  }
  if (recording.tracks.empty()) return fail(name + ": nobody was seen for two steps");
  if (const double speed = median_speed(recording.tracks); speed > kFastestMedian) {
    return fail(name + ": people walk at " + std::to_string(std::lround(speed)) + " m/s: these are no metres");
  }
  for (const Track& track : recording.tracks)
    recording.duration = std::max(recording.duration, track.end() + kTrackStep);
  return recording;
}

Result<Recording> load_recording(const std::filesystem::path& file_or_folder) {
  namespace fs = std::filesystem;
  std::error_code code;
  fs::path file = file_or_folder;
  if (fs::is_directory(file_or_folder, code)) {
    file = file_or_folder / "obsmat.txt";
    if (!fs::exists(file, code)) {
      std::vector<fs::path> texts;
      for (const auto& entry : fs::directory_iterator{file_or_folder, code}) {
        if (entry.path().extension() == ".txt") texts.push_back(entry.path());
      }
      if (texts.size() != 1) return fail(file_or_folder.string() + ": holds neither obsmat.txt nor just one .txt file");
      file = texts.front();
    }
  }
  const auto text = read_file(file);
  if (!text) return tl::unexpected<Error>(text.error());
  auto recording = parse_recording(*text, file.string());
  if (!recording) return recording;
  const fs::path named =
      fs::weakly_canonical(fs::is_directory(file_or_folder, code) ? file_or_folder : file.stem(), code);
  for (const char c : named.filename().string()) {
    const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const bool is_allowed = (small >= 'a' && small <= 'z') || (small >= '0' && small <= '9') || small == '_';
    recording->name += is_allowed ? small : '-';
  }
  return recording;
}

}  // namespace docent::simulator
