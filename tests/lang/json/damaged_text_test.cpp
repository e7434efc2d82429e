#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "lang/json/json.hpp"
#include "lang/report/report.hpp"

// Reading a damaged text always ends.
namespace sdlc::lang {
namespace {

class Counter final : public ObjectSink {
 public:
  void add(const Object& /*object*/) override { ++count; }
  std::size_t count = 0;
};

constexpr std::string_view kConfig = R"({"background": [0, 127.5, 1e2],
"camera": {"look_from": [0, 0, 0], "look_at": [0, 0, -1], "up": [0, 1, 0], "vfov": 90, "focal_length": 1,
  "aspect_ratio": 1.5, "viewport_height": 2, "samples_per_pixel": 4, "time_interval": [0, 1]},
"rendering": {"width": 60, "render_depth": 8, "in_parallel": true, "number_cores": 0},
"saving": {"path": "out\u00e9/é.png", "gamma_correct": null},
"spheres": [
  {"origin": [0, 0, -2], "radius": 1, "material": {"type": "diffuse", "color": [9, 9, 9]}},
  {"material": {"type": "specular", "color": [9, 9, 9], "fuzz": 0.5}, "radius": 2, "origin": [1, -2, 3],
   "movement": [[1, 0, 0], 0, 5]}
]})";

/// Reads the text; returns the number of errors.
std::size_t read(std::string text, std::initializer_list<MessageFormat> formats = {}) {
  const SourceFile file("config.json", std::move(text));
  Counter objects;
  DiagnosticSink sink;
  read_config(file, objects, sink);
  for (const auto format : formats) render_diagnostics(sink, {.format = format, .color = true});
  return sink.error_count();
}

constexpr auto kFormats = {MessageFormat::Human, MessageFormat::Concise, MessageFormat::Json};

TEST(DamagedText, NothingIsWrongWithTheWhole) { EXPECT_EQ(read(std::string(kConfig)), 0u); }

TEST(DamagedText, EveryBeginningHasAnError) {
  for (std::size_t size = 0; size < kConfig.size(); ++size) {
    EXPECT_GT(read(std::string(kConfig.substr(0, size)), kFormats), 0u)
        << "of the first " << size << " bytes";
  }
}

TEST(DamagedText, EveryByteMayBeMissing) {
  for (std::size_t i = 0; i < kConfig.size(); ++i)
    read(std::string(kConfig).erase(i, 1), {MessageFormat::Human});
}

TEST(DamagedText, EveryByteMayBeAnother) {
  constexpr std::string_view kBytes("{}[]\",:'\\/#*-.0e9nNtu \n\t\x01\x7F\x80\xC3\xE2\xEF\xFF\0",
                                    32);
  for (std::size_t i = 0; i < kConfig.size(); ++i) {
    for (const char byte : kBytes) {
      std::string text(kConfig);
      text[i] = byte;
      read(std::move(text));
    }
  }
}

TEST(DamagedText, RunsOfBytesMayBeSwappedAndRepeated) {
  std::uint32_t state = 1;
  const auto random = [&](std::size_t below) {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) % below;
  };
  for (int round = 0; round < 2000; ++round) {
    std::string text(kConfig);
    for (std::size_t cut = 0; cut < 1 + random(6); ++cut) {
      const std::size_t from = random(text.size());
      const std::string run = text.substr(from, random(40));
      text.insert(random(text.size()), run);
    }
    read(std::move(text), {MessageFormat::Human});
  }
}

TEST(DamagedText, AMillionBracketsAreTooDeep) {
  for (const std::string_view unit : {"[", "{\"a\":", "[{\"spheres\":"}) {
    std::string text = "{\"spheres\": ";
    for (int i = 0; i < 1'000'000; ++i) text += unit;
    // One for the depth, one for the first value that is not allowed in a sphere.
    EXPECT_EQ(read(std::move(text), kFormats), 2u) << unit;
  }
}

TEST(DamagedText, ALongLineOfMistakesIsReadOnce) {
  for (const std::string_view unit : {"(", "1 ", "a ", "\"a\" ", "'", "\"a\": (", "#", ":", ";",
                                      "(1, ", "a\" ", "? ", "\"a ", "x)"}) {
    for (const std::string_view begin : {"{", "{\"a\": ", "{\"a\": ["}) {
      std::string text(begin);
      while (text.size() < 200'000) text += unit;
      EXPECT_GT(read(std::move(text)), 0u) << begin << unit;
    }
  }
}

TEST(DamagedText, AMillionMistakesAreCounted) {
  std::string text = "{\"spheres\": [";
  for (int i = 0; i < 1'000'000; ++i) text += "+1,";
  EXPECT_EQ(read(text + "{}]}"), 2'000'000u + 3 + 3);
}

}  // namespace
}  // namespace sdlc::lang
