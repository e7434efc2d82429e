#include "lang/eval/instance_memo.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace sdlc::lang {
namespace {

// With keys up to these sizes, a lookup costs about as much as the evaluation of one sphere.
constexpr std::uint64_t kMaxWeight = 64;  // of a list: see ListValue::weight()
constexpr std::size_t kMaxText = 1024;    // bytes of a string

// Lookups of a def end when misses exceed kMaxMissed + kMissedPerFound * hits.
constexpr std::uint64_t kMaxMissed = 16'384, kMissedPerFound = 16;

// Bytes of all entries together; an entry takes its key and about kBytesPerEntry.
constexpr std::size_t kMaxBytes = std::size_t{64} << 20, kBytesPerEntry = 64;

void append(std::uint64_t word, std::string& to) {
  to.append(reinterpret_cast<const char*>(&word), sizeof word);
}
void append(double number, std::string& to) { append(std::bit_cast<std::uint64_t>(number), to); }
void append(render::Vec3 v, std::string& to) {
  for (const double number : {v.x, v.y, v.z}) append(number, to);
}
void append(render::LinearRgb c, std::string& to) {
  for (const double number : {c.r, c.g, c.b}) append(number, to);
}
void append(std::string_view text, std::string& to) {
  append(std::uint64_t{text.size()}, to);
  to += text;
}

}  // namespace

bool append_identity(const Value& value, std::string& identity) {
  const auto begin = [&](char tag, Unit unit = Unit::None) {
    identity += tag;
    identity += static_cast<char>(unit);
  };
  if (const auto* scalar = get_if<Scalar>(&value)) {
    begin('s', scalar->unit);
    append(scalar->value, identity);
  } else if (const auto* flag = get_if<bool>(&value)) {
    begin(*flag ? 't' : 'f');
  } else if (const auto* triple = get_if<Triple>(&value)) {
    begin('3', triple->unit);
    append(triple->value, identity);
  } else if (const auto* angle = get_if<Angle>(&value)) {
    begin('a');
    append(angle->degrees, identity);
  } else if (const auto* angles = get_if<AngleTriple>(&value)) {
    begin('A');
    append(angles->degrees, identity);
  } else if (const auto* color = get_if<render::LinearRgb>(&value)) {
    begin('c');
    append(*color, identity);
  } else if (const auto* bounds = get_if<Bounds>(&value)) {
    begin('b', bounds->unit);
    append(bounds->from, identity);
    append(bounds->to, identity);
  } else if (const auto* material = get_if<MaterialValue>(&value)) {
    begin(material->exact_fresnel ? 'M' : 'm');
    append(static_cast<std::uint64_t>(material->kind), identity);
    append(material->color, identity);
    append(material->parameter, identity);
  } else if (const auto* motion = get_if<MotionValue>(&value)) {
    begin('o');
    append(motion->to, identity);
    append(motion->over.from, identity);
    append(motion->over.to, identity);
  } else if (holds_alternative<None>(value)) {
    begin('n');
  } else if (const auto* text = get_if<std::string>(&value)) {
    if (text->size() > kMaxText) return false;
    begin('"');
    append(std::string_view(*text), identity);
  } else if (const auto* word = get_if<Word>(&value)) {
    begin('w');
    append(std::string_view(word->text), identity);
  } else if (const ListValue* list = elements_of(value)) {
    if (list->weight() > kMaxWeight) return false;
    begin(get_if<RowValue>(&value) != nullptr ? 'r' : 'l');
    // The names of columns belong to a row; the tables live as long as the program.
    append(std::uint64_t{std::bit_cast<std::uintptr_t>(list->table_of_row())}, identity);
    append(std::uint64_t{list->size()}, identity);
    for (std::size_t i = 0; i < list->size(); ++i) {
      if (!append_identity((*list)[i], identity)) return false;
    }
  } else {
    return false;  // Nothing
  }
  return true;
}

bool InstanceMemo::is_worthwhile(Def def) const {
  const auto found = of_def_.find(key(def));
  if (found == of_def_.end()) return true;
  const Instances& instances = found->second;
  return instances.missed < kMaxMissed + kMissedPerFound * instances.found;
}

InstanceMemo::Contents InstanceMemo::look_up(Def def, const std::string& arguments) {
  Instances& instances = of_def_[key(def)];
  const auto found = instances.known.find(arguments);
  if (found != instances.known.end()) {
    ++instances.found;
    return {.number = found->second.number, .is_new = false, .height = found->second.height};
  }
  ++instances.missed;
  if (bytes_ + arguments.size() + kBytesPerEntry > kMaxBytes) return {};
  bytes_ += arguments.size() + kBytesPerEntry;
  instances.known.emplace(arguments, Known{.number = ++last_number_, .height = 0});
  return {.number = last_number_, .is_new = true, .height = 0};
}

void InstanceMemo::set_height(Def def, const std::string& arguments, std::uint64_t height) {
  of_def_[key(def)].known[arguments].height = height;
}

void InstanceMemo::forget(Def def, const std::string& arguments) {
  if (of_def_[key(def)].known.erase(arguments) > 0) bytes_ -= arguments.size() + kBytesPerEntry;
}

}  // namespace sdlc::lang
