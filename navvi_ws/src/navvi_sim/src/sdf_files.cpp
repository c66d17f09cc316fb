#include "sdf_files.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "navvi_sim/world_error.hpp"

namespace navvi_sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxBytes = 50'000'000;
constexpr std::size_t kMaxDepth = 32;

std::string text_of(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream) throw WorldError(file.string() + " cannot be read; it must be a file");
  if (size > kMaxBytes)
    throw WorldError(file.string() + " is larger than 50 MB; allowed is up to 50 MB");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string without_comments(const std::string& xml) {
  std::string result;
  std::size_t at = 0;
  while (at < xml.size()) {
    const std::size_t open = xml.find("<!--", at);
    result.append(xml, at, open - at);
    if (open == std::string::npos) break;
    const std::size_t close = xml.find("-->", open + 4);
    if (close == std::string::npos) break;
    at = close + 3;
  }
  return result;
}

std::string trimmed(const std::string& text) {
  const char* space = " \t\r\n";
  const std::size_t first = text.find_first_not_of(space);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(space) - first + 1);
}

/// What stands between <tag ...> and </tag>, each time; `xml` has no comments.
std::vector<std::string> contents(const std::string& xml, const std::string& tag) {
  std::vector<std::string> result;
  std::size_t at = 0;
  while ((at = xml.find("<" + tag, at)) != std::string::npos) {
    const std::size_t after = at + 1 + tag.size();
    at = after;
    if (after >= xml.size() || std::string(" \t\r\n>").find(xml[after]) == std::string::npos)
      continue;  // a longer word
    const std::size_t open = xml.find('>', after);
    if (open == std::string::npos) break;
    const std::size_t close = xml.find("</" + tag, open);
    if (close == std::string::npos) break;
    if (xml[open - 1] != '/') result.push_back(xml.substr(open + 1, close - open - 1));
    at = open;
  }
  return result;
}

/// The SDF files of a model: itself if it is a file, else what its model.config (or manifest.xml)
/// names.
std::vector<fs::path> sdf_files_of(const fs::path& model) {
  std::error_code error;
  if (!fs::is_directory(model, error)) return {model};
  for (const char* config : {"model.config", "manifest.xml"}) {
    if (!fs::is_regular_file(model / config, error)) continue;
    std::vector<fs::path> files;
    for (const std::string& name : contents(without_comments(text_of(model / config)), "sdf"))
      if (fs::is_regular_file(model / trimmed(name), error)) files.push_back(model / trimmed(name));
    if (files.empty())
      throw WorldError("the model in " + model.string() + " has no SDF file; its " + config +
                       " must name one that exists");
    return files;
  }
  throw WorldError("the model in " + model.string() + " has no model.config; a model needs one");
}

}  // namespace

SdfFiles::SdfFiles(const fs::path& world_file, std::vector<fs::path> models)
    : world_file_(world_file), folders_(std::move(models)) {
  const fs::path home = fs::absolute(world_file).parent_path();
  folders_.push_back(home / "models");
  folders_.push_back(home);
}

std::optional<fs::path> SdfFiles::find(const std::string& uri, const fs::path& from) const {
  const auto is_prefix = [&](const std::string& prefix) { return uri.rfind(prefix, 0) == 0; };
  std::error_code error;
  const auto existing = [&](const fs::path& path) -> std::optional<fs::path> {
    if (fs::exists(path, error)) return path;
    return std::nullopt;
  };
  const std::size_t scheme = uri.find("://");
  const std::string path = scheme == std::string::npos ? uri : uri.substr(scheme + 3);
  if (path.empty()) return std::nullopt;
  if (is_prefix("file://") && fs::path(path).is_absolute()) return existing(path);
  if (scheme != std::string::npos && !is_prefix("model://") && !is_prefix("file://"))
    return std::nullopt;
  if (scheme == std::string::npos) {
    if (fs::path(path).is_absolute()) return existing(path);
    if (const auto beside = existing(fs::absolute(from).parent_path() / path)) return beside;
  }
  for (const fs::path& folder : folders_)
    if (const auto found = existing(folder / path)) return found;
  return std::nullopt;
}

std::string SdfFiles::looked_in() const {
  std::string text;
  for (const fs::path& folder : folders_) text += (text.empty() ? "" : ", ") + folder.string();
  return text;
}

void SdfFiles::check_includes() const {
  std::vector<fs::path> chain;
  check_includes(world_file_, chain);
}

void SdfFiles::check_includes(const fs::path& file, std::vector<fs::path>& chain) const {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(file, error);
  if (std::find(chain.begin(), chain.end(), canonical) != chain.end())
    throw WorldError(world_file_.string() + ": " + file.string() +
                     " includes itself; includes must not go in a circle");
  if (chain.size() >= kMaxDepth)
    throw WorldError(world_file_.string() + ": includes are nested more than " +
                     std::to_string(kMaxDepth) + " deep at " + file.string());
  chain.push_back(canonical);
  for (const std::string& include : contents(without_comments(text_of(file)), "include")) {
    for (const std::string& item : contents(include, "uri")) {
      const std::string uri = trimmed(item);
      const auto model = find(uri, file);
      if (!model)
        throw WorldError(file.string() + ": the model " + uri + " is not there; looked in " +
                         looked_in() + " (give its folder as models)");
      for (const fs::path& sdf : sdf_files_of(*model)) check_includes(sdf, chain);
    }
  }
  chain.pop_back();
}

}  // namespace navvi_sim
