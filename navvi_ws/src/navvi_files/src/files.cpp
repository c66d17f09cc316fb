#include "navvi_files/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace navvi_files {
namespace fs = std::filesystem;

SystemCalls SystemCalls::real() { return {::write, ::fdatasync, ::fsync, ::rename}; }

std::string failure(const std::string& what, int error) {
  return "cannot " + what + ": " + std::strerror(error);
}

int write_all(int file, std::string_view& bytes, const SystemCalls& calls) {
  while (!bytes.empty()) {
    const ssize_t written = calls.write(file, bytes.data(), bytes.size());
    if (written > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (written == 0) {
      return EIO;
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

Problem sync_folder(const fs::path& folder, const SystemCalls& calls) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return failure("open the folder " + folder.string(), errno);
  const int error = calls.fsync(file) == 0 ? 0 : errno;
  ::close(file);
  if (error != 0) return failure("sync the folder " + folder.string(), error);
  return std::nullopt;
}

Problem write_atomically(const fs::path& path, std::string_view bytes, const SystemCalls& calls) {
  const fs::path temporary = path.string() + ".tmp";
  const int file =
      ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (file < 0) return failure("create " + temporary.string(), errno);
  int error = write_all(file, bytes, calls);
  if (error == 0 && calls.fsync(file) != 0) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0 && calls.rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    return failure("write " + path.string(), error);
  }
  return sync_folder(path.parent_path().empty() ? fs::path(".") : path.parent_path(), calls);
}

std::optional<std::string> read_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  // Of the file that was opened: meanwhile another may have taken its name.
  const std::streamoff size = stream ? std::streamoff{stream.tellg()} : -1;
  if (size < 0 || size > (256 << 20)) return std::nullopt;
  stream.seekg(0);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), size);
  if (!stream.good() && !stream.eof()) return std::nullopt;
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

}  // namespace navvi_files
