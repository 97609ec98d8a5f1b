#include "docent/pictures/figure.h"

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "docent/base/files.h"
#include "docent/pictures/map_picture.h"

namespace docent::pictures {
namespace {

namespace fs = std::filesystem;

class FigureTest : public testing::Test {
 protected:
  FigureTest() { fs::create_directories(folder_); }
  ~FigureTest() override { fs::remove_all(folder_); }
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::string saved(const Figure& figure, const std::string& name) const {
    const auto written = figure.save(path(name));
    EXPECT_TRUE(written) << written.error().message;
    const auto bytes = read_file(path(name));
    return bytes ? *bytes : "";
  }
  fs::path folder_ = fs::temp_directory_path() / ("docent_figure_" + std::to_string(getpid()));
};

Figure drawn() {
  Figure figure{"Hall, 0 to 90 s"};
  Axes& axes = figure.add(Axes::metres({0.0, 0.0}, {40.0, 20.0}, 300.0));
  const Point2 way[] = {{5.0, 5.0}, {35.0, 5.0}};
  draw_path(axes, way, 2.0, colors::kRed);
  axes.set_color_bar({"speed [m/s]", heat, 0.0, 1.0, false});
  figure.add_legend(legend_line("trajectory", 2.0, colors::kRed));
  figure.add_legend(legend_disc("goal", 6.0, colors::kGreen));
  return figure;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// Letters drawn in an SVG: each is a use of an outline.
std::size_t letters(const std::string& svg) { return count(svg, "<use xlink:href=\"#glyph"); }

/// The words of a PDF, by poppler.
std::string words_of(const fs::path& pdf) {
  const std::string command = "pdftotext -raw '" + pdf.string() + "' -";
  FILE* pipe = popen(command.c_str(), "r");
  std::string words;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) words += buffer.data();
  std::replace(words.begin(), words.end(), '\n', ' ');  // of text that is turned every word has a line
  EXPECT_EQ(pclose(pipe), 0) << command;
  return words;
}

TEST_F(FigureTest, TheExtensionSaysTheFormat) {
  EXPECT_EQ(saved(drawn(), "a.svg").substr(0, 5), "<?xml");
  EXPECT_EQ(saved(drawn(), "a.pdf").substr(0, 5), "%PDF-");
  EXPECT_EQ(saved(drawn(), "a.png").substr(1, 3), "PNG");
}

TEST_F(FigureTest, RefusesOtherExtensionsAndFoldersThatAreNotThere) {
  for (const char* name : {"a.jpg", "a", "png", "a.PNG", "svg.webp"}) {
    const auto refused = drawn().save(path(name));
    ASSERT_FALSE(refused) << name;
    EXPECT_NE(
        refused.error().message.find(std::string{name} + ": the name of a picture must end in .svg, .pdf or .png"),
        std::string::npos)
        << refused.error().message;
    EXPECT_FALSE(fs::exists(path(name)));
  }
  for (const char* place : {"/nowhere/at/all.png", "/nowhere/at/all.svg"}) {
    const auto refused = drawn().save(place);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find(place), std::string::npos);
  }
}

TEST_F(FigureTest, APdfHasItsWords) {
  ASSERT_TRUE(drawn().save(path("a.pdf")));
  const std::string words = words_of(path("a.pdf"));
  for (const char* word : {"Hall, 0 to 90 s", "x [m]", "y [m]", "speed [m/s]", "trajectory", "goal", "0.5", "40", "20"})
    EXPECT_NE(words.find(word), std::string::npos) << word << " in\n" << words;
}

TEST_F(FigureTest, AnSvgHasItsWordsAsOutlinesAndInItsDescription) {
  Figure figure = drawn();
  const std::string before = saved(figure, "a.svg");
  for (const char* word : {"<title>Hall, 0 to 90 s</title>", "x [m], y [m], speed [m/s]", "Legend: trajectory, goal"})
    EXPECT_NE(before.find(word), std::string::npos) << word;
  figure.add_legend(legend_disc("hazard & co", 6.0, colors::kGreen));
  const std::string after = saved(figure, "a.svg");
  EXPECT_EQ(letters(after), letters(before) + std::string{"hazard & co"}.size());
  EXPECT_NE(after.find("hazard &amp; co"), std::string::npos);
  // Labels with their units, ticks of both axes and of the bar, title, legend.
  const std::string ticks =
      "010203040"
      "01020"
      "0.00.51.0";
  EXPECT_EQ(letters(before), ticks.size() + std::string{"x [m]y [m]speed [m/s]Hall, 0 to 90 strajectorygoal"}.size());
}

TEST_F(FigureTest, LinesAreVectorsAndMapsAreBitmaps) {
  EXPECT_EQ(count(saved(drawn(), "a.svg"), "<image"), 1U);  // the colour bar
  Figure figure = drawn();
  OccupancyGrid map;
  map.frame = {40, 20, 1.0, {0.0, 0.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  draw_map(figure.add(Axes::metres(map.frame)), map);
  EXPECT_EQ(count(saved(figure, "b.svg"), "<image"), 2U);
}

TEST_F(FigureTest, TheSameFigureIsTheSameFile) {
  for (const char* name : {"a.pdf", "a.png"}) EXPECT_EQ(saved(drawn(), name), saved(drawn(), name)) << name;
  EXPECT_NE(saved(drawn(), "a.pdf").find("/CreationDate (19700101"), std::string::npos);
}

TEST_F(FigureTest, APngIsTheRasterPixelForPixel) {
  const Image raster = drawn().raster();
  EXPECT_EQ(raster.width(), static_cast<int>(kPixelsPerPoint * drawn().size().x));
  EXPECT_EQ(raster.height(), static_cast<int>(kPixelsPerPoint * drawn().size().y));
  const std::string bytes = saved(drawn(), "a.png");
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()), 0);
  header.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(header));
  ASSERT_NE(png_image_finish_read(&header, nullptr, read.data(), 0, nullptr), 0);
  EXPECT_EQ(read, std::vector<std::uint8_t>(raster.bytes().begin(), raster.bytes().end()));
}

