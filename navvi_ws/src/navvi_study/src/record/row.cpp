#include "record/row.hpp"

#include <zlib.h>

#include <charconv>
#include <cmath>
#include <navvi_types/scenario.hpp>
#include <stdexcept>

namespace navvi_study::record {
namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n\r") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

constexpr std::string_view kHex = "0123456789abcdef";

/// True if there are bytes, and each is one of `allowed`.
bool holds_only(std::string_view allowed, std::string_view text) {
  return !text.empty() && text.find_first_not_of(allowed) == text.npos;
}
bool is_name(std::string_view text) {
  return holds_only("abcdefghijklmnopqrstuvwxyz0123456789_", text);
}
bool is_type(std::string_view text) { return holds_only("ABCDEFGHIJKLMNOPQRSTUVWXYZ_", text); }
bool is_trial(std::string_view text) {
  return holds_only("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-", text);
}

bool stands_for_itself(char c) {
  return c >= ' ' && c <= '~' && std::string_view("%;=,\"").find(c) == std::string_view::npos;
}

std::string escape(const std::string& value) {
  std::string text;
  for (const char c : value) {
    if (stands_for_itself(c)) {
      text += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      text += {'%', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return text;
}

std::optional<std::string> unescape(std::string_view text) {
  std::string value;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      if (!stands_for_itself(text[i])) return std::nullopt;
      value += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    const auto high = kHex.find(text[i + 1]);
    const auto low = kHex.find(text[i + 2]);
    if (high == kHex.npos || low == kHex.npos) return std::nullopt;
    value += static_cast<char>(high * 16 + low);
    if (stands_for_itself(value.back())) return std::nullopt;
    i += 2;
  }
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == text.npos) return parts;
    text.remove_prefix(at + 1);
  }
}

template <typename Number>
std::optional<Number> number_from(std::string_view text) {
  Number number{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return number;
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

Fields& Fields::set(const std::string& name, const std::string& value) {
  if (!is_name(name)) throw std::invalid_argument("'" + name + "' cannot name a field");
  if (find(name)) throw std::invalid_argument("field " + name + " is set twice");
  pairs_.emplace_back(name, value);
  return *this;
}

Fields& Fields::set(const std::string& name, double value, int decimals) {
  if (!std::isfinite(value) || std::abs(value) > 1e15) return set(name, "n/a");
  return set(name, fixed(value, decimals));
}

Fields& Fields::set(const std::string& name, std::uint64_t value) {
  return set(name, std::to_string(value));
}

std::optional<std::string> Fields::find(const std::string& name) const {
  for (const auto& pair : pairs_)
    if (pair.first == name) return pair.second;
  return std::nullopt;
}

std::string Fields::get(const std::string& name, const std::string& otherwise) const {
  return find(name).value_or(otherwise);
}

std::optional<double> Fields::number(const std::string& name) const {
  const auto text = find(name);
  if (!text) return std::nullopt;
  const auto value = number_from<double>(*text);
  if (!value || !std::isfinite(*value)) return std::nullopt;
  return value;
}

std::string Fields::format() const {
  std::string text;
  for (const auto& [name, value] : pairs_) {
    if (!text.empty()) text += ';';
    text += name + "=" + escape(value);
  }
  return text;
}

std::optional<Fields> Fields::parse(std::string_view text) {
  Fields fields;
  if (text.empty()) return fields;
  for (const auto part : split(text, ';')) {
    const auto at = part.find('=');
    if (at == part.npos || !is_name(part.substr(0, at))) return std::nullopt;
    const auto value = unescape(part.substr(at + 1));
    const std::string name(part.substr(0, at));
    if (!value || fields.find(name)) return std::nullopt;
    fields.set(name, *value);
  }
  return fields;
}

bool Row::operator==(const Row& other) const {
  return trial == other.trial && seq == other.seq && sim_ns == other.sim_ns &&
         mono_ns == other.mono_ns && type == other.type && fields == other.fields;
}

std::uint32_t crc32(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string format_row(const Row& row) {
  if (!is_trial(row.trial)) throw std::invalid_argument("'" + row.trial + "' cannot name a trial");
  if (!is_type(row.type)) throw std::invalid_argument("'" + row.type + "' is not an event type");
  const std::string body = row.trial + "," + std::to_string(row.seq) + "," +
                           std::to_string(row.sim_ns) + "," + std::to_string(row.mono_ns) + "," +
                           row.type + "," + row.fields.format();
  return body + "," + navvi_types::to_hex(crc32(body), 8) + "\n";
}

std::optional<Row> parse_row(std::string_view line) {
  const auto at = line.rfind(',');
  if (at == line.npos) return std::nullopt;
  if (line.substr(at + 1) != navvi_types::to_hex(crc32(line.substr(0, at)), 8)) return std::nullopt;
  const auto columns = split(line.substr(0, at), ',');
  if (columns.size() != 6 || !is_trial(columns[0]) || !is_type(columns[4])) return std::nullopt;
  const auto seq = number_from<std::uint32_t>(columns[1]);
  const auto sim_ns = number_from<std::int64_t>(columns[2]);
  const auto mono_ns = number_from<std::int64_t>(columns[3]);
  const auto fields = Fields::parse(columns[5]);
  if (!seq || !sim_ns || !mono_ns || !fields) return std::nullopt;
  return Row{std::string(columns[0]), *seq, *sim_ns, *mono_ns, std::string(columns[4]), *fields};
}

}  // namespace navvi_study::record
