#include "sdf_notes.hpp"

#include <algorithm>

namespace navvi_sim {
namespace {

constexpr std::size_t kNamed = 3;  // of a kind, the others are counted

}  // namespace

void SdfNotes::add_harmless(const XmlElement& element) {
  const std::string name = element.attribute("name");
  const std::string quoted = name.empty() ? "" : "'" + name + "', ";
  harmless_[element.name].push_back(quoted + "line " + std::to_string(element.line));
}

std::vector<std::string> SdfNotes::sentences() const {
  std::vector<std::string> result = sentences_;
  if (harmless_.empty()) return result;
  std::string all;
  for (const auto& [kind, places] : harmless_) {
    all += (all.empty() ? "" : "; ") + std::to_string(places.size()) + " <" + kind + "> (";
    for (std::size_t i = 0; i < std::min(kNamed, places.size()); ++i)
      all += (i == 0 ? "" : "; ") + places[i];
    all += places.size() > kNamed ? "; ...)" : ")";
  }
  result.push_back("without meaning here, and left out: " + all);
  return result;
}

}  // namespace navvi_sim
