#include <algorithm>
#include <cctype>
#include <fstream>
#include <string>

#include "docent/grid/map_image.h"

namespace docent {
namespace {

/// Netpbm's PGM. Its header is read with any line ends: where they are those of Windows, two bytes end it.
class PgmImage final : public MapImage {
 public:
  explicit PgmImage(const std::filesystem::path& path) : file_{path, std::ios::binary}, name_{path.string()} {
    std::error_code code;
    bytes_ = std::filesystem::file_size(path, code);
    if (code) bytes_ = 0;
  }

  Result<void> open() {
    take();
    is_text_ = take() == '2';
    constexpr const char* kNoNumber = "not a PGM image: expected a number in the header";
    if (!read_number(header.width) || !read_number(header.height)) return fault(kNoNumber);
    if (header.width <= 0 || header.height <= 0 || header.width > kMostOnASide || header.height > kMostOnASide)
      return fault("PGM of " + std::to_string(header.width) + " x " + std::to_string(header.height) + " pixels");
    long white = 0;
    if (!read_number(white)) return fault(kNoNumber);
    if (white <= 0 || white > 65535) return fault("PGM with a white of " + std::to_string(white));
    header.white = static_cast<std::uint32_t>(white);
    sample_ = white > 255 ? 2 : 1;
    const auto count = static_cast<std::uintmax_t>(header.width) * static_cast<std::uintmax_t>(header.height);
    if (is_text_) {
      if (rest() < count) return fault("PGM ends early");
      return {};
    }
    const std::uintmax_t wanted = count * sample_;
    const bool has_lines_of_windows = lines_of_windows_ > 0;
    if (file_.peek() == '#') pass_comment();  // its line end is the white space behind the header
    const int end = take();                   // the one white space behind the header
    if (has_lines_of_windows && end == '\r' && rest() > wanted && file_.peek() == '\n')
      take();
    else if (rest() > wanted && file_.peek() == '#')
      pass_late_comments(rest() - wanted);
    else if (rest() > wanted)
      pass_white_space(rest() - wanted);
    if (rest() < wanted)
      return fault("PGM ends early: " + std::to_string(wanted) + " bytes of pixels expected, " +
                   std::to_string(rest()) + " found");
    const std::uintmax_t more = rest() - wanted;
    if (more > 2)  // a line end is nothing to speak of
      header.note = "the file is " + std::to_string(more) + " bytes longer than its header says; they are left out";
    return {};
  }

  Result<void> read_row(std::vector<std::uint32_t>& shades) override {
    shades.resize(static_cast<std::size_t>(header.width));
    if (is_text_) {
      for (auto& shade : shades) {
        long number = 0;
        if (!read_number(number) || number > static_cast<long>(header.white))
          return fault("PGM ends early or holds a value above its white");
        shade = static_cast<std::uint32_t>(number);
      }
      if (long number = 0; ++rows_ == header.height && read_number(number))
        header.note = "the file holds more pixels than its header says; they are left out";
      return {};
    }
    row_.resize(shades.size() * sample_);
    if (!file_.read(row_.data(), static_cast<std::streamsize>(row_.size()))) return fault("PGM ends early");
    const auto byte = [&](std::size_t k) { return static_cast<std::uint32_t>(static_cast<unsigned char>(row_[k])); };
    for (std::size_t i = 0; i < shades.size(); ++i) {
      shades[i] = sample_ == 1 ? byte(i) : byte(2 * i) << 8U | byte(2 * i + 1);
      if (shades[i] > header.white)
        return fault("PGM holds a value above its white: " + std::to_string(shades[i]) + " where white is " +
                     std::to_string(header.white));
    }
    return {};
  }

 private:
  static constexpr long kMostOnASide = 1'000'000;
  static constexpr long kMostOfANumber = 1'000'000'000;  ///< what is larger is taken for it, and too large for all uses
  static constexpr std::uintmax_t kMostWhiteSpace = 4;   ///< [bytes]

  [[nodiscard]] tl::unexpected<Error> fault(const std::string& what) const {
    return fail(name_ + ":" + std::to_string(line_) + ": " + what);
  }
  [[nodiscard]] std::uintmax_t rest() const { return bytes_ - std::min(bytes_, at_); }
  int take() {
    const int c = file_.get();
    if (c == std::char_traits<char>::eof()) return c;
    ++at_;
    if (c == '\r' && file_.peek() == '\n') ++lines_of_windows_;
    if (c == '\n' || (c == '\r' && file_.peek() != '\n')) ++line_;
    return c;
  }
  /// Some programs end the header with more than one white space, as Windows' line ends do. That they are no pixels
  /// shows in the file's size, if nothing stands behind the pixels.
  void pass_white_space(std::uintmax_t most) {
    if (most > kMostWhiteSpace) return;
    const auto here = file_.tellg();
    std::uintmax_t count = 0;
    for (; count < most && std::isspace(file_.peek()) != 0; ++count) take();
    file_.clear();
    const bool is_header = count == most && !ends_in_white_space();
    if (count == most && !is_header)
      header.note = "its header may end in more than one white space: if all is shifted by a pixel, save it anew";
    if (is_header) return;
    file_.seekg(here);
    at_ -= count;
  }
  /// A comment, without the end of its line.
  void pass_comment() {
    for (int c = file_.peek(); c != '\n' && c != '\r' && c != std::char_traits<char>::eof(); c = file_.peek()) take();
  }
  /// Some programs write a comment behind the header's last line, where the pixels begin. That it is none of them shows
  /// in the file's size: exactly its lines are too much.
  void pass_late_comments(std::uintmax_t most) {
    const auto here = file_.tellg();
    const std::uintmax_t at = at_;
    const long line = line_;
    while (at_ - at < most && file_.peek() == '#') {
      while (at_ - at < most && file_.peek() != '\n') take();
      if (at_ - at < most) take();
    }
    file_.clear();
    file_.seekg(-1, std::ios::cur);
    if (at_ - at == most && file_.get() == '\n') {
      header.note = "a comment stands behind its header, where the pixels begin: it is left out";
      return;
    }
    file_.clear();
    file_.seekg(here);
    at_ = at;
    line_ = line;
  }
  [[nodiscard]] bool ends_in_white_space() {
    const auto here = file_.tellg();
    file_.seekg(-1, std::ios::end);
    const bool is_space = std::isspace(file_.peek()) != 0;
    file_.seekg(here);
    return is_space;
  }
  /// The next number, behind white space and comments; a comment ends with its line.
  bool read_number(long& number) {
    for (int c = file_.peek(); c == '#' || std::isspace(c) != 0; c = file_.peek()) {
      if (c == '#')
        pass_comment();
      else
        take();
    }
    number = 0;
    bool found = false;
    while (std::isdigit(file_.peek()) != 0) {
      number = std::min(number * 10 + (take() - '0'), kMostOfANumber);
      found = true;
    }
    return found;
  }

  std::ifstream file_;
  const std::string name_;
  std::uintmax_t bytes_ = 0, at_ = 0;
  long line_ = 1, lines_of_windows_ = 0;  ///< that end in CR LF
  long rows_ = 0;                         ///< that were read
  bool is_text_ = false;
  std::size_t sample_ = 1;  ///< [bytes]
  std::string row_;
};

}  // namespace

Result<std::unique_ptr<MapImage>> open_pgm(const std::filesystem::path& path) {
  auto image = std::make_unique<PgmImage>(path);
  if (auto opened = image->open(); !opened) return tl::unexpected<Error>(opened.error());
  return image;
}

}  // namespace docent
