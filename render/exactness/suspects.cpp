#include "render/exactness/suspects.hpp"

#include <algorithm>
#include <bit>

namespace sdlc::render {
namespace {

// Spatial hashing: spheres are entered in the cells of a grid over centres and radii, each in its
// own cell and in those within the tolerance, so that two coincident spheres share a cell. A sphere
// that is alone in its cells coincides with no other. Repeated hashes are found with a table of a
// few bits per sphere, which stays in the cache, while everything else is read sequentially:
// sorting a million spheres by their coordinates takes fifteen times as long.

// A cell is 2^-26 of the radius wide: far more than the tolerance, so that few spheres are in two
// cells, and far less than the distance between distinct spheres, so that few share one.
constexpr int kCellBits = 26;
// The tolerance in cells. Cells are at least 2^-27 of a radius wide; doubled for rounding.
constexpr double kReach = kCoincidenceTolerance * (1 << (kCellBits + 2));
// The offset of the grid, in cells: far from the simple fractions that are common in scenes.
constexpr double kShift = 0.118033988749895;

constexpr int kMantissaBits = 52;
constexpr std::uint64_t kExponentBias = 1023;

/// The cells of a coordinate minus and plus the tolerance: adjacent cells, nearly always the same
/// one. Everything between the two numbers is in one of these cells, because every step of the
/// mapping is monotonic, including rounding.
struct Cells {
  std::uint64_t low, high;

  bool differ() const { return low != high; }
};

/// For radii a cell is a range of the bits of a double, so its width grows with the radius.
Cells cells_of_radius(double radius) {
  constexpr int kWidthBits = kMantissaBits - kCellBits;
  constexpr auto kReachBits = static_cast<std::uint64_t>(kReach * (1 << kWidthBits));
  constexpr auto kShiftBits = static_cast<std::uint64_t>(kShift * (1 << kWidthBits));
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(radius) + kShiftBits;
  return {(bits - kReachBits) >> kWidthBits, (bits + kReachBits) >> kWidthBits};
}

/// The number of cells per unit of length along x, y and z: a power of two.
double cells_per_unit(std::uint64_t cell_of_radius) {
  // Below a radius of 2^-997 there is no such double, and cells are wider.
  const std::uint64_t exponent = std::max<std::uint64_t>(cell_of_radius >> kCellBits, kCellBits);
  return std::bit_cast<double>((2 * kExponentBias + kCellBits - exponent) << kMantissaBits);
}

Cells cells_of_coordinate(double coordinate, double cells_per_unit) {
  constexpr double kRounder = 0x1.8p52;  // adding this rounds to an integer
  const double place = coordinate * cells_per_unit;
  return {std::bit_cast<std::uint64_t>(place + (kShift - kReach) + kRounder),
          std::bit_cast<std::uint64_t>(place + (kShift + kReach) + kRounder)};
}

std::uint32_t hash_of(std::uint64_t radius, std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  const std::uint64_t sum = radius * 0xD6E8FEB86659FD93 + x * 0xA0761D6478BD642F +
                            y * 0xE7037ED1A0B428DB + z * 0x8EBC6AF09C88C6E3;
  return static_cast<std::uint32_t>(((sum ^ sum >> 32) * 0x9E3779B97F4A7C15) >> 32);
}

/// A sphere and one of its cells.
struct Entry {
  std::uint32_t sphere;
  std::uint32_t hash;  ///< of the cell
};

void enter(const Vec3& center, std::uint64_t radius, std::uint32_t sphere,
           std::vector<Entry>& entries) {
  const double scale = cells_per_unit(radius);
  const Cells x = cells_of_coordinate(center.x, scale);
  const Cells y = cells_of_coordinate(center.y, scale);
  const Cells z = cells_of_coordinate(center.z, scale);
  const int differing = x.differ() | y.differ() << 1 | z.differ() << 2;
  for (int corner = 0; corner <= differing; ++corner) {
    if ((corner & ~differing) != 0) continue;
    entries.push_back({sphere, hash_of(radius, corner & 1 ? x.high : x.low,
                                       corner & 2 ? y.high : y.low, corner & 4 ? z.high : z.low)});
  }
}

std::vector<Entry> enter_all(const std::vector<Sphere>& spheres) {
  std::vector<Entry> entries;
  entries.reserve(spheres.size() + spheres.size() / 64);
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    const Cells radius = cells_of_radius(spheres[i].radius);
    enter(spheres[i].center, radius.low, i, entries);
    if (radius.differ()) enter(spheres[i].center, radius.high, i, entries);
  }
  return entries;
}

/// A set of the hashes that were added more than once; like a Bloom filter, it may contain others
/// that collide with them.
class RepeatedHashes {
 public:
  /// `factor` is odd and decides which hashes collide.
  RepeatedHashes(std::size_t hashes, std::uint32_t factor)
      : slot_bits_(
            std::clamp(static_cast<int>(std::bit_width(hashes * kSlotsPerHash)), kWordBits, 32)),
        factor_(factor),
        words_(std::size_t{1} << (slot_bits_ - kWordBits)) {}

  void add(std::uint32_t hash) {
    const std::uint32_t slot = slot_of(hash);
    std::uint64_t& word = words_[slot >> kWordBits];
    const std::uint64_t once = std::uint64_t{1} << bit_of(slot);
    word |= once | (word & once) << 1;
  }

  bool contains(std::uint32_t hash) const {
    const std::uint32_t slot = slot_of(hash);
    return (words_[slot >> kWordBits] >> bit_of(slot) & 2) != 0;
  }

 private:
  static constexpr std::size_t kSlotsPerHash = 8;  // up to twice as many, of two bits each
  static constexpr int kWordBits = 5;              // slots per word, as a power of two

  std::uint32_t slot_of(std::uint32_t hash) const { return (hash * factor_) >> (32 - slot_bits_); }
  static std::uint32_t bit_of(std::uint32_t slot) { return slot % (1 << kWordBits) * 2; }

  int slot_bits_;
  std::uint32_t factor_;
  std::vector<std::uint64_t> words_;
};

}  // namespace

std::vector<std::uint32_t> find_suspects(const std::vector<Sphere>& spheres) {
  std::vector<Entry> entries = enter_all(spheres);
  // Each round keeps about a tenth; in the end only entries with equal hashes remain.
  std::uint32_t factor = 0x9E3779B1;
  std::size_t before;
  do {
    before = entries.size();
    RepeatedHashes repeated(before, factor);
    for (const Entry& entry : entries) repeated.add(entry.hash);
    std::erase_if(entries, [&](const Entry& entry) { return !repeated.contains(entry.hash); });
    factor *= 0x85EBCA77;
  } while (entries.size() < before / 2);

  std::vector<std::uint32_t> suspects;
  for (const Entry& entry : entries) {
    if (suspects.empty() || suspects.back() != entry.sphere) suspects.push_back(entry.sphere);
  }
  return suspects;
}

}  // namespace sdlc::render
