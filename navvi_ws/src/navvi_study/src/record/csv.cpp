#include "record/csv.hpp"

namespace navvi_study::record {
namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n\r") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

}  // namespace

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i == 0 ? "" : ",") + quoted(cells[i]);
  return line + "\n";
}

std::optional<std::vector<std::string>> cells_of(std::string_view text) {
  std::vector<std::string> cells(1);
  bool open = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"' && open && i + 1 < text.size() && text[i + 1] == '"') {
      cells.back() += text[i++];
    } else if (text[i] == '"') {
      open = !open;
    } else if (text[i] == ',' && !open) {
      cells.emplace_back();
    } else {
      cells.back() += text[i];
    }
  }
  if (open) return std::nullopt;
  return cells;
}

}  // namespace navvi_study::record
