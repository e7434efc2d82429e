#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <string>
#include <type_traits>
#include <utility>

#include "lang/object/counted_bytes.hpp"

namespace sdlc::lang {

/// Bytes that the value has allocated, except those that it counts itself.
template <typename T>
std::size_t heap_bytes(const T& /*value*/) noexcept {
  return 0;
}
inline std::size_t heap_bytes(const std::string& text) noexcept { return text.capacity(); }

/// A std::variant for values that are copied often: a copy is a few words and one comparison.
/// (std::variant calls through a table for every copy, move and destruction, which was half of the
/// time of evaluation.) Values of types that are not trivially copyable are in boxes that copies
/// share, with a reference count that is not atomic; such types come last. Boxed values are
/// immutable.
template <typename... Ts>
class Variant {
  template <typename T>
  static constexpr bool kIsBoxed = !std::is_trivially_copyable_v<T>;

  template <typename T>
  static constexpr bool kIsOneOf = (std::is_same_v<T, Ts> || ...);

  template <typename T>
  static consteval std::uint8_t index_of() {
    std::uint8_t index = 0;
    const bool is_found = ((std::is_same_v<T, Ts> ? true : (++index, false)) || ...);
    return is_found ? index : static_cast<std::uint8_t>(sizeof...(Ts));
  }

  static constexpr std::size_t kFirstBoxed = (std::size_t{!kIsBoxed<Ts>} + ...);
  static_assert((((index_of<Ts>() < kFirstBoxed) != kIsBoxed<Ts>)&&...), "boxed types come last");

 public:
  /// Holds the first type, which must be an empty struct.
  Variant() noexcept : index_(0) {}

  template <typename T, typename Plain = std::remove_cvref_t<T>>
  requires(kIsOneOf<Plain>) Variant(T&& value)
      : index_(index_of<Plain>()) {  // NOLINT: implicit, as in std::variant
    if constexpr (kIsBoxed<Plain>) {
      new (&storage_) Box*(new BoxOf<Plain>(std::forward<T>(value)));
    } else {
      new (&storage_) Plain(std::forward<T>(value));
    }
  }

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
// A copy of an empty value copies uninitialized storage, which is never read.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
  Variant(const Variant& other) noexcept : storage_(other.storage_), index_(other.index_) {
    if (is_boxed()) ++box()->uses;
  }
  Variant(Variant&& other) noexcept : storage_(other.storage_), index_(other.index_) {
    other.index_ = 0;
  }
  Variant& operator=(const Variant& other) noexcept { return *this = Variant(other); }
  Variant& operator=(Variant&& other) noexcept {
    if (this == &other) return *this;
    if (is_boxed()) release();
    storage_ = other.storage_;
    index_ = std::exchange(other.index_, std::uint8_t{0});
    return *this;
  }
  template <typename T, typename Plain = std::remove_cvref_t<T>>
  requires(kIsOneOf<Plain> && !kIsBoxed<Plain>) Variant& operator=(const T& value) noexcept {
    if (is_boxed()) release();
    new (&storage_) Plain(value);
    index_ = index_of<Plain>();
    return *this;
  }
  ~Variant() {
    if (is_boxed()) release();
  }
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

  std::size_t index() const noexcept { return index_; }

  template <typename T>
  const T* get_if() const noexcept {
    static_assert(kIsOneOf<T>);
    if (index_ != index_of<T>()) return nullptr;
    if constexpr (kIsBoxed<T>) {
      return &static_cast<const BoxOf<T>*>(box())->value;
    } else {
      return std::launder(reinterpret_cast<const T*>(&storage_));
    }
  }

 private:
  struct Box {
    std::uint32_t uses = 1;
    void (*destroy)(Box*) noexcept;
  };
  template <typename T>
  struct BoxOf : Box {
    template <typename U>
    explicit BoxOf(U&& value_)
        : Box{.destroy = [](Box* box) noexcept { delete static_cast<BoxOf*>(box); }},
          value(std::forward<U>(value_)),
          bytes(sizeof *this + heap_bytes(value)) {}
    T value;
    CountedBytes bytes;
  };

  struct alignas(std::max({alignof(Ts)...})) Storage {
    static constexpr std::size_t kSize =
        std::max({sizeof(void*), (kIsBoxed<Ts> ? sizeof(void*) : sizeof(Ts))...});
    std::array<std::byte, kSize> bytes;
  };

  bool is_boxed() const noexcept { return index_ >= kFirstBoxed; }
  Box* box() const noexcept { return *std::launder(reinterpret_cast<Box* const*>(&storage_)); }
  [[gnu::noinline]] void release() noexcept {
    if (--box()->uses == 0) box()->destroy(box());
  }

  Storage storage_;
  std::uint8_t index_;
};

// Counterparts of the functions of std::variant, found by argument-dependent lookup.

template <typename T, typename... Ts>
const T* get_if(const Variant<Ts...>* variant) noexcept {
  return variant->template get_if<T>();
}

template <typename T, typename... Ts>
bool holds_alternative(const Variant<Ts...>& variant) noexcept {
  return get_if<T>(&variant) != nullptr;
}

/// Precondition: it holds a T.
template <typename T, typename... Ts>
const T& get(const Variant<Ts...>& variant) noexcept {
  return *get_if<T>(&variant);
}

template <typename Visitor, typename... Ts>
decltype(auto) visit(Visitor&& visitor, const Variant<Ts...>& variant) {
  using Result = std::common_type_t<std::invoke_result_t<Visitor, const Ts&>...>;
  using Call = Result (*)(Visitor&, const Variant<Ts...>&);
  static constexpr std::array<Call, sizeof...(Ts)> kCalls{
      [](Visitor& v, const Variant<Ts...>& of) -> Result { return v(*get_if<Ts>(&of)); }...};
  return kCalls[variant.index()](visitor, variant);
}

template <typename... Ts>
bool operator==(const Variant<Ts...>& a, const Variant<Ts...>& b) {
  if (a.index() != b.index()) return false;
  return visit([&]<typename T>(const T& value) -> bool { return value == *get_if<T>(&b); }, a);
}

}  // namespace sdlc::lang
