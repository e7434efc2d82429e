#include "render/film/film_file.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/image/io_error.hpp"
#include "render/math/fnv.hpp"
#include "tests/render/film/traced_film.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::render {
namespace {

using test::content_of;
using test::traced_film;
using testing::HasSubstr;
using Reason = FilmError::Reason;

constexpr std::uint32_t kBlock = SampleSum::kBlock;

StoredFilm example(std::uint32_t first_sample = 0, std::uint32_t end_sample = 0xFFFFFFC0) {
  const std::vector<std::uint32_t> totals{8, 700, 4 * 256, 0, 12, 1000};
  const EmitterClasses::Class lamps{
      .sphere = 1, .radiance = 0.1, .kinds = {EmitterClasses::Chance::Possible}};
  EmitterClasses classes;
  classes.brightest = 0.1;
  classes.emitters = {1};
  classes.classes = {lamps};
  classes.of_spheres.assign(2, EmitterClasses::kNone);
  StoredFilm stored{
      .origin = {.scene = {.spheres = Digest{0xFEDCBA9876543210}},
                 .width = 3,
                 .height = 2,
                 .crop = {.x = 0, .y = 0, .width = 3, .height = 2},
                 .depth = 16,
                 .seed = 0xFFFFFFFFFFFFFFFF,
                 .sampler = SamplerKind::Independent,
                 .is_centred = false,
                 .replicates = kReplicates,
                 .has_first_hits = true,
                 .precision = Precision::Mixed,
                 .arithmetic = "fused",
                 .program = "sdlc 1.0"},
      .record = {.scene = "a b.scene",
                 .frame = -3,
                 .spheres = 2,
                 .features = "emissive motion",
                 .samples = 1000,
                 .error = 0.1,
                 .light_choice = "on, 1 light",
                 .exposure = 1.0 / 3,
                 .shards = 8,
                 .cut = ShardCut::Tiles},
      .shards = {first_sample == 0 ? 2u : 8u},
      .statistics = {.rays = 12345, .truncated_paths = 6, .nonfinite_samples = 1},
      .lights = {1, 5},
      .casters = {2},
      .exact_spheres = {7},
      .emitter_classes = classes,
      .emitters = {{.paths = 30, .enough = 30},
                   {.paths = 3, .enough = 30},
                   {.paths = 200, .enough = 255}},
      .targets = totals,
      .passes = {{.samples = 32, .from = 0.1, .to = 0.3, .estimate = 0.2, .is_blind = 1}},
      .films = {}};
  stored.films.push_back(
      traced_film({.pixels = 6, .first_sample = first_sample}, totals, end_sample));
  return stored;
}

void expect_equal(const StoredFilm& film, const StoredFilm& expected) {
  EXPECT_EQ(film.origin, expected.origin);
  EXPECT_EQ(film.record, expected.record);
  EXPECT_EQ(film.shards, expected.shards);
  EXPECT_EQ(film.emitter_classes.emitters, expected.emitter_classes.emitters);
  EXPECT_EQ(film.passes.size(), expected.passes.size());
  EXPECT_EQ(film.statistics, expected.statistics);
  EXPECT_EQ(film.lights, expected.lights);
  EXPECT_EQ(film.casters, expected.casters);
  EXPECT_EQ(film.exact_spheres, expected.exact_spheres);
  EXPECT_EQ(film.emitters, expected.emitters);
  EXPECT_EQ(film.targets, expected.targets);
  ASSERT_EQ(film.films.size(), expected.films.size());
  for (std::size_t i = 0; i < film.films.size(); ++i) {
    EXPECT_EQ(film.films[i].extent(), expected.films[i].extent());
    EXPECT_EQ(content_of(film.films[i]), content_of(expected.films[i]));
  }
}

class FilmFile : public testing::Test {
 protected:
  std::filesystem::path path(const std::string& name = "a.film") const { return folder_ / name; }

  std::string written(const StoredFilm& film) const {
    write_film_file(path(), film);
    return test::content_of(path());
  }
  StoredFilm read(const std::string& bytes) const {
    test::write_text(path("b.film"), bytes);
    return read_film_file(path("b.film"));
  }
  Reason refusal_of(const std::string& bytes) const {
    try {
      read(bytes);
    } catch (const FilmError& error) {
      EXPECT_THAT(error.what(), HasSubstr("b.film`: "));
      return error.reason();
    }
    ADD_FAILURE() << "not refused";
    return Reason::Damaged;
  }

