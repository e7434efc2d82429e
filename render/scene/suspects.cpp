#include "render/scene/suspects.hpp"

#include <algorithm>
#include <bit>

namespace sdlc::render {
namespace {

// Spheres are entered in the cells of a grid of centres and radii: each in its own and in those
// within the tolerance of it, so that two that coincide have a cell in common. One that is alone in
// its cells coincides with none. Which hashes of cells occur twice is found with a table of a few
// bits a sphere, which stays in the cache, while all else is read from front to back: sorting a
// million spheres by their coordinates takes fifteen times as long.

// A cell is 2^-26 of the radius wide. That is far more than the tolerance, so that few spheres are
// in two cells, and far less than spheres are apart, so that few share one.
constexpr int kCellBits = 26;
// The tolerance in cells, which are at least 2^-27 of a radius wide, twice for what rounding adds.
constexpr double kReach = kCoincidenceTolerance * (1 << (kCellBits + 2));
// Where cells begin, in cells: far from the simple fractions that scenes are full of.
constexpr double kShift = 0.118033988749895;

constexpr int kMantissaBits = 52;
constexpr std::uint64_t kExponentBias = 1023;

/// Along one axis, the cells of a number less and plus the tolerance: neighbours, and nearly always
/// one and the same. What is between the two numbers is in one of these cells, for every step to a
/// cell keeps the order of numbers, rounding included.
struct Cells {
  std::uint64_t low, high;

  bool differ() const { return low != high; }
};

/// Along the radius a cell is a range of the bits of a double: it grows with the radius.
Cells cells_of_radius(double radius) {
  constexpr int kWidthBits = kMantissaBits - kCellBits;
  constexpr auto kReachBits = static_cast<std::uint64_t>(kReach * (1 << kWidthBits));
  constexpr auto kShiftBits = static_cast<std::uint64_t>(kShift * (1 << kWidthBits));
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(radius) + kShiftBits;
  return {(bits - kReachBits) >> kWidthBits, (bits + kReachBits) >> kWidthBits};
}

/// How many cells along x, y and z there are to a unit of length: a power of two.
double cells_per_unit(std::uint64_t cell_of_radius) {
  // For radii below 2^-997 there is no such double, and cells are wider.
  const std::uint64_t exponent = std::max<std::uint64_t>(cell_of_radius >> kCellBits, kCellBits);
  return std::bit_cast<double>((2 * kExponentBias + kCellBits - exponent) << kMantissaBits);
}

Cells cells_of_coordinate(double coordinate, double cells_per_unit) {
  constexpr double kRounder = 0x1.8p52;  // what is added to it is rounded to a whole number
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

/// Which hashes have been added more than once, and some others that fall together with them.
class RepeatedHashes {
 public:
  /// `factor` is odd and decides which hashes fall together.
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
  static constexpr std::size_t kSlotsPerHash = 8;  // up to twice as many; of two bits
  static constexpr int kWordBits = 5;              // slots in a word, as a power of two

  std::uint32_t slot_of(std::uint32_t hash) const { return (hash * factor_) >> (32 - slot_bits_); }
  static std::uint32_t bit_of(std::uint32_t slot) { return slot % (1 << kWordBits) * 2; }

  int slot_bits_;
  std::uint32_t factor_;
  std::vector<std::uint64_t> words_;
};

}  // namespace

std::vector<std::uint32_t> find_suspects(const std::vector<Sphere>& spheres) {
  std::vector<Entry> entries = enter_all(spheres);
  // About a tenth remains each time, and in the end those whose hashes are equal.
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
