#include "tests/lang/resolve/indexed_program.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/resolve/builtin_symbols.hpp"

namespace sdlc::test {

using namespace lang;

IndexedProgram::IndexedProgram(const std::string& root, std::map<std::string, std::string> files)
    : files_(std::move(files)), root_("test.scene", root) {
  program_.emplace(root_, ProgramOptions{.workspace = &workspace_, .limits = {}}, sink_);
  index_.emplace(*program_, sink_);
}

std::uint32_t IndexedProgram::file(const std::string& name) const {
  for (std::uint32_t i = 0; i < program_->module_count(); ++i) {
    if (program_->module(i).file->name() == name) return i;
  }
  ADD_FAILURE() << "no file " << name;
  return 0;
}

const SymbolTable& IndexedProgram::table(const std::string& name) const {
  return index_->table(file(name));
}

std::uint32_t IndexedProgram::offset(const std::string& place, const std::string& name) const {
  const std::size_t mark = place.find('#');
  const std::string text = place.substr(0, mark);
  int count = mark == std::string::npos ? 1 : std::stoi(place.substr(mark + 1));
  const std::string_view file_text = program_->module(file(name)).file->text();
  std::size_t at = file_text.find(text);
  while (at != std::string_view::npos && --count > 0) at = file_text.find(text, at + 1);
  if (at == std::string_view::npos) ADD_FAILURE() << "no place " << place;
  return static_cast<std::uint32_t>(at);
}

SymbolId IndexedProgram::at(const std::string& place, const std::string& name) const {
  return index_->at(file(name), offset(place, name));
}

std::string IndexedProgram::describe(const FileSpan& place) const {
  const SourceFile& source = *program_->module(place.file).file;
  const Position position = source.position(place.span.begin);
  const std::string prefix = place.file == 0 ? "" : source.name() + " ";
  return fmt::format("{}{}:{}", prefix, position.line, position.column);
}

std::string IndexedProgram::describe(SymbolId id) const {
  if (id.is_builtin()) return fmt::format("built-in {}", builtin_symbols()[id.index].name);
  const Symbol* symbol = index_->find(id);
  if (symbol == nullptr) return "unknown";
  return fmt::format("{} {}", lang::describe(symbol->kind), describe({id.file, symbol->where}));
}

std::string IndexedProgram::meaning(const std::string& place, const std::string& name) const {
  return describe(at(place, name));
}

std::vector<std::string> IndexedProgram::references(const std::string& place,
                                                    const std::string& name) const {
  std::vector<std::string> all;
  for (const FileSpan& reference : index_->references(at(place, name))) {
    all.push_back(describe(reference));
  }
  return all;
}

std::vector<std::string> IndexedProgram::visible(const std::string& place, NameSpace space) const {
  std::vector<std::string> names;
  for (const Symbol* symbol : table().visible(offset(place), space)) {
    names.emplace_back(symbol->name);
  }
  return names;
}

std::vector<std::string> IndexedProgram::unknown() const {
  std::vector<std::string> names;
  for (const UnknownName& name : table().unknown()) {
    names.emplace_back(root_.text(name.where));
  }
  return names;
}

std::map<std::string, std::string> IndexedProgram::renamed(const std::string& place,
                                                           const std::string& new_name) const {
  const Rename rename = index_->rename(at(place), new_name);
  std::map<std::string, std::string> texts;
  for (auto at = rename.places.rbegin(); at != rename.places.rend(); ++at) {
    const SourceFile& source = *program_->module(at->file).file;
    std::string& text = texts.try_emplace(source.name(), source.text()).first->second;
    text.replace(at->span.begin, at->span.size(), new_name);
  }
  return texts;
}

std::string IndexedProgram::refusal(const std::string& place, const std::string& new_name) const {
  const Rename rename = index_->rename(at(place), new_name);
  switch (rename.refusal) {
    case Rename::Refusal::None: return "";
    case Rename::Refusal::NotDeclared: return "not declared";
    case Rename::Refusal::InvalidName: return "no name";
    case Rename::Refusal::Conflict: break;
  }
  return rename.conflict ? "conflict " + describe(*rename.conflict) : "conflict";
}

}  // namespace sdlc::test