  test::TemporaryFolder folder_;
};

TEST_F(FilmFile, IsReadAsItWasWritten) {
  StoredFilm film = example();
  film.films.push_back(traced_film({.first_pixel = 2, .pixels = 2, .first_sample = 64 * kBlock},
                                   std::vector<std::uint32_t>(4, 100 * 4 * kBlock)));
  const std::string bytes = written(film);
  expect_equal(read(bytes), film);
  EXPECT_EQ(written(read(bytes)), bytes);
}

TEST_F(FilmFile, TakesTheValuesOfTheFilmAndLittleMore) {
  StoredFilm film = example();
  film.films.clear();
  const std::size_t rest = written(film).size();
  const std::vector<std::uint32_t> totals(1000, 256);
  film.films.push_back(traced_film({.pixels = 1000}, totals));
  EXPECT_EQ(written(film).size() - rest,
            1000 * Film::bytes_per_pixel(256, Channels::ColorAndFirstHits) + 32 + 20);
}

TEST_F(FilmFile, IsRefusedIfAnyByteIsChanged) {
  const std::string bytes = written(example());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int flip : {0x01, 0x80, 0xFF}) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      const Reason reason = refusal_of(damaged);
      const Reason expected = i < 8    ? Reason::NotAFilm
                              : i < 12 ? Reason::OtherVersion
                                       : Reason::Damaged;
      ASSERT_EQ(reason, expected) << "byte " << i;
    }
  }
}

TEST_F(FilmFile, IsRefusedIfTwoOfItsFilmsHaveASample) {
  StoredFilm film = example(), again = example();
  film.films.push_back(std::move(again.films[0]));
  EXPECT_EQ(refusal_of(written(film)), Reason::Damaged);
}

TEST_F(FilmFile, IsRefusedIfItsNumbersAreImpossible) {
  const auto refusal = [&](const auto& change) {
    StoredFilm film = example();
    change(film);
    return refusal_of(written(film));
  };
  EXPECT_EQ(refusal([](StoredFilm& film) { film.origin.width = 0x80000000; }), Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) { film.origin.depth = 0; }), Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) { film.origin.crop.x = 1; }), Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) { film.origin.crop.width = -3; }), Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) {
              film.films.clear();
              film.origin.replicates = 3;
            }),
            Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) { film.emitters[1].paths = 31; }), Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) { film.emitters.pop_back(); }), Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) { film.emitter_classes.emitters = {2}; }),
            Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) { film.shards = {9}; }), Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) { film.passes[0].samples = 0; }), Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) { film.record.samples = -1; }), Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) { film.record.error = HUGE_VAL; }), Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) {
              film.films.clear();
              film.targets.clear();
              film.origin.width = film.origin.height = 40'000;
              film.origin.crop = {.x = 0, .y = 0, .width = 40'000, .height = 40'000};
            }),
            Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) {
              film.emitter_classes = {};
              film.emitter_classes.has_casters = true;
              film.emitters.assign(64, {.paths = 1, .enough = 30});
            }),
            Reason::Damaged);
  EXPECT_EQ(refusal([](StoredFilm& film) { film.record.shards = 0xFFFFFFFF; }), Reason::Damaged);
}

TEST_F(FilmFile, IsRefusedIfItIsCutOrLonger) {
  const std::string bytes = written(example());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Reason reason = refusal_of(bytes.substr(0, size));
    ASSERT_EQ(reason, size < 8 ? Reason::NotAFilm : Reason::Damaged) << size;
  }
  EXPECT_EQ(refusal_of(bytes + '\0'), Reason::Damaged);
  EXPECT_EQ(refusal_of(bytes + bytes), Reason::Damaged);
}

/// A section with its checksum.
std::string section(const std::string& tag, const std::string& content) {
  const std::uint64_t size = content.size();
  std::string text = tag;
  text.append(reinterpret_cast<const char*>(&size), sizeof(size));
  text += content;
  Fnv1a hash;
  hash.add(text);
  const std::uint64_t checksum = hash.value();
  text.append(reinterpret_cast<const char*>(&checksum), sizeof(checksum));
  return text;
}

TEST_F(FilmFile, MayHaveSectionsOfLaterVersions) {
  const std::string bytes = written(example());
  const std::string more = bytes.substr(0, 12) + section("news", "text") + bytes.substr(12);
  expect_equal(read(more), example());
}

TEST_F(FilmFile, HasNoSectionTwiceAndEachThatIsNeeded) {
  const std::string bytes = written(example());
  const std::string statistics = section("stat", std::string(24, '\0'));
  EXPECT_EQ(refusal_of(bytes.substr(0, 12) + statistics + bytes.substr(12)), Reason::Damaged);
  const std::string end = section("end ", "");
  EXPECT_EQ(refusal_of(bytes.substr(0, 12) + statistics + end), Reason::Damaged);
  EXPECT_EQ(refusal_of(bytes.substr(0, 12) + end), Reason::Damaged);
  EXPECT_EQ(refusal_of(bytes.substr(0, 12)), Reason::Damaged);
}

// Lengths that are too large must not be reserved before they are read.
TEST_F(FilmFile, AsksForNoMoreMemoryThanItHasBytes) {
  const std::string bytes = written(example());
  std::string extent(24, '\0');
  const std::uint64_t pixels = std::uint64_t{1} << 50;
  std::memcpy(extent.data() + 8, &pixels, sizeof(pixels));
  extent[20] = 4;
  EXPECT_EQ(refusal_of(bytes.substr(0, 12) + section("film", extent)), Reason::Damaged);
  const std::string huge = "lght" + std::string(7, '\xFF') + '\x0F';
  EXPECT_EQ(refusal_of(bytes.substr(0, 12) + huge + std::string(100, ' ')), Reason::Damaged);
}

