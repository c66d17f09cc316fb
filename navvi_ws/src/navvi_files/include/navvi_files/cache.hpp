#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "navvi_files/files.hpp"

namespace navvi_files {

struct CacheConfig {
  std::filesystem::path folder;    ///< of this cache alone
  std::uintmax_t megabytes = 512;  ///< that its files may take, MB; 0: nothing is kept
  std::string build;  ///< what the results depend on besides their keys: the program, the machine
};

/// Keeps results in files, for other processes and later ones. A result stands there behind a hash
/// of the build, its key and itself, and is taken only if that is right. A result that cannot be
/// kept, because the disk is full or the folder closed, is computed again next time. Any number of
/// processes may use one folder: each file is written aside and renamed. The result that was used
/// longest ago goes first.
class Cache {
 public:
  explicit Cache(CacheConfig config, SystemCalls calls = SystemCalls::real());

  /// What was kept under `key` by a process of the same build; nullopt: nothing, or it is damaged.
  [[nodiscard]] std::optional<std::string> find(const std::string& key) const;
  /// \param key  all that the result depends on besides the build \param bytes  at most 1/16 of the
  /// cache, else they are not kept
  void keep(const std::string& key, std::string_view bytes) const;

 private:
  /// Of 16 folders, each with its share of the megabytes: only one of them is looked through at a
  /// time.
  [[nodiscard]] std::filesystem::path file_of(const std::string& key) const;
  [[nodiscard]] std::string seal_of(const std::string& key, std::string_view bytes) const;
  void make_room(const std::filesystem::path& folder) const;
  [[nodiscard]] std::uintmax_t most_bytes() const;  ///< of a folder

  CacheConfig config_;
  SystemCalls calls_;
};

}  // namespace navvi_files
