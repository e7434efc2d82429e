#include "lang/value/types.hpp"

#include <algorithm>
#include <array>

#include "lang/schema/type_names.hpp"

namespace sdlc::lang {
namespace {

template <typename T>
bool is(const Value& value) {
  return holds_alternative<T>(value);
}

bool is_list(const Value& value) { return elements_of(value) != nullptr; }

constexpr auto kTypes = std::to_array<TypeInfo>({
    {"number", is<Scalar>, "A number, with or without a unit: `3`, `20cm`, `15%`."},
    {"bool", is<bool>, "`true` or `false`."},
    {"string", is<std::string>, "A text: `\"ring.png\"`."},
    {"vec3", is<Triple>, "A point or direction: `(x, y, z)`."},
    {"angle", is<Angle>, "An angle: `40deg`, `0.5turn`, `1rad`."},
    {"angles", is<AngleTriple>, "Three angles: `(0deg, 30deg, 0deg)`."},
    {"color", is<render::LinearRgb>, "A colour: `red`, `#80b3ff`, `rgb(128, 179, 255)`."},
    {"interval", is<Bounds>, "From one number to another: `0s .. 20ms`."},
    {"list", is_list,
     "Values of one type: `[1, 2, 3]`, `range(10)`; or a row: `[\"Earth\", 1.5]`."},
    {"material", is<MaterialValue>, "A material: `diffuse(color: red)`."},
});

static_assert(std::ranges::equal(kTypes, kTypeNames, {}, &TypeInfo::name));

}  // namespace

std::span<const TypeInfo> all_types() noexcept { return kTypes; }

const TypeInfo* find_type(std::string_view name) noexcept {
  const auto found = std::find_if(kTypes.begin(), kTypes.end(),
                                  [&](const TypeInfo& type) { return type.name == name; });
  return found == kTypes.end() ? nullptr : &*found;
}

}  // namespace sdlc::lang
