#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace navvi_sim {

/// Finds the files that an SDF world speaks of.
class SdfFiles {
 public:
  /// \param models  folders of models, first come first served; the world's own folder and its
  ///                `models` subfolder come last
  SdfFiles(const std::filesystem::path& world_file, std::vector<std::filesystem::path> models);

  /// The file or folder of `uri`: model://..., file://..., or a path, absolute or relative to
  /// `from` (a file). nullopt if there is none.
  [[nodiscard]] std::optional<std::filesystem::path> find(const std::string& uri,
                                                          const std::filesystem::path& from) const;

  /// Walks all <include>s from the world file on, before a parser does: libsdformat would follow a
  /// circle until the stack ends.
  /// \throws WorldError for a model that is missing or that includes itself
  void check_includes() const;

  /// The folders that are looked in, for an error sentence.
  [[nodiscard]] std::string looked_in() const;

 private:
  void check_includes(const std::filesystem::path& file,
                      std::vector<std::filesystem::path>& chain) const;

  std::filesystem::path world_file_;
  std::vector<std::filesystem::path> folders_;
};

}  // namespace navvi_sim