TEST_F(FigureTest, NothingIsDrawnOverTheFrame) {
  Figure figure{""};
  Axes& axes = figure.add(Axes::metres({0.0, 0.0}, {10.0, 10.0}, 100.0));
  const Point2 way[] = {{-50.0, 5.0}, {50.0, 5.0}};
  draw_path(axes, way, 4.0, colors::kRed);
  const Image image = figure.raster();
  int red = 0;
  for (int x = 0; x < image.width(); ++x) {
    bool is_red = false;
    for (int y = 0; y < image.height(); ++y) is_red = is_red || image.at(x, y) == colors::kRed;
    red += is_red ? 1 : 0;
  }
  EXPECT_NEAR(red, 100 * kPixelsPerPoint, 4.0);
}

TEST_F(FigureTest, RowsLegendAndTitleTakeTheirRoom) {
  Figure figure{""};
  figure.add(Axes::metres({0.0, 0.0}, {10.0, 10.0}, 100.0));
  const Point2 one = figure.size();
  figure.add(Axes::metres({0.0, 0.0}, {10.0, 10.0}, 100.0));
  EXPECT_GT(figure.size().x, one.x + 100.0);
  EXPECT_EQ(figure.size().y, one.y);
  figure.add(Axes::metres({0.0, 0.0}, {10.0, 10.0}, 100.0), true);
  EXPECT_GT(figure.size().y, one.y + 100.0);
  const Point2 before = figure.size();
  for (int i = 0; i < 12; ++i) figure.add_legend(legend_line("an entry", 1.0, colors::kRed));
  EXPECT_EQ(figure.size().x, before.x);  // in rows
  EXPECT_GT(figure.size().y, before.y + 25.0);
}

}  // namespace
}  // namespace docent::pictures
