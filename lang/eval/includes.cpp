#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/eval/evaluator.hpp"
#include "lang/json/json.hpp"
#include "lang/source/limits.hpp"

namespace sdlc::lang {
namespace {

/// Passes objects on and counts those that fulfil a condition.
class CountingSink final : public ObjectSink {
 public:
  CountingSink(ObjectSink& objects, bool (*is_counted)(const Object& object))
      : objects_(objects), is_counted_(is_counted) {}
  void add(const Object& object) override {
    if (is_counted_(object)) ++count_;
    objects_.add(object);
  }
  std::uint64_t count() const noexcept { return count_; }

 private:
  ObjectSink& objects_;
  bool (*is_counted_)(const Object& object);
  std::uint64_t count_ = 0;
};

}  // namespace

bool Evaluator::is_include_cycle(const Code& code, const Statement& statement, std::uint32_t file) {
  // Program::load() finds most cycles, but not one through a file that an import has loaded before.
  const auto first = std::find(open_includes_.begin(), open_includes_.end(), file);
  if (first == open_includes_.end()) return false;
  std::vector<std::string> cycle;
  for (auto open = first; open != open_includes_.end(); ++open) {
    cycle.push_back(fmt::format("`{}`", program_.module(*open).file->name()));
  }
  cycle.push_back(cycle.front());
  const auto name = ast::Node(*code.tree, statement.node).first(SyntaxKind::String);
  sink_.report(diag::file_circle, name->location(), program_.module(file).file->name())
      .help(fmt::format("the cycle is {}", fmt::join(cycle, " → ")));
  return true;
}

void Evaluator::run_include(const Code& code, const Statement& statement) {
  const std::uint32_t included = code.operands_of(statement)[0];
  const SourceFile& file =
      included >= kConfigs ? program_.config(included) : *program_.module(included).file;
  const bool is_new = included_.insert(included).second;
  const std::uint64_t bytes = is_new ? 0 : file.text().size();
  if (!take_steps(code, statement.node, work::kInclude + bytes * work::kIncludedByte)) return;
  const Nested entry(
      *this, {.kind = StackEntry::Include, .code = &code, .node = statement.node, .name = {}});
  if (included >= kConfigs) {
    CountingSink counted(*objects_, is_visible_sphere);
    read_spheres(file, counted, sink_);
    allow_steps(counted.count());
    return;
  }
  if (is_include_cycle(code, statement, included)) return;
  evaluate_globals(included, Globals::TimeFree);
  evaluate_globals(included, Globals::TimeDependent);
  open_includes_.push_back(included);
  run_file(included);
  open_includes_.pop_back();
}

}  // namespace sdlc::lang
