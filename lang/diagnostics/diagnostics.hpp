#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
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

  /// Whether anybody will read what is added: what is costly to find is not looked for else.
  bool is_kept() const noexcept { return is_kept_; }

  DiagnosticBuilder& label(Location where, std::string message);
  DiagnosticBuilder& help(std::string text);
  /// Nothing where the text is empty.
  DiagnosticBuilder& help_if(std::string_view text) {
    return text.empty() ? *this : help(std::string(text));
  }
  DiagnosticBuilder& fix(Location where, std::string replacement);
  /// A fix that is a guess.
  DiagnosticBuilder& unsafe_fix(Location where, std::string replacement);
  /// How evaluation came to the place, where the sink does not know it.
  DiagnosticBuilder& chain(std::vector<ChainLink> links);
  /// "did you mean `name`?", with the replacement of the diagnostic's own span as its unsafe fix.
  DiagnosticBuilder& suggest(std::optional<std::string_view> name);

 private:
  Diagnostic* diagnostic_;
  bool is_kept_;
};

/// How many diagnostics there were.
struct DiagnosticCounts {
  std::size_t errors = 0, warnings = 0;  ///< those not kept included
  std::size_t omitted = 0;               ///< of both, those not kept

  friend bool operator==(const DiagnosticCounts&, const DiagnosticCounts&) = default;
  DiagnosticCounts& operator+=(const DiagnosticCounts& other) noexcept;
};

/// Collects what the phases report; what is said twice of one place is kept once. After
/// `kMaxPerSeverity` errors (or as many warnings) further ones are only counted: the reader of a
/// message about the 51st mistake is better served by a second run.
class DiagnosticSink {
 public:
  static constexpr std::size_t kMaxPerSeverity = 50;

  /// Keeps more, for a reader that is a program.
  void set_max_per_severity(std::size_t count) noexcept { max_per_severity_ = count; }

  template <typename... Args>
  DiagnosticBuilder report(const DiagnosticKind<Args...>& kind, Location where,
                           const std::type_identity_t<Args>&... args) {
    return add(kind, where, fmt::format(fmt::runtime(kind.message), args...));
  }

  /// The same with the message made.
  DiagnosticBuilder report_as(const DiagnosticInfo& info, Location where, std::string message) {
    return add(info, where, std::move(message));
  }

  /// What is reported from now on comes about by this chain; null: by none.
  void set_chain(const ChainSource* chain) noexcept { chain_ = chain; }
  std::vector<ChainLink> chain() const {
    return chain_ == nullptr ? std::vector<ChainLink>() : chain_->chain();
  }

  /// While it is muted, whatever is reported is lost.
  void set_muted(bool is_muted) noexcept { is_muted_ = is_muted; }

  /// Which diagnostics are wanted. The others count as errors for the phases, but nobody is told of
  /// them.
  void set_filter(std::function<bool(const DiagnosticInfo&)> is_wanted) {
    is_wanted_ = std::move(is_wanted);
  }

  /// Which warnings the text itself allows: nobody is told of those. Errors cannot be allowed.
  void set_allowances(std::function<bool(const DiagnosticInfo&, Location)> is_allowed) {
    is_allowed_ = std::move(is_allowed);
  }

  /// Empties the sink, whose content the user has seen; none of it will be reported again.
  void forget_shown();

  bool has_errors() const noexcept { return error_count() > 0; }
  /// Those not kept and those not wanted included.
  std::size_t error_count() const noexcept { return counts_.errors + unwanted_errors_; }
  /// Of those that are wanted.
  const DiagnosticCounts& counts() const noexcept { return counts_; }
  /// What was kept, in the order it was reported.
  const std::deque<Diagnostic>& diagnostics() const noexcept { return diagnostics_; }
  /// What was kept, by place: files in the order they were first mentioned, then offsets.
  std::vector<const Diagnostic*> sorted() const;

 private:
  DiagnosticBuilder add(const DiagnosticInfo& info, Location where, std::string message);
  DiagnosticBuilder discard();

  std::deque<Diagnostic> diagnostics_;    // a deque: builders keep a pointer to the last one
  Diagnostic discarded_;                  // what builders of omitted diagnostics write to
  std::unordered_set<std::size_t> told_;  // by hashes: a message may be long, and they are many
  const ChainSource* chain_ = nullptr;
  std::function<bool(const DiagnosticInfo&)> is_wanted_;             // empty: all are
  std::function<bool(const DiagnosticInfo&, Location)> is_allowed_;  // empty: none is
  bool is_muted_ = false;
  std::size_t max_per_severity_ = kMaxPerSeverity;
  DiagnosticCounts counts_;
  std::size_t unwanted_errors_ = 0;
};

}  // namespace sdlc::lang
