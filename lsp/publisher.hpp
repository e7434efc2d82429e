#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lang/source/source.hpp"
#include "lsp/checks.hpp"
#include "lsp/client.hpp"
#include "lsp/connection.hpp"
#include "lsp/diagnostics_json.hpp"

namespace sdlc::lsp {

/// Sends the findings of checks to the client, by file. An open file has the findings of the scene
/// that it is checked in, any other file those of all scenes. Unchanged findings are not sent
/// again, except those of an open root to a client with `versionSupport`, which drops findings of
/// older versions. All functions may be called by every thread.
class Publisher {
 public:
  /// An open file: how the client calls it, and the scene that it is checked in, if any.
  struct OpenText {
    std::string uri;
    std::filesystem::path scene;
    bool has_other_uri = false;  ///< through a link: the versions of both have nothing in common

    friend bool operator==(const OpenText&, const OpenText&) = default;
  };

  Publisher(const lang::FileSystem& files, Connection& connection)
      : files_(files), connection_(connection) {}

  /// By what the client can do.
  void configure(const Client& client);
  /// Replaces the open files, by identity. Findings of scenes that nobody looks at are removed.
  void set_open(std::map<std::filesystem::path, OpenText> open);
  void publish(const Checks::Result& result);
  /// Sends the findings of a file again after its next check: an editor may have dropped them when
  /// it closed the file.
  void send_again(const std::filesystem::path& file);

  /// The client's URI of a file, if it is open.
  std::string uri_of(const std::filesystem::path& path) const;

 private:
  /// The findings of a file that the client has, under this URI.
  struct Sent {
    std::string uri;
    Json findings;               ///< null: unknown
    std::optional<int> version;  ///< of the text, if it was sent
  };
  /// The findings of one scene, by the identity of the file.
  using Findings = std::map<std::filesystem::path, Json>;

  Findings findings_of(const Checks::Result& result) const;
  std::string uri_of_identity(const std::filesystem::path& identity) const;
  Json united(const std::filesystem::path& file) const;
  /// `root`: the scene just checked, in this version; nullopt if it could not be read.
  struct Checked {
    const std::filesystem::path* root = nullptr;
    std::optional<int> version = std::nullopt;
  };
  /// The version to send with the findings of a file; nullopt if they may be of another text.
  std::optional<int> version_of(const std::filesystem::path& file, const Checked& checked) const;
  void send(const std::set<std::filesystem::path>& files, const Checked& checked);
  void send(const std::string& uri, const Json& findings, std::optional<int> version);
  void show_config_errors(const CheckedScene& checked);

  const lang::FileSystem& files_;
  Connection& connection_;
  mutable std::mutex mutex_;
  lang::PositionEncoding encoding_ = lang::PositionEncoding::Utf16;
  bool has_related_ = false, has_versions_ = false;
  std::map<std::filesystem::path, OpenText> open_;
  std::map<std::filesystem::path, Findings> scenes_;
  std::map<std::filesystem::path, Sent> sent_;  // by identity; empty ones only with a version
  std::vector<std::string> config_errors_;      // shown last
};

}  // namespace sdlc::lsp
