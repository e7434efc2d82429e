#include "render/film/merge_films.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <random>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/render/film/traced_film.hpp"

namespace sdlc::render {
namespace {

using test::content_of;
using test::traced_film;
using testing::ElementsAre;

constexpr std::uint32_t kAll = 0xFFFFFFC0, kBlock = SampleSum::kBlock;

std::vector<Film> merged(const std::vector<Film>& films) {
  std::vector<const Film*> parts;
  for (const Film& film : films) parts.push_back(&film);
  return merge_films(std::move(parts));
}

/// Random numbers in a range, the same on every machine.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(engine_()) % end; }
  template <typename T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) {
      std::swap(items[i - 1], items[below(static_cast<std::uint32_t>(i))]);
    }
  }

 private:
  std::minstd_rand engine_;
};

/// Part of a picture: pixels and samples of each replicate.
struct Box {
  std::uint32_t first_pixel, end_pixel, first_sample, end_sample;
};

/// Cuts a random box of several in two, up to `count` boxes.
std::vector<Box> random_boxes(Random& random, std::uint32_t pixels, std::uint32_t blocks,
                              std::size_t count) {
  std::vector<Box> boxes{{0, pixels, 0, kAll}};
  for (int attempt = 0; attempt < 50 && boxes.size() < count; ++attempt) {
    Box& box = boxes[random.below(static_cast<std::uint32_t>(boxes.size()))];
    Box other = box;
    if (random.below(2) == 0) {
      box.end_pixel = other.first_pixel =
          box.first_pixel + random.below(box.end_pixel - box.first_pixel);
      if (box.end_pixel == box.first_pixel) {
        box.end_pixel = other.end_pixel;
        continue;
      }
    } else {
      const std::uint32_t at = kBlock * (1 + random.below(blocks));
      if (at <= box.first_sample || at >= box.end_sample) continue;
      box.end_sample = other.first_sample = at;
    }
    boxes.push_back(other);
  }
  return boxes;
}

/// Joins films pairwise or several at once, in random order.
std::vector<Film> joined_randomly(Random& random, std::vector<Film> films) {
  while (films.size() > 1) {
    random.shuffle(films);
    const auto count = 2 + random.below(static_cast<std::uint32_t>(films.size()) - 1);
    std::vector<Film> some;
    std::move(films.end() - count, films.end(), std::back_inserter(some));
    films.erase(films.end() - count, films.end());
    std::ranges::move(merged(some), std::back_inserter(films));
  }
  return films;
}

TEST(MergeFilms, GivesTheBitsOfARenderAtOnceHoweverItWasCut) {
  constexpr std::uint32_t kPixels = 23, kBlocks = 12;
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    std::vector<std::uint32_t> totals;  // as of an adaptive render in every other round
    const std::uint32_t uniform = 8 + random.below(4 * kBlocks * kBlock);
    for (std::uint32_t i = 0; i < kPixels; ++i) {
      totals.push_back(seed % 2 == 0 ? uniform : 8 + random.below(4 * kBlocks * kBlock));
    }
    const Film expected = traced_film({.pixels = kPixels}, totals);
    std::vector<Film> films;
    for (const Box& box : random_boxes(random, kPixels, kBlocks, 1 + random.below(9))) {
      films.push_back(traced_film({.first_pixel = box.first_pixel,
                                   .pixels = box.end_pixel - box.first_pixel,
                                   .first_sample = box.first_sample},
                                  totals, box.end_sample));
    }
    // A film alone is merged too: it drops what has no samples.
    const std::vector<Film> whole = merged(joined_randomly(random, std::move(films)));
    ASSERT_EQ(whole.size(), 1u) << seed;
    ASSERT_EQ(content_of(whole[0]), content_of(expected)) << seed;
    EXPECT_EQ(whole[0].mean(3), expected.mean(3));
  }
}

