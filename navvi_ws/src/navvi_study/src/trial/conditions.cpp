#include "trial/conditions.hpp"

#include <elf.h>
#include <gnu/libc-version.h>
#include <link.h>

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <cstring>
#include <fstream>

namespace navvi_study::trial {
namespace {

#ifdef __clang__
constexpr const char* kCompiler = "Clang " __clang_version__;
#else
constexpr const char* kCompiler = "GCC " __VERSION__;
#endif

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

void set_study(record::Fields& fields, const StudyConfig& study) {
  fields.set("study", study.name).set("plan", study.plan).set("group", study.group);
  fields.set("condition", study.condition).set("phase", study.phase);
  fields.set("replaces", study.replaces);
  const auto set = [&](const char* name, int count) {
    fields.set(name, count > 0 ? std::to_string(count) : "n/a");
  };
  set("session", study.session);
  set("condition_order", study.order);
  set("repeat", study.repeat);
  set("attempt", study.attempt);
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

std::vector<std::pair<std::string, std::string>> computer() {
#ifdef __x86_64__
  const bool fuses = __builtin_cpu_supports("fma") != 0;
#else
  const bool fuses = true;
#endif
  return {{"cpu", processor()},
          {"compiler", kCompiler},
          {"bullet", BULLET_VERSION},
          {"libm", std::string("glibc ") + ::gnu_get_libc_version() + (fuses ? " FMA" : "")}};
}

std::optional<std::string> build_ids() {
  std::string ids;
  if (::dl_iterate_phdr(add_build_id, &ids) != 0) return std::nullopt;
  return ids;
}

void add_conditions(record::Fields& fields, const TrialNodeConfig& config,
                    const std::optional<Scenario>& scenario, const Settings& settings,
                    const TrialStart& start, const std::string& phrases) {
  fields.set("world", scenario ? scenario->world : "n/a");
  fields.set("world_hash", scenario ? scenario->world_hash : "n/a");
  fields.set("seed", scenario ? std::to_string(scenario->seed) : "n/a");
  fields.set("operator", config.operator_kind).set("participant", config.participant);
  fields.set("profile", config.profile).set("version", config.version);
  fields.set("parameters", config.parameters.empty() ? "none" : config.parameters);
  std::vector<std::string> words, stuck;
  for (const auto& [name, value] : settings) words.push_back(name + "=" + value);
  fields.set("settings", boost::algorithm::join(words, " "));
  if (!phrases.empty()) fields.set("phrases", phrases);
  for (const auto& [name, value] : computer()) fields.set(name, value);
  set_study(fields, config.study);
  fields.set("goal_x", start.goal.x(), 6).set("goal_y", start.goal.y(), 6);
  fields.set("limit", config.limit).set("round_trip", start.round_trip, 6);
  fields.set("contacts", config.contacts);
  const bool known = start.hits_known || start.hits.contact_seq > 0;
  fields.set("contact_seq", known ? std::to_string(start.hits.contact_seq) : "n/a");
  fields.set("shelf_contacts", start.hits.shelf_count);
  fields.set("obstacle_contacts", start.hits.obstacle_count);
  const TrialMonitorConfig& monitor = config.monitor;
  fields.set("obstacle_range", monitor.obstacle_range).set("shelf_range", monitor.shelf_range);
  fields.set("leave_margin", monitor.leave_margin).set("leave_time", monitor.leave_time);
  fields.set("center_range", monitor.center_range).set("arrival_range", monitor.arrival_range);
  for (const CueKind kind : start.stuck) stuck.emplace_back(to_string(kind));
  fields.set("stuck_cues", boost::algorithm::join(stuck, ", "));
}

}  // namespace navvi_study::trial
