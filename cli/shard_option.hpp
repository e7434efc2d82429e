#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "cli/command_line.hpp"

namespace sdlc::cli {

/// The part that this process renders: `index`, from 1, of `count`.
struct Shard {
  std::uint32_t index = 1, count = 1;
};

/// What is divided among shards.
enum class ShardBy : std::uint8_t { Frames, Samples, Tiles };
inline constexpr std::array<std::string_view, 3> kShardByWords{"frames", "samples", "tiles"};

/// Adds --shard and --shard-by.
void add_shard_options(Command& command, std::optional<Shard>& shard,
                       std::optional<ShardBy>& shard_by);

}  // namespace sdlc::cli
