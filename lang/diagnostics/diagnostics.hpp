#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/source/source.hpp"

namespace sdlc::lang {

enum class Severity : std::uint8_t { Error, Warning };

/// The constant part of a diagnostic: a row of diagnostics.def.
struct DiagnosticInfo {
  std::string_view code;  ///< such as "E104"; never reused for another meaning
  Severity severity;
  std::string_view name;  ///< such as "unknown_property"
  std::string_view message;
};

/// A row and the types of its message's arguments, so that a call with wrong arguments does not
/// compile.
template <typename... Args>
struct DiagnosticKind : DiagnosticInfo {
  /// The message is passed twice: version 9 of fmt checks a format, but does not return its text.
  consteval DiagnosticKind(std::string_view code_, Severity severity_, std::string_view name_,
                           std::string_view message_, fmt::format_string<Args...> /*checked*/)
      : DiagnosticInfo{code_, severity_, name_, message_} {}
};

namespace diag {
#define SDLC_DIAGNOSTIC(code, severity, name, message, ...)                                    \
  inline constexpr DiagnosticKind<__VA_ARGS__> name{#code, Severity::severity, #name, message, \
                                                    message};
#include "lang/diagnostics/diagnostics.def"
#undef SDLC_DIAGNOSTIC
}  // namespace diag

/// All rows of the table, in its order.
std::span<const DiagnosticInfo* const> all_diagnostics() noexcept;

/// The name with spaces: "unknown property".
std::string title_of(const DiagnosticInfo& info);

/// A second place, which helps to understand the first.
struct Label {
  Location where;
  std::string message;
};

/// A replacement of a span of the text. It is safe if the text allows no other interpretation and
/// nothing that a person wrote is lost; `lint --fix` applies only safe fixes.
struct Fix {
  Location where;
  std::string replacement;
  bool is_safe = false;
};

/// A step of the evaluation that led to a diagnostic, such as "in `ring`", and its place.
struct ChainLink {
  Location where;
  std::string message;
};

/// Provides the steps that led to the current point of the evaluation, the innermost first.
class ChainSource {
 public:
  virtual ~ChainSource() = default;
  virtual std::vector<ChainLink> chain() const = 0;
};

struct Diagnostic {
  const DiagnosticInfo* info = nullptr;
  Location where;  ///< the smallest wrong part; `where.file` is null if it is not in a text
  std::string message;
  std::vector<Label> labels;
  std::vector<std::string> help;  ///< what to do about it
  std::vector<Fix> fixes;
  std::string suggestion;        ///< the name that was probably intended; may be empty
  std::vector<ChainLink> chain;  ///< the evaluation up to here, the innermost step first
};

/// Adds to a diagnostic that was just reported.
class DiagnosticBuilder {
 public:
  explicit DiagnosticBuilder(Diagnostic& diagnostic, bool is_kept = true) noexcept
      : diagnostic_(&diagnostic), is_kept_(is_kept) {}

  /// Whether the sink keeps the diagnostic. If not, skip expensive additions.
  bool is_kept() const noexcept { return is_kept_; }

  DiagnosticBuilder& label(Location where, std::string message);
  DiagnosticBuilder& help(std::string text);
  /// No effect if the text is empty.
  DiagnosticBuilder& help_if(std::string_view text) {
    return text.empty() ? *this : help(std::string(text));
  }
  DiagnosticBuilder& fix(Location where, std::string replacement);
  /// The same for a guess.
  DiagnosticBuilder& unsafe_fix(Location where, std::string replacement);
  /// Replaces the chain that the sink has set.
  DiagnosticBuilder& chain(std::vector<ChainLink> links);
  /// Suggests `name`, if there is one, and replaces the diagnostic's span by it as an unsafe fix.
  DiagnosticBuilder& suggest(std::optional<std::string_view> name);

 private:
  Diagnostic* diagnostic_;
  bool is_kept_;
};

/// Thrown by stop_if_requested(). Not a std::exception, so that only the caller who requested the
/// stop handles it. A program or compiler that was stopped is incomplete: discard it.
struct StopRequested {};

/// A request to stop work, made by any thread and polled by the work.
class StopRequest {
 public:
  StopRequest() = default;
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;
  virtual ~StopRequest() = default;

