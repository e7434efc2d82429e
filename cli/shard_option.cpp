#include "cli/shard_option.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "cli/whole_number.hpp"
#include "lang/text/display_width.hpp"
#include "render/film/picture_record.hpp"

namespace sdlc::cli {
namespace {

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) {
    throw ArgumentError("--shard", fmt::format("takes I/N, such as 1/8 for the first of eight, "
                                               "not `{}`",
                                               lang::printable(text)));
  }
  const auto number = [](const std::string& digits, std::uint64_t highest) {
    return static_cast<std::uint32_t>(
        parse_whole_number("--shard", digits, {.lowest = 1, .highest = highest}));
  };
  const std::uint32_t count = number(text.substr(slash + 1), render::kMaxShards);
  return {.index = number(text.substr(0, slash), count), .count = count};
}

}  // namespace

void add_shard_options(Command& command, std::optional<Shard>& shard,
                       std::optional<ShardBy>& shard_by) {
  command
      .add_text(
          "--shard", [&shard](const std::string& text) { shard = parse_shard(text); },
          "Render only the I-th of N parts; `sdlc merge` joins those of a picture")
      .type_name("I/N");
  command
      .add_text(
          "--shard-by",
          [&shard_by](const std::string& word) {
            const auto found = std::ranges::find(kShardByWords, word);
            shard_by = static_cast<ShardBy>(found - kShardByWords.begin());
          },
          "What --shard divides; default: frames if there are as many as shards, else samples if "
          "there are 256 per shard and pixel, else tiles")
      .one_of(kShardByWords);
}

}  // namespace sdlc::cli
