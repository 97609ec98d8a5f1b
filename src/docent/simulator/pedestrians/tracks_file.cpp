#include "docent/simulator/pedestrians/tracks_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "docent/base/files.h"
#include "docent/simulator/pedestrians/number_line.h"

namespace docent::simulator {
namespace {

constexpr double kFarthestPoint = 10'000.0;  // [m]; coordinates beyond it are a slip of the pen
constexpr double kLongest = 1e6;             // [s]

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), " %.3f", value);
  return text.data();
}

Result<Recording> parse_header(std::string_view rest) {
  const std::string_view name = rest.substr(0, rest.find(' '));
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_allowed)) {
    return fail("a recording's name is of small letters, digits, '-' and '_'");
  }
  const auto duration = numbers_of(rest.substr(name.size()));
  if (!duration) return tl::unexpected<Error>(duration.error());
  if (duration->size() != 1 || !(duration->front() > 0.0 && duration->front() <= kLongest)) {
    return fail("expected 'recording NAME DURATION' with a duration > 0 [s]");
  }
  return Recording{std::string{name}, duration->front(), {}};
}

Result<Track> parse_track(std::string_view rest, const Recording& recording) {
  const auto numbers = numbers_of(rest);
  if (!numbers) return tl::unexpected<Error>(numbers.error());
  if (numbers->size() < 5 || numbers->size() % 2 == 0)
    return fail("expected 'track START x y x y …', two points or more");
  Track track;
  track.start = numbers->front();
  for (std::size_t i = 1; i < numbers->size(); i += 2) {
    const Point2 point{(*numbers)[i], (*numbers)[i + 1]};
    if (std::abs(point.x) > kFarthestPoint || std::abs(point.y) > kFarthestPoint) return fail("too far away");
    track.points.push_back(point);
  }
  if (!(track.start >= 0.0) || track.end() > recording.duration + 1e-3) {
    return fail("the track does not lie within its recording's duration");
  }
  return track;
}

}  // namespace

std::string to_text(std::span<const Recording> recordings) {
  std::string text =
      "# People whom a camera followed, in the world's frame; metres, seconds, 0.4 s between two points.\n";
  for (const Recording& recording : recordings) {
    text += "recording " + recording.name + number(recording.duration) + '\n';
    for (const Track& track : recording.tracks) {
      text += "track" + number(track.start);
      for (const Point2 point : track.points) text += number(point.x) + number(point.y);
      text += '\n';
    }
  }
  return text;
}

Result<std::vector<Recording>> parse_tracks(std::string_view text, const std::string& name) {
  constexpr std::string_view kHeader = "recording ";
  constexpr std::string_view kTrack = "track ";
  std::vector<Recording> recordings;
  std::optional<Error> fault;
  for_each_line(text, [&](std::string_view line, std::size_t number) {
    std::string why;
    if (line.starts_with(kHeader)) {
      auto recording = parse_header(line.substr(kHeader.size()));
      if (recording) recordings.push_back(std::move(*recording));
      if (!recording) why = recording.error().message;
    } else if (line.starts_with(kTrack) && !recordings.empty()) {
      auto track = parse_track(line.substr(kTrack.size()), recordings.back());
      if (track) recordings.back().tracks.push_back(std::move(*track));
      if (!track) why = track.error().message;
    } else {
      why = "expected 'recording NAME DURATION', then lines 'track START x y x y …'";
    }
    if (!why.empty()) fault = Error{name + ":" + std::to_string(number) + ": " + why};
    return !fault;
  });
  if (fault) return tl::unexpected<Error>(*fault);
  return recordings;
}

Result<std::vector<Recording>> load_tracks(const std::filesystem::path& path) {
  auto text = read_file(path);
  if (!text) return tl::unexpected<Error>(text.error());
  return parse_tracks(*text, path.string());
}

}  // namespace docent::simulator
