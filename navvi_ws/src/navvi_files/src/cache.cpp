#include "navvi_files/cache.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <system_error>
#include <utility>
#include <vector>

#include "navvi_files/bytes.hpp"

namespace navvi_files {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kName = "kept-";  // how the name of each file begins
constexpr std::uintmax_t kFolders = 16;
constexpr std::uintmax_t kMegabyte = 1'000'000;
constexpr std::size_t kSeal = 16;  // digits, before a result

std::string digits(std::uint64_t number) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(number));
  return text.data();
}

struct Kept {
  fs::file_time_type used;
  std::uintmax_t size;
  fs::path path;
};

/// Those whose name this cache gave, unfinished ones too.
std::vector<Kept> files_in(const fs::path& folder) {
  std::vector<Kept> out;
  std::error_code error;
  for (fs::directory_iterator file(folder, error), end; !error && file != end;
       file.increment(error)) {
    if (file->path().filename().string().rfind(kName, 0) != 0) continue;
    std::error_code gone;  // another process may have removed it
    const Kept kept{file->last_write_time(gone), file->file_size(gone), file->path()};
    if (!gone) out.push_back(kept);
  }
  return out;
}

}  // namespace

Cache::Cache(CacheConfig config, SystemCalls calls)
    : config_(std::move(config)), calls_(std::move(calls)) {}

std::uintmax_t Cache::most_bytes() const { return config_.megabytes * kMegabyte / kFolders; }

fs::path Cache::file_of(const std::string& key) const {
  const std::string name = digits(hash_of(key)) + digits(hash_of(config_.build + "\n" + key));
  return config_.folder / name.substr(0, 1) / (std::string(kName) + name);
}

std::string Cache::seal_of(const std::string& key, std::string_view bytes) const {
  return digits(hash_of(config_.build + "\n" + key + "\n" + digits(hash_of(bytes))));
}

std::optional<std::string> Cache::find(const std::string& key) const {
  if (config_.megabytes == 0) return std::nullopt;
  const fs::path path = file_of(key);
  std::optional<std::string> file = read_file(path);
  if (!file || file->size() < kSeal) return std::nullopt;
  const std::string seal = file->substr(0, kSeal);
  file->erase(0, kSeal);
  if (seal != seal_of(key, *file)) return std::nullopt;
  (void)::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
  return file;
}

void Cache::keep(const std::string& key, std::string_view bytes) const {
  const std::string file = seal_of(key, bytes).append(bytes);
  if (file.size() > most_bytes()) return;
  const fs::path path = file_of(key);
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  std::string aside = path.string() + ".XXXXXX";
  const int descriptor = error ? -1 : ::mkstemp(aside.data());
  if (descriptor < 0) return;
  std::string_view left = file;
  const bool written = write_all(descriptor, left, calls_) == 0;
  const bool closed = ::close(descriptor) == 0;
  if (!written || !closed || calls_.rename(aside.c_str(), path.c_str()) != 0) {
    ::unlink(aside.c_str());
    return;
  }
  make_room(path.parent_path());
}

void Cache::make_room(const fs::path& folder) const {
  std::vector<Kept> files = files_in(folder);
  std::uintmax_t sum = 0;
  for (const Kept& file : files) sum += file.size;
  if (sum <= most_bytes()) return;
  std::sort(files.begin(), files.end(),
            [](const Kept& a, const Kept& b) { return a.used < b.used; });
  for (const Kept& file : files) {
    if (sum <= most_bytes()) return;
    std::error_code gone;
    fs::remove(file.path, gone);
    sum -= file.size;
  }
}

}  // namespace navvi_files
