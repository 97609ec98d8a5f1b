#include "docent/telepresence/site.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>

namespace docent::telepresence {
namespace {

class SiteTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("docent-site-" + std::to_string(::getpid()) + "-" +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_ / "page/assets");
    std::filesystem::create_directories(folder_ / "audio");
    write("page/index.html", "<p>hello");
    write("page/kiosk.html", "<p>touch");
    write("page/assets/index-1a2b.js", "1;");
    write("audio/0a1b.wav", "RIFF");
    write("audio/0a1b.ogg", "OggS");
    write("audio/secret.txt", "secret");
    write("secret.wav", "secret");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const { std::ofstream{folder_ / name} << text; }
  std::filesystem::path folder_;
};

TEST_F(SiteTest, ServesThePage) {
  Site site;
  ASSERT_TRUE(site.load_page(folder_ / "page"));
  EXPECT_EQ(*site.get("/").body, "<p>hello");
  EXPECT_EQ(*site.get("/?lang=de").body, "<p>hello");
  EXPECT_EQ(site.get("/index.html").content_type, "text/html; charset=utf-8");
  EXPECT_EQ(*site.get("/kiosk").body, "<p>touch");
  EXPECT_EQ(site.get("/kiosk").content_type, "text/html; charset=utf-8");
  EXPECT_FALSE(site.get("/").is_immutable);
  const auto script = site.get("/assets/index-1a2b.js");
  EXPECT_EQ(script.status, 200);
  EXPECT_EQ(script.content_type, "text/javascript; charset=utf-8");
  EXPECT_TRUE(script.is_immutable);
}

/// What a browser makes of a gzip body.
std::string unzipped(const std::string& packed) {
  z_stream stream{};
  inflateInit2(&stream, 15 + 16);
  std::string text(1 << 20, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return text;
}

TEST_F(SiteTest, WhatCompressesIsHeldCompressedToo) {
  std::string script;
  for (int i = 0; i < 500; ++i) script += "export const value" + std::to_string(i) + " = " + std::to_string(i) + ";\n";
  write("page/assets/long-3c4d.js", script);
  Site site;
  ASSERT_TRUE(site.load_page(folder_ / "page"));
  const auto reply = site.get("/assets/long-3c4d.js");
  EXPECT_EQ(*reply.body, script);
  ASSERT_TRUE(reply.gzipped);
  EXPECT_LT(reply.gzipped->size(), script.size() / 3);
  EXPECT_EQ(unzipped(*reply.gzipped), script);
  EXPECT_FALSE(site.get("/").gzipped) << "so short a text only grows";

  site.set_document("/api/museum.json", "application/json", script);
  EXPECT_EQ(unzipped(*site.get("/api/museum.json").gzipped), script);
  std::string picture;
  std::uint32_t noise = 1;
  for (int i = 0; i < 5000; ++i) picture += static_cast<char>((noise = noise * 1664525 + 1013904223) >> 24U);
  site.set_document("/api/map.png", "image/png", picture);
  EXPECT_FALSE(site.get("/api/map.png").gzipped) << "what is compressed already is left alone";
}

TEST(AcceptsGzip, AsTheReaderSays) {
  for (const char* text : {"gzip", "gzip, deflate, br", "br;q=1.0, gzip;q=0.8, *;q=0.1", " deflate ,\tGZip", "x-gzip",
                           "*", "identity;q=0, *", "gzip ; q=0.001"}) {
    EXPECT_TRUE(accepts_gzip(text)) << text;
  }
  for (const char* text : {"", "identity", "br", "gzip;q=0", "gzip; q=0.000, *", "*;q=0", "gzipped",
                           "gzip;q=", "gzip;x", ",,;;", "gzip;q=0,br"}) {
    EXPECT_FALSE(accepts_gzip(text)) << text;
  }
}

TEST_F(SiteTest, NothingElseCanBeReached) {
  Site site;
  ASSERT_TRUE(site.load_page(folder_ / "page"));
  site.set_audio_folder(folder_ / "audio");
  EXPECT_EQ(site.get("/audio/0a1b.wav").status, 200);
  EXPECT_EQ(site.get("/audio/0a1b.wav").content_type, "audio/wav");
  EXPECT_EQ(site.get("/audio/0a1b.ogg").content_type, "audio/ogg");
  for (const char* target :
       {"/audio/secret.txt", "/audio/../secret.wav", "/audio/%2e%2e/secret.wav", "/audio/..%2fsecret.wav", "/audio/",
        "/audio/.wav", "/audio/0a1b.ogg.wav", "/audio/0a1b.flac", "/audio/0a1bogg", "/audio/0A1B.wav",
        "/audio/0a1b.wav/", "/audio//0a1b.wav", "/../secret.wav", "/assets/../../secret.wav", "/audio/ffff.wav", "",
        "index.html", "//"}) {
    EXPECT_EQ(site.get(target).status, 404) << target;
  }
  EXPECT_EQ(site.get({"/audio/0a1b.wav\0", 16}).status, 404);
  EXPECT_FALSE(is_audio_name(std::string(65, 'a') + ".wav"));
  EXPECT_FALSE(is_audio_name(std::string_view{"0a\0b.wav", 8}));
}

TEST_F(SiteTest, DocumentsAreReplacedAndLiveOnesMadeAnew) {
  Site site;
  site.set_document("/api/a", "text/plain", "one");
  site.set_document("/api/a", "text/plain", "two");
  EXPECT_EQ(*site.get("/api/a").body, "two");
  int count = 0;
  site.set_live_document("/api/b", "text/plain", [&count] { return std::to_string(++count); });
  EXPECT_EQ(*site.get("/api/b").body, "1");
  EXPECT_EQ(*site.get("/api/b").body, "2");
}

TEST_F(SiteTest, AMissingPageIsNamed) {
  Site site;
  const auto result = site.load_page(folder_ / "audio");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("index.html"), std::string::npos);
  EXPECT_FALSE(site.load_page(folder_ / "nowhere"));
}

}  // namespace
}  // namespace docent::telepresence
