#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace navvi_files {

/// The calls that can fail on a bad day. Tests put their own in place.
struct SystemCalls {
  std::function<ssize_t(int, const void*, std::size_t)> write;
  std::function<int(int)> fdatasync;
  std::function<int(int)> fsync;
  std::function<int(const char*, const char*)> rename;

  [[nodiscard]] static SystemCalls real();
};

/// Empty, or a sentence that says what went wrong.
using Problem = std::optional<std::string>;

/// "cannot <what>: <errno in words>"
[[nodiscard]] std::string failure(const std::string& what, int error);

/// Makes the names in a folder durable.
[[nodiscard]] Problem sync_folder(const std::filesystem::path& folder, const SystemCalls& calls);

/// Replaces `path` as a whole: temporary file, fsync, rename, fsync of the folder. After a crash at
/// any point `path` holds the old bytes or the new ones.
[[nodiscard]] Problem write_atomically(const std::filesystem::path& path, std::string_view bytes,
                                       const SystemCalls& calls = SystemCalls::real());

/// nullopt if it cannot be read, is no regular file, or is larger than 256 MiB.
[[nodiscard]] std::optional<std::string> read_file(const std::filesystem::path& path);

/// Writes all of `bytes`; continues after EINTR and short writes. \return 0 or errno
[[nodiscard]] int write_all(int file, std::string_view& bytes, const SystemCalls& calls);

}  // namespace navvi_files
