#include "read/sdf_files.hpp"

#include <algorithm>
#include <utility>

#include "description/sentence.hpp"
#include "navvi_sim/description/world_description.hpp"
#include "read/sdf_population.hpp"
#include "read/sdf_value.hpp"

namespace navvi_sim::read {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxDepth = 32;
constexpr std::size_t kMaxElements = 500'000;

std::size_t size_of(const XmlElement& element) {
  std::size_t size = 1;
  for (const XmlElement& child : element.children) size += size_of(child);
  return size;
}

/// The SDF file of a model: itself if it is a file, else what its model.config (or manifest.xml)
/// names, the newest version that is there.
fs::path sdf_file_of(const fs::path& model) {
  std::error_code error;
  if (!fs::is_directory(model, error)) return model;
  for (const char* config : {"model.config", "manifest.xml"}) {
    if (!fs::is_regular_file(model / config, error)) continue;
    const XmlElement document = read_xml(model / config);
    fs::path file;
    std::string newest;
    for (const XmlElement* sdf : document.children_named("sdf")) {
      if (sdf->text.empty() || !fs::is_regular_file(model / sdf->text, error)) continue;
      if (!file.empty() && sdf->attribute("version") < newest) continue;
      file = model / sdf->text;
      newest = sdf->attribute("version");
    }
    if (file.empty())
      throw WorldError("the model in '" + model.string() + "' has no SDF file; its " + config +
                       " must name one that exists");
    return file;
  }
  if (fs::is_regular_file(model / "model.sdf", error)) return model / "model.sdf";
  throw WorldError("the model in '" + model.string() +
                   "' has neither model.config nor model.sdf; a model needs one");
}

/// A level plane, built from the inside out.
XmlElement stock_ground(const XmlElement& include) {
  XmlElement ground;
  for (const char* name : {"plane", "geometry", "collision", "link", "model"}) {
    XmlElement outer{name, "", {}, {}, include.file, include.line};
    if (!ground.name.empty()) outer.children.push_back(std::move(ground));
    ground = std::move(outer);
  }
  ground.attributes["name"] = "ground_plane";
  return ground;
}

/// The include overrides what the model says of itself.
void override_with(XmlElement& model, const XmlElement& include) {
  const std::string name = include.text_of("name");
  if (!name.empty()) model.attributes["name"] = name;
  for (const char* own : {"pose", "static"})
    if (const XmlElement* given = include.child(own)) model.replace(*given);
  const std::string placement = include.text_of("placement_frame");
  if (!placement.empty()) model.attributes["placement_frame"] = placement;
  for (const XmlElement* plugin : include.children_named("plugin"))
    model.children.push_back(*plugin);
  if (include.attribute("merge") == "true" || include.attribute("merge") == "1")
    model.attributes["merge"] = "true";
}

}  // namespace

SdfFiles::SdfFiles(const fs::path& world_file, ModelPlaces places)
    : world_file_(world_file), places_(std::move(places)), folders_(places_.first) {
  const fs::path home = fs::absolute(world_file).parent_path();
  for (const fs::path& folder : {home, home.parent_path()}) {
    folders_.push_back(folder / "models");
    folders_.push_back(folder);
  }
  for (fs::path& folder : exported_folders(world_file)) folders_.push_back(std::move(folder));
  folders_.insert(folders_.end(), places_.last.begin(), places_.last.end());
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
  if (is_prefix("https://") || is_prefix("http://")) return find_downloaded(path, places_.fuel);
  if (scheme != std::string::npos && !is_prefix("model://") && !is_prefix("file://"))
    return std::nullopt;
  if (scheme == std::string::npos) {
    if (fs::path(path).is_absolute()) return existing(path);
    if (const auto beside = existing(fs::absolute(from).parent_path() / path)) return beside;
  }
  // Gazebo joins what follows model:// to each folder, also where it begins with a slash.
  const fs::path inside =
      fs::path(path.substr(std::min(path.size(), path.find_first_not_of('/')))).lexically_normal();
  if (inside.empty() || *inside.begin() == "..") return std::nullopt;
  for (const fs::path& folder : folders_)
    if (const auto found = existing(folder / inside)) return found;
  return std::nullopt;
}

std::string SdfFiles::looked_for(const std::string& uri) const {
  if (uri.rfind("http", 0) == 0)
    return "not downloaded yet; gz fuel download -u " + shortened(printable(uri)) + " brings it";
  std::string looked;
  std::error_code error;
  for (const std::vector<fs::path>& folders : {folders_, places_.fuel})
    for (const fs::path& folder : folders)
      if (fs::is_directory(folder, error)) looked += (looked.empty() ? "" : ", ") + folder.string();
  if (!nearby_) nearby_ = models_around(world_file_);
  const std::size_t scheme = uri.find("://");
  const fs::path path = uri.substr(scheme == std::string::npos ? 0 : scheme + 3);
  const auto near = path.empty() ? nearby_->end() : nearby_->find(path.begin()->string());
  return "not there; looked in " + looked +
         (near == nearby_->end() ? " (give its folder as models)"
                                 : " (models:=" + near->second.string() + " has it)");
}

