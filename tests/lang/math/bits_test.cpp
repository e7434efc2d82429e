#include <bit>
#include <cmath>
#include <cstdint>
#include <ostream>

#include <gtest/gtest.h>

#include "lang/math/elementary.hpp"
#include "lang/math/random.hpp"
#include "tests/lang/math/arguments.hpp"

// The bits of the results are part of the language: a picture may not depend on compiler,
// optimisation or machine. A changed hash means a changed language.
namespace sdlc::lang {
namespace {

/// FNV-1a (Fowler, Noll, Vo), over the bytes of each double, the lowest first.
class BitHash {
 public:
  void add(double value) noexcept {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int shift = 0; shift < 64; shift += 8) {
      hash_ = (hash_ ^ ((bits >> shift) & 0xff)) * 0x100000001b3u;
    }
  }
  std::uint64_t value() const noexcept { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

struct FixedBits {
  const char* function;
  double (*next)(Arguments& arguments);
  std::uint64_t hash;

  friend void PrintTo(const FixedBits& fixed, std::ostream* out) { *out << fixed.function; }
};

double angle(Arguments& a) {
  const double x = a.between(-720, 720);
  return a.between(0, 1) < 0.7 ? x : a.of_any_size_and_sign(-1074, 1022);
}
double sine(Arguments& a) {
  const double x = a.between(-1, 1);
  return a.between(0, 1) < 0.7 ? x : a.of_any_size_and_sign(-1074, -1);
}
double moderate(Arguments& a) { return a.of_any_size_and_sign(-40, 8); }
double any(Arguments& a) { return a.of_any_size_and_sign(-1074, 1022); }

class Bits : public testing::TestWithParam<FixedBits> {};

TEST_P(Bits, AreThoseOfEveryCompilerAndMachine) {
  Arguments arguments;
  BitHash hash;
  for (int i = 0; i < 100000; ++i) hash.add(GetParam().next(arguments));
  EXPECT_EQ(hash.value(), GetParam().hash) << std::hex << "0x" << hash.value();
}

// Arguments are drawn one per statement: the order within a call would be up to the compiler.
INSTANTIATE_TEST_SUITE_P(
    , Bits,
    testing::Values(
        FixedBits{"sin", [](Arguments& a) { return sin_degrees(angle(a)); }, 0x3c37ef77f5ab03f8},
        FixedBits{"cos", [](Arguments& a) { return cos_degrees(angle(a)); }, 0x41a6e49511482dc3},
        FixedBits{"tan", [](Arguments& a) { return tan_degrees(angle(a)).value_or(0); },
                  0xcf40278f5047b774},
        FixedBits{"asin", [](Arguments& a) { return asin_degrees(sine(a)).value(); },
                  0xc4e17c5fdecd79f1},
        FixedBits{"acos", [](Arguments& a) { return acos_degrees(sine(a)).value(); },
                  0xaac3709ccfdd49c1},
        FixedBits{"atan", [](Arguments& a) { return atan_degrees(any(a)); }, 0x59f67b8de0728e41},
        FixedBits{"atan2",
                  [](Arguments& a) {
                    const double y = moderate(a);
                    return atan2_degrees(y, moderate(a)).value();
                  },
                  0xfda1bbbba5498c38},
        FixedBits{"exp", [](Arguments& a) { return exp(a.between(-745, 709)); },
                  0xefd762334663d65e},
        FixedBits{"log", [](Arguments& a) { return log(a.of_any_size(-1074, 1022)).value(); },
                  0x2e7136273959fb29},
        FixedBits{"power",
                  [](Arguments& a) {
                    const double x = a.of_any_size(-20, 20);
                    return power(x, a.between(-60, 60));
                  },
                  0xef280af6b71382e5},
        FixedBits{"raise",
                  [](Arguments& a) {
                    const double x = a.between(-8, 8);
                    return raise(x, std::floor(a.between(-20, 20))).value();
                  },
                  0x9e7d5b47a5b06d5d},
        FixedBits{"radians", [](Arguments& a) { return radians_from_degrees(any(a)); },
                  0xd8d68256ce1905c8},
        FixedBits{"degrees", [](Arguments& a) { return degrees_from_radians(any(a)); },
                  0xb16451a2f6944728},
        FixedBits{"round", [](Arguments& a) { return round_half_away(moderate(a)); },
                  0xdedb547205cc4cd9},
        FixedBits{"modulo",
                  [](Arguments& a) {
                    const double x = any(a);
                    return modulo(x, any(a)).value();
                  },
                  0x7217c1d103030272},
        FixedBits{"random", [](Arguments& a) { return RandomHash().add_number(any(a)).uniform(); },
                  0x9218c7801d58a2aa},
        FixedBits{"noise",
                  [](Arguments& a) {
                    const double x = moderate(a), y = moderate(a), z = moderate(a);
                    return noise({x, y, z});
                  },
                  0x2ccf414dc92294a2}),
    [](const auto& test) { return test.param.function; });

}  // namespace
}  // namespace sdlc::lang
