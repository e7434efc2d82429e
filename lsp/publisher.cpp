#include "lsp/publisher.hpp"

#include <algorithm>
#include <utility>

#include "lsp/positions.hpp"
#include "lsp/uri.hpp"

namespace sdlc::lsp {

namespace fs = std::filesystem;

void Publisher::configure(const Client& client) {
  const std::scoped_lock lock(mutex_);
  encoding_ = client.encoding();
  has_related_ = client.can("/textDocument/publishDiagnostics/relatedInformation");
  has_versions_ = client.can("/textDocument/publishDiagnostics/versionSupport");
}

std::string Publisher::uri_of(const fs::path& path) const {
  const std::scoped_lock lock(mutex_);
  return uri_of_identity(files_.identity(path));
}

std::string Publisher::uri_of_identity(const fs::path& identity) const {
  const auto open = open_.find(identity);
  return open == open_.end() ? uri_of_path(identity) : open->second.uri;
}

Publisher::Findings Publisher::findings_of(const Checks::Result& result) const {
  Findings findings;
  if (result.checked == nullptr) {
    findings[result.scene].push_back(
        {{"range", first_range()}, {"severity", 1}, {"source", "sdlc"}, {"message", result.error}});
    return findings;
  }
  std::map<const lang::SourceFile*, fs::path> identities;
  const auto identity_of = [&](const lang::SourceFile& file) -> const fs::path& {
    const auto [entry, is_new] = identities.try_emplace(&file);
    if (is_new) entry->second = files_.identity(file.name());
    return entry->second;
  };
  DiagnosticsJson json{
      .ranges = FileRanges(encoding_),
      .has_related = has_related_,
      .uri_of = [&](const lang::SourceFile& file) { return uri_of_identity(identity_of(file)); }};
  for (const lang::Diagnostic* diagnostic : result.checked->findings().shown) {
    const lang::SourceFile* file = diagnostic->where.file;
    findings[file == nullptr ? result.scene : identity_of(*file)].push_back(json.of(*diagnostic));
  }
  return findings;
}

void Publisher::publish(const Checks::Result& result) {
  const std::scoped_lock lock(mutex_);
  const auto is_of_scene = [&](const auto& open) { return open.second.scene == result.scene; };
  if (std::ranges::none_of(open_, is_of_scene)) return;  // closed since the check began
  std::set<fs::path> affected;
  Findings& known = scenes_[result.scene];
  for (const auto& [file, findings] : known) affected.insert(file);
  known = findings_of(result);
  for (const auto& [file, findings] : known) affected.insert(file);
  affected.insert(result.scene);
  Checked checked{.root = &result.scene};
  if (result.checked != nullptr) checked.version = result.checked->root().version();
  send(affected, checked);
  if (result.checked != nullptr) show_config_errors(*result.checked);
}

void Publisher::send_again(const fs::path& file) {
  const std::scoped_lock lock(mutex_);
  const auto sent = sent_.find(file);
  if (sent != sent_.end()) sent->second.findings = nullptr;
}

/// A message box, because a `.sdlc.toml` is no text of this server. Shown again only if it changes.
void Publisher::show_config_errors(const CheckedScene& checked) {
  if (checked.config_errors() == config_errors_) return;
  config_errors_ = checked.config_errors();
  for (const std::string& error : config_errors_) {
    connection_.show(MessageType::Warning, error);
  }
}

void Publisher::set_open(std::map<fs::path, OpenText> open) {
  const std::scoped_lock lock(mutex_);
  if (open == open_) return;
  std::set<fs::path> affected, scenes;
  for (const auto& [file, text] : open_) affected.insert(file);
  open_ = std::move(open);
  for (const auto& [file, text] : open_) {
    affected.insert(file);
    scenes.insert(text.scene);
  }
  for (auto scene = scenes_.begin(); scene != scenes_.end();) {
    for (const auto& [file, findings] : scene->second) affected.insert(file);
    scene = scenes.contains(scene->first) ? std::next(scene) : scenes_.erase(scene);
  }
  send(affected, {});
}

Json Publisher::united(const fs::path& file) const {
  Json all = Json::array();
  const auto add = [&](const Findings& findings) {
    const auto found = findings.find(file);
    if (found == findings.end()) return;
    if (all.empty()) {
      all = found->second;  // the usual case: of one scene, without duplicates
      return;
    }
    for (const Json& finding : found->second) {
      if (std::ranges::find(all, finding) == all.end()) all.push_back(finding);
    }
  };
  const auto open = open_.find(file);
  for (const auto& [scene, findings] : scenes_) {
    if (open == open_.end() || open->second.scene == scene) add(findings);
  }
  return all;
}

void Publisher::send(const std::set<fs::path>& files, const Checked& checked) {
  for (const fs::path& file : files) {
    const std::string uri = uri_of_identity(file);
    Json findings = united(file);
    const std::optional<int> version = version_of(file, checked);
    const bool may_forget = findings.empty() && !version;
    const auto sent = sent_.find(file);
    if (sent == sent_.end()) {
      if (may_forget) continue;
    } else if (sent->second.uri != uri) {
      // A link to the file was opened or closed: the editor takes both for different files.
      send(sent->second.uri, Json::array(), std::nullopt);
    } else if (sent->second.findings == findings && (!version || sent->second.version == version)) {
      if (may_forget && !open_.contains(file)) sent_.erase(sent);
      continue;
    }
    send(uri, findings, version);
    if (may_forget) {
      sent_.erase(file);
    } else {
      sent_[file] = {.uri = uri, .findings = std::move(findings), .version = version};
    }
  }
}

std::optional<int> Publisher::version_of(const fs::path& file, const Checked& checked) const {
  if (!has_versions_ || checked.root == nullptr || *checked.root != file) return std::nullopt;
  const auto open = open_.find(file);
  const bool has_findings_of_check = open != open_.end() && open->second.scene == file;
  return has_findings_of_check && !open->second.has_other_uri ? checked.version : std::nullopt;
}

void Publisher::send(const std::string& uri, const Json& findings, std::optional<int> version) {
  Json params{{"uri", uri}, {"diagnostics", findings}};
  if (version) params["version"] = *version;
  connection_.notify("textDocument/publishDiagnostics", std::move(params));
}

}  // namespace sdlc::lsp