const XmlElement& SdfFiles::document(const fs::path& file) {
  const auto known = documents_.find(file);
  if (known != documents_.end()) return known->second;
  return documents_.emplace(file, read_xml(file)).first->second;
}

void SdfFiles::note_repairs(SdfNotes& notes) const {
  for (const auto& [file, root] : documents_)
    for (const std::string& repair : root.repairs) notes.add(file.string(), repair);
}

XmlElement SdfFiles::world(SdfNotes& notes) {
  const XmlElement& root = document(world_file_);
  if (root.name != "sdf" || root.child("world") == nullptr)
    throw WorldError(world_file_.string() + ": is not an SDF world (it has " +
                     (root.name == "sdf" ? "no <world>" : "<" + root.name + "> for its root") +
                     "); allowed is an <sdf> element with one <world> in it");
  if (root.children_named("world").size() > 1)
    notes.add(*root.children_named("world")[1], "a second world is not taken over");
  XmlElement world = *root.child("world");
  elements_ = size_of(world);
  std::error_code error;
  std::vector<fs::path> chain{fs::weakly_canonical(world_file_, error)};
  expand(world, notes, chain);
  return world;
}

void SdfFiles::expand(XmlElement& element, SdfNotes& notes, std::vector<fs::path>& chain) {
  std::vector<XmlElement> children;
  for (XmlElement& child : element.children) {
    if (child.name == "include") {
      notes.piece(child.text_of("name"), [&] {
        if (auto model = included(child, notes, chain)) children.push_back(std::move(*model));
      });
      continue;
    }
    if (child.name == "model" || child.name == "population") expand(child, notes, chain);
    if (child.name == "population") {
      notes.piece(child.attribute("name"), [&] {
        for (XmlElement& model : models_of(child)) children.push_back(std::move(model));
        notes.add(child, "the models of <population> '" + child.attribute("name") +
                             "' stand the same at each start");
      });
      continue;
    }
    children.push_back(std::move(child));
  }
  element.children = std::move(children);
}

std::optional<XmlElement> SdfFiles::stand_in(const XmlElement& include, const std::string& uri,
                                             SdfNotes& notes) {
  // Without a slash, npos + 1 is 0: the whole of it.
  const std::string name = lower_case(uri.substr(uri.find_last_of('/') + 1));
  if (name == "sun") {
    notes.add_harmless(include);
    return std::nullopt;
  }
  if (name != "ground_plane" && name != "ground plane" && name != "ground%20plane")
    refuse(include, "the model '" + uri + "' is " + looked_for(uri));
  XmlElement ground = stock_ground(include);
  override_with(ground, include);
  notes.add(include, "the model '" + uri + "' is not there; a level plane stands for it");
  return ground;
}

fs::path SdfFiles::model_file(const XmlElement& include, const fs::path& found) {
  if (const auto known = broken_.find(found); known != broken_.end())
    refuse(include, known->second);
  try {
    auto known = model_files_.find(found);
    if (known == model_files_.end()) known = model_files_.emplace(found, sdf_file_of(found)).first;
    static_cast<void>(document(known->second));
    return known->second;
  } catch (const WorldError& error) {
    refuse(include, broken_[found] = error.what());
  }
}

std::optional<XmlElement> SdfFiles::included(const XmlElement& include, SdfNotes& notes,
                                             std::vector<fs::path>& chain) {
  const std::string uri = required(include, "uri").text;
  const auto found = find(uri, *include.file);
  if (!found) return stand_in(include, uri, notes);
  const fs::path file = model_file(include, *found);
  const XmlElement& root = document(file);
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(file, error);
  if (std::find(chain.begin(), chain.end(), canonical) != chain.end())
    refuse(include, "the model '" + uri + "' includes itself; includes must not go in a circle");
  if (chain.size() >= kMaxDepth)
    refuse(include, "includes are nested more than " + std::to_string(kMaxDepth) +
                        " deep; allowed is up to that");
  for (const char* kind : {"model", "actor", "light"}) {
    if (root.name != "sdf" || root.child(kind) == nullptr) continue;
    XmlElement model = *root.child(kind);
    elements_ += size_of(model);
    if (elements_ > kMaxElements)
      throw WorldError(include.place() + ": with this include the world comes to more than " +
                       std::to_string(kMaxElements) + " elements; allowed is up to that");
    chain.push_back(canonical);
    expand(model, notes, chain);
    chain.pop_back();
    override_with(model, include);
    return model;
  }
  refuse(include, "the model '" + uri + "' holds " +
                      (root.name == "sdf" ? "no <model>, <actor> or <light>"
                                          : "a <" + root.name + "> and no <sdf>") +
                      "; allowed is an <sdf> element with one of these in it");
}

}  // namespace navvi_sim::read
