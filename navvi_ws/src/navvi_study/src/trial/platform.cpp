#include "trial/platform.hpp"

#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstring>
#include <fstream>

namespace navvi_study::trial {
namespace {

/// The build ID in the notes of a segment, as bytes; empty: none
std::string build_id_in(const char* notes, std::size_t size, std::size_t align) {
  const auto padded = [align](std::size_t length) { return (length + align - 1) / align * align; };
  while (size > sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) head;
    std::memcpy(&head, notes, sizeof head);
    const std::size_t data = padded(sizeof head + head.n_namesz);
    const std::size_t end = padded(data + head.n_descsz);
    if (end > size) break;
    if (head.n_type == NT_GNU_BUILD_ID && head.n_namesz == sizeof ELF_NOTE_GNU &&
        std::memcmp(notes + sizeof head, ELF_NOTE_GNU, sizeof ELF_NOTE_GNU) == 0)
      return {notes + data, head.n_descsz};
    notes += end;
    size -= end;
  }
  return {};
}

/// Adds the build ID of a program or library to the string. \return 1 if it has none, which ends
/// the iteration
int add_build_id(dl_phdr_info* info, std::size_t, void* ids) {
  if (std::strncmp(info->dlpi_name, "linux-vdso", 10) == 0) return 0;  // of the kernel
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = info->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const auto* notes = reinterpret_cast<const char*>(info->dlpi_addr + segment.p_vaddr);
    const std::string id =
        build_id_in(notes, segment.p_memsz, std::max<std::size_t>(segment.p_align, 4));
    if (id.empty()) continue;
    *static_cast<std::string*>(ids) += id;
    return 0;
  }
  return 1;
}

}  // namespace

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t at = line.find(": ");
    if (at == std::string::npos) break;
    std::string name = line.substr(at + 2);
    std::replace(name.begin(), name.end(), ',', ' ');
    return name;
  }
  return "n/a";
}

std::string compiler() {
#ifdef __clang__
  return "Clang " __clang_version__;
#else
  return "GCC " __VERSION__;
#endif
}

std::string bullet() { return BULLET_VERSION; }

std::optional<std::string> build_ids() {
  std::string ids;
  if (::dl_iterate_phdr(add_build_id, &ids) != 0) return std::nullopt;
  return ids;
}

}  // namespace navvi_study::trial