  void make() noexcept { source_.request_stop(); }
  /// A poll. Virtual so that a test can count polls.
  virtual bool is_made() const { return source_.stop_requested(); }
  std::stop_token token() const noexcept { return source_.get_token(); }

 private:
  std::stop_source source_;
};

/// Throws StopRequested if `stop` is not null and the request was made. Costs about a nanosecond;
/// long loops of `lang` call it about once a millisecond. The functions of `render` that checks use
/// do not poll.
inline void stop_if_requested(const StopRequest* stop) {
  if (stop != nullptr && stop->is_made()) throw StopRequested{};
}

/// Collects the diagnostics of all phases, in order. A diagnostic that repeats an earlier one
/// (code, place and message) is dropped. `lang/report` decides what is shown, and how.
///
/// The sink also carries the request to stop, because every phase has access to the sink.
class DiagnosticSink {
 public:
  /// Max errors and warnings kept, to bound memory. The rest is only counted. More warnings are
  /// kept because comments allow warnings by place: a lint must know the place of each.
  static constexpr std::size_t kMaxErrors = 10'000, kMaxWarnings = 100'000;

  DiagnosticSink() = default;
  /// `stop` may be null; otherwise it must outlive the work.
  explicit DiagnosticSink(const StopRequest* stop) noexcept : stop_(stop) {}

  template <typename... Args>
  DiagnosticBuilder report(const DiagnosticKind<Args...>& kind, Location where,
                           const std::type_identity_t<Args>&... args) {
    return add(kind, where, fmt::format(fmt::runtime(kind.message), args...));
  }

  /// The same with a formatted message.
  DiagnosticBuilder report_as(const DiagnosticInfo& info, Location where, std::string message) {
    return add(info, where, std::move(message));
  }

  /// Adds a diagnostic of another sink, with the chain of this sink if it has none.
  void add(const Diagnostic& diagnostic);
  /// Adds everything in the other sink, including the counts of what it did not keep.
  void add(const DiagnosticSink& other);

  /// The chain of all further diagnostics; null for none.
  void set_chain(const ChainSource* chain) noexcept { chain_ = chain; }
  std::vector<ChainLink> chain() const {
    return chain_ == nullptr ? std::vector<ChainLink>() : chain_->chain();
  }

  /// A muted sink drops everything.
  void set_muted(bool is_muted) noexcept { is_muted_ = is_muted; }
  bool is_muted() const noexcept { return is_muted_; }

  /// Empties the sink. Repetitions of earlier diagnostics are still dropped; those of errors count
  /// for has_errors().
  void clear();

  bool has_errors() const noexcept { return has_errors_; }
  /// Errors reported, including those not kept.
  std::size_t error_count() const noexcept { return errors_; }
  /// Warnings reported, including those not kept.
  std::size_t warning_count() const noexcept { return warnings_; }
  const std::deque<Diagnostic>& diagnostics() const noexcept { return diagnostics_; }
  /// How many diagnostics were counted and not kept, by kind.
  const std::map<const DiagnosticInfo*, std::size_t>& not_kept() const noexcept {
    return not_kept_;
  }

  /// Null if nobody can stop the work.
  const StopRequest* stop_request() const noexcept { return stop_; }
  void stop_if_requested() const { lang::stop_if_requested(stop_); }

 private:
  DiagnosticBuilder add(const DiagnosticInfo& info, Location where, std::string message);
  DiagnosticBuilder discard();

  std::deque<Diagnostic> diagnostics_;    // a deque: builders keep a pointer to the last one
  Diagnostic discarded_;                  // written by builders of diagnostics that are not kept
  std::unordered_set<std::size_t> seen_;  // hashes: messages may be long, and many
  const ChainSource* chain_ = nullptr;
  bool is_muted_ = false;
  bool has_errors_ = false;
  std::size_t errors_ = 0, warnings_ = 0;
  std::map<const DiagnosticInfo*, std::size_t> not_kept_;
  const StopRequest* stop_ = nullptr;
};

}  // namespace sdlc::lang
