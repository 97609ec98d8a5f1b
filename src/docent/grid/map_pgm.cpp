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
    long white = 0;
    for (long* number : {&header.width, &header.height, &white})
      if (!read_number(*number)) return fault("not a PGM image: expected a number in the header");
    if (header.width <= 0 || header.height <= 0 || header.width > kMostOnASide || header.height > kMostOnASide)
      return fault("PGM of " + std::to_string(header.width) + " x " + std::to_string(header.height) + " pixels");
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
    const int end = take();  // the one white space behind the header
    if (has_lines_of_windows && end == '\r' && rest() > wanted && file_.peek() == '\n')
      take();
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
  static constexpr std::uintmax_t kMostWhiteSpace = 4;  ///< [bytes]

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
        while (c != '\n' && c != '\r' && c != std::char_traits<char>::eof()) c = take();
      else
        take();
    }
    number = 0;
    bool found = false;
    while (std::isdigit(file_.peek()) != 0 && number < 100'000'000) {
      number = number * 10 + (take() - '0');
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