TEST(MergeFilms, KeepsPartsApartWhoseSamplesLackOthersBetween) {
  const std::vector<std::uint32_t> totals(4, 4 * 10 * kBlock);
  std::vector<Film> films;
  films.push_back(traced_film({.pixels = 4}, totals, 2 * kBlock));
  films.push_back(traced_film({.pixels = 4, .first_sample = 5 * kBlock}, totals));
  films = merged(films);
  ASSERT_EQ(films.size(), 2u);
  EXPECT_EQ(films[0].count(0, 0), 2 * kBlock);
  EXPECT_EQ(films[1].extent().first_sample, 5 * kBlock);
  films.push_back(traced_film({.pixels = 4, .first_sample = 2 * kBlock}, totals, 5 * kBlock));
  films = merged(films);
  ASSERT_EQ(films.size(), 1u);
  EXPECT_EQ(content_of(films[0]), content_of(traced_film({.pixels = 4}, totals)));
}

// A film that ends within a block has no neighbour: the next block is not whole without the rest.
TEST(MergeFilms, KeepsPartsApartAfterABlockThatIsNotWhole) {
  const std::vector<std::uint32_t> some(2, 4 * 100), all(2, 4 * 256);
  std::vector<Film> films;
  films.push_back(traced_film({.pixels = 2}, some));
  films.push_back(traced_film({.pixels = 2, .first_sample = 2 * kBlock}, all));
  EXPECT_EQ(merged(films).size(), 2u);
}

TEST(MergeFilms, RefusesASampleThatTwoFilmsHave) {
  const std::vector<std::uint32_t> totals(10, 4 * 3 * kBlock);
  std::vector<Film> films;
  films.push_back(traced_film({.pixels = 6}, totals));
  films.push_back(traced_film({.first_pixel = 5, .pixels = 5, .first_sample = kBlock}, totals));
  try {
    merged(films);
    FAIL() << "not refused";
  } catch (const DoubledSample& doubled) {
    EXPECT_EQ(doubled.pixel(), 5u);
    EXPECT_EQ(doubled.sample(), kBlock);
  }
  films[1] = traced_film({.pixels = 6}, totals);
  EXPECT_THROW(merged(films), DoubledSample);
}

TEST(MergeFilms, RefusesADoubledSampleBehindAGap) {
  std::vector<Film> films;
  const auto add = [&](std::uint32_t first_sample, const ReplicateCounts& counts) {
    Film& film = films.emplace_back(FilmExtent{.pixels = 1, .first_sample = first_sample});
    test::trace_samples(film, std::vector<ReplicateCounts>{counts});
  };
  add(0, {4 * kBlock, kBlock});
  add(2 * kBlock, {0, kBlock});  // a gap in the second replicate
  EXPECT_EQ(merged(films).size(), 2u);
  add(3 * kBlock, {kBlock});
  EXPECT_THROW(merged(films), DoubledSample);
}

TEST(MergeFilms, JoinsFilmsOfOneReplicate) {
  std::vector<Film> films;
  for (const std::uint64_t first : {2u, 0u}) {
    Film& film = films.emplace_back(
        FilmExtent{.first_pixel = first, .pixels = 2, .first_sample = 0, .replicates = 1});
    const std::vector<ReplicateCounts> counts(2, ReplicateCounts{5});
    test::trace_samples(film, counts);
  }
  const std::vector<Film> whole = merged(films);
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].extent(), (FilmExtent{.pixels = 4, .replicates = 1}));
  EXPECT_EQ(whole[0].mean(3), films[0].mean(1));
}

TEST(MergeFilms, DropsPixelsWithoutSamples) {
  const std::vector<std::uint32_t> totals{0, 0, 8, 0, 9, 0};
  std::vector<Film> films;
  films.push_back(traced_film({.pixels = 6}, totals));
  const std::vector<Film> whole = merged(films);
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].extent(), (FilmExtent{.first_pixel = 2, .pixels = 3}));
  EXPECT_THAT(merged({}), testing::IsEmpty());
}

}  // namespace
}  // namespace sdlc::render
