#include <nlohmann/json.hpp>

#include "lang/report/writers.hpp"

namespace sdlc::lang {
namespace {

using Json = nlohmann::ordered_json;

/// Lines and columns from 1, columns in code points; offsets in bytes.
Json place(const Location& where) {
  if (where.file == nullptr) return nullptr;
  const Position begin = where.file->position(where.span.begin);
  const Position end = where.file->position(where.span.end);
  return {{"file", where.file->name()},  {"line", begin.line},       {"column", begin.column},
          {"end_line", end.line},        {"end_column", end.column}, {"offset", where.span.begin},
          {"end_offset", where.span.end}};
}

Json to_json(const Diagnostic& diagnostic) {
  Json json = {{"code", diagnostic.info->code},
               {"severity", severity_name(diagnostic.info->severity)},
               {"name", diagnostic.info->name},
               {"message", diagnostic.message},
               {"location", place(diagnostic.where)},
               {"suggestion", nullptr},
               {"labels", Json::array()},
               {"help", diagnostic.help},
               {"fixes", Json::array()},
               {"chain", Json::array()}};
  if (!diagnostic.suggestion.empty()) json["suggestion"] = diagnostic.suggestion;
  for (const Label& label : diagnostic.labels) {
    json["labels"].push_back({{"message", label.message}, {"location", place(label.where)}});
  }
  for (const Fix& fix : diagnostic.fixes) {
    json["fixes"].push_back({{"replacement", fix.replacement},
                             {"is_safe", fix.is_safe},
                             {"location", place(fix.where)}});
  }
  for (const ChainLink& link : diagnostic.chain) {
    json["chain"].push_back({{"message", link.message}, {"location", place(link.where)}});
  }
  return json;
}

class JsonWriter final : public DiagnosticWriter {
 public:
  explicit JsonWriter(std::ostream& out) : out_(out) {}

  void write(const Diagnostic& diagnostic) override { diagnostics_.push_back(to_json(diagnostic)); }

  void fail(const std::string& name, const std::string& reason) override {
    failures_.push_back({{"file", name}, {"reason", reason}});
  }

  void finish(const DiagnosticCounts& counts) override {
    const Json json = {{"diagnostics", std::move(diagnostics_)},
                       {"failures", std::move(failures_)},
                       {"errors", counts.errors},
                       {"warnings", counts.warnings},
                       {"omitted", counts.omitted}};
    // ASCII only: safe on a terminal. Invalid UTF-8 is replaced instead of throwing.
    constexpr bool kIsAscii = true;
    out_ << json.dump(2, ' ', kIsAscii, Json::error_handler_t::replace) << '\n';
  }

 private:
  std::ostream& out_;
  Json diagnostics_ = Json::array();
  Json failures_ = Json::array();
};

}  // namespace

std::unique_ptr<DiagnosticWriter> make_json_writer(std::ostream& out) {
  return std::make_unique<JsonWriter>(out);
}

}  // namespace sdlc::lang
