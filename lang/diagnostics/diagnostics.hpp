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

/// What is known of a diagnostic before it happens: a row of diagnostics.def.
struct DiagnosticInfo {
  std::string_view code;  ///< such as "E104"; never reused for another meaning
  Severity severity;
  std::string_view name;  ///< such as "unknown_property"
  std::string_view message;
};

/// A row together with the types of its message's arguments; a call that does not fit does not
/// compile.
template <typename... Args>
struct DiagnosticKind : DiagnosticInfo {
  /// The message comes twice: fmt checks it as a format but does not give the text back in
  /// version 9.
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

/// Every row of the table, in its order.
std::span<const DiagnosticInfo* const> all_diagnostics() noexcept;

/// A second place that explains the first.
struct Label {
  Location where;
  std::string message;
};

/// A replacement of one span of the text by another. It is safe when the text can have been meant
/// in no other way and nothing that a person wrote is lost; `lint --fix` makes those by itself.
struct Fix {
  Location where;
  std::string replacement;
  bool is_safe = false;
};

/// One step of how evaluation came to a place: "in `ring`", and where that was written.
struct ChainLink {
  Location where;
  std::string message;
};

/// Knows the steps that lead to where evaluation is at this moment, the innermost first.
class ChainSource {
 public:
  virtual ~ChainSource() = default;
  virtual std::vector<ChainLink> chain() const = 0;
};

struct Diagnostic {
  const DiagnosticInfo* info = nullptr;
  Location where;  ///< the smallest wrong thing; `where.file` may be null when no text is to blame
  std::string message;
  std::vector<Label> labels;
  std::vector<std::string> help;  ///< what to do, in words
  std::vector<Fix> fixes;
  std::string suggestion;        ///< the name that was probably meant; empty where there is none
  std::vector<ChainLink> chain;  ///< how evaluation came here, the innermost step first
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
  /// A fix that is a guess.
  DiagnosticBuilder& unsafe_fix(Location where, std::string replacement);
  /// Replaces the chain that the sink knows.
  DiagnosticBuilder& chain(std::vector<ChainLink> links);
  /// "did you mean `name`?", with the replacement of the diagnostic's own span as its unsafe fix.
  DiagnosticBuilder& suggest(std::optional<std::string_view> name);

 private:
  Diagnostic* diagnostic_;
  bool is_kept_;
};

/// Thrown by stop_if_requested(). No std::exception: nothing handles it but the caller that
/// requested the stop.
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
/// long loops call it at least once a millisecond.
inline void stop_if_requested(const StopRequest* stop) {
  if (stop != nullptr && stop->is_made()) throw StopRequested{};
}

/// Collects what the phases report, in that order. A diagnostic that repeats an earlier one (code,
/// place and message) is dropped. `lang/report` decides what is shown, and how.
///
/// The sink also carries the request to stop the work, because every phase has the sink.
class DiagnosticSink {
 public:
  /// Errors that are kept, and as many warnings: a bound on memory. The rest is counted.
  static constexpr std::size_t kMaxKept = 10'000;

  DiagnosticSink() = default;
  /// `stop` may be null; otherwise it must outlive the work.
  explicit DiagnosticSink(const StopRequest* stop) noexcept : stop_(stop) {}

  void set_max_kept(std::size_t count) noexcept { max_kept_ = count; }

  template <typename... Args>
  DiagnosticBuilder report(const DiagnosticKind<Args...>& kind, Location where,
                           const std::type_identity_t<Args>&... args) {
    return add(kind, where, fmt::format(fmt::runtime(kind.message), args...));
  }

  /// The same with a finished message.
  DiagnosticBuilder report_as(const DiagnosticInfo& info, Location where, std::string message) {
    return add(info, where, std::move(message));
  }

  /// Adds a diagnostic of another sink, with the chain of this sink if it has none.
  void add(const Diagnostic& diagnostic);
  /// Adds all that the other sink has, and counts what it did not keep.
  void add(const DiagnosticSink& other);

  /// The chain of the next diagnostics; null: none.
  void set_chain(const ChainSource* chain) noexcept { chain_ = chain; }
  std::vector<ChainLink> chain() const {
    return chain_ == nullptr ? std::vector<ChainLink>() : chain_->chain();
  }

  /// A muted sink drops everything.
  void set_muted(bool is_muted) noexcept { is_muted_ = is_muted; }

  /// Empties the sink. What it has dropped or kept so far will not be reported again.
  void forget_shown();

  bool has_errors() const noexcept { return errors_ > 0; }
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
  std::size_t max_kept_ = kMaxKept;
  std::size_t errors_ = 0, warnings_ = 0;
  std::map<const DiagnosticInfo*, std::size_t> not_kept_;
  const StopRequest* stop_ = nullptr;
};

}  // namespace sdlc::lang