TEST_F(FilmFile, HasARecordThatIsReadAlone) {
  write_film_file(path(), example());
  EXPECT_EQ(read_film_head(path()).record, example().record);
}

TEST_F(FilmFile, MustExist) {
  EXPECT_THROW(read_film_file(path("missing.film")), IoError);
  EXPECT_THROW(read_film_file(folder_.path()), IoError);
  EXPECT_THROW(write_film_file(folder_ / "no folder/a.film", example()), IoError);
}

TEST_F(FilmFile, AddsTheSamplesOfAnother) {
  StoredFilm whole = example(0, 2 * kBlock);
  add_film(whole, example(2 * kBlock), "b.film");
  StoredFilm expected = example();
  expected.statistics = {.rays = 24690, .truncated_paths = 12, .nonfinite_samples = 2};
  expected.emitters = {
      {.paths = 30, .enough = 30}, {.paths = 6, .enough = 30}, {.paths = 255, .enough = 255}};
  expected.shards = {2, 8};
  expect_equal(whole, expected);
}

TEST_F(FilmFile, RefusesToAddSamplesTwice) {
  StoredFilm film = example();
  try {
    add_film(film, example(2 * kBlock), "b.film");
    FAIL() << "not refused";
  } catch (const FilmError& error) {
    EXPECT_EQ(error.reason(), Reason::Doubled);
    EXPECT_STREQ(error.what(),
                 "`b.film`: the film has samples that another one has: sample 128 of the pixel at "
                 "(1, 0)");
  }
  expect_equal(film, example());
}

TEST_F(FilmFile, RefusesToAddAnotherPicture) {
  const auto refusal = [](auto change) -> std::string {
    StoredFilm into = example(0, 2 * kBlock), film = example(2 * kBlock);
    change(film);
    try {
      add_film(into, film, "b.film");
    } catch (const FilmError& error) {
      EXPECT_EQ(error.reason(), Reason::Foreign);
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal([](StoredFilm&) {}), "");
  EXPECT_EQ(refusal([](StoredFilm& film) { film.origin.depth = 8; }),
            "`b.film`: the film is of another picture: `depth` is 8, not 16");
  EXPECT_THAT(refusal([](StoredFilm& film) { film.origin.scene.camera = Digest{1}; }),
              HasSubstr("it differs in `camera`"));
  EXPECT_THAT(refusal([](StoredFilm& film) { film.origin.sampler = SamplerKind::Sobol; }),
              HasSubstr("`sampler` is sobol, not independent"));
  EXPECT_THAT(refusal([](StoredFilm& film) { film.origin.program = "sdlc 0.9"; }),
              HasSubstr("`program` is sdlc 0.9, not sdlc 1.0"));
  EXPECT_THAT(refusal([](StoredFilm& film) { film.lights.clear(); }), HasSubstr("lights"));
  EXPECT_THAT(refusal([](StoredFilm& film) { film.casters = {3}; }), HasSubstr("lights"));
  EXPECT_THAT(refusal([](StoredFilm& film) { film.exact_spheres = {8}; }), HasSubstr("in double"));
  EXPECT_THAT(refusal([](StoredFilm& film) { film.emitters.clear(); }), HasSubstr("emitters"));
  EXPECT_THAT(refusal([](StoredFilm& film) { film.targets.clear(); }), HasSubstr("samples"));
  EXPECT_THAT(refusal([](StoredFilm& film) { film.record.frame.reset(); }),
              HasSubstr("`frame` is -, not -3"));
  EXPECT_THAT(refusal([](StoredFilm& film) { film.record.exposure = 1; }),
              HasSubstr("`exposure` is 1, not 0.3333333333333333"));
  EXPECT_EQ(refusal([](StoredFilm& film) { film.record.scene = "c.scene"; }), "");
}

TEST_F(FilmFile, RefusesToAddAShardTwice) {
  StoredFilm film = example(0, 2 * kBlock), again = example(2 * kBlock);
  again.shards = {2};
  try {
    add_film(film, again, "b.film");
    FAIL() << "not refused";
  } catch (const FilmError& error) {
    EXPECT_EQ(error.reason(), Reason::Doubled);
    EXPECT_STREQ(error.what(), "`b.film`: another film has shard 2, too");
  }
}

TEST_F(FilmFile, KnowsTheShardsThatItLacks) {
  StoredFilm film = example();
  EXPECT_THAT(missing_shards(film), testing::ElementsAre(1, 3, 4, 5, 6, 7, 8));
  film.record.shards = 1;
  film.shards = {1};
  EXPECT_THAT(missing_shards(film), testing::IsEmpty());
}

}  // namespace
}  // namespace sdlc::render
