#pragma once

#include <cstdint>
#include <navvi_files/printable.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace navvi_study::record {

using navvi_files::fixed;

[[nodiscard]] std::string csv_line(const std::vector<std::string>& cells);
/// The cells of one line, without its end; nullopt where quotes are not in order.
[[nodiscard]] std::optional<std::vector<std::string>> cells_of(std::string_view line);

/// `name=value` pairs in order. Names are [a-z0-9_]+ and unique; values are any bytes.
class Fields {
 public:
  /// \throws std::invalid_argument for a bad or repeated name
  Fields& set(const std::string& name, const std::string& value);
  /// Fixed with `decimals` digits; "n/a" where the number is not finite.
  Fields& set(const std::string& name, double value, int decimals = 3);
  Fields& set(const std::string& name, std::uint64_t value);

  [[nodiscard]] std::optional<std::string> find(const std::string& name) const;
  /// The value, or `otherwise` where the name is absent.
  [[nodiscard]] std::string get(const std::string& name,
                                const std::string& otherwise = "n/a") const;
  /// nullopt where it is absent or no finite number.
  [[nodiscard]] std::optional<double> number(const std::string& name) const;

  /// Pairs separated by ';'. What separates fields, columns or rows is written as %XX in values.
  [[nodiscard]] std::string format() const;
  /// nullopt for any text that format() does not write.
  [[nodiscard]] static std::optional<Fields> parse(std::string_view text);

  bool operator==(const Fields& other) const { return pairs_ == other.pairs_; }

 private:
  std::vector<std::pair<std::string, std::string>> pairs_;
};

/// One event of a trial, as it stands in the journal.
struct Row {
  std::string trial;         ///< name of the trial: [A-Za-z0-9._-]+
  std::uint32_t seq = 0;     ///< 1 for the first row, no gaps
  std::int64_t sim_ns = 0;   ///< ns, ROS time of the event
  std::int64_t mono_ns = 0;  ///< ns, monotonic clock when it was written
  std::string type;          ///< [A-Z_]+, see doc/record.md
  Fields fields;

  bool operator==(const Row& other) const;
};

/// First line of every journal, without its line end.
inline constexpr std::string_view kJournalHeader = "trial,seq,sim_ns,mono_ns,type,fields,crc32";

/// CRC-32 as in zip and PNG (reflected, polynomial 0x04c11db7).
[[nodiscard]] std::uint32_t crc32(std::string_view bytes);

/// One line with its line end. \throws std::invalid_argument for a trial or type with other
/// characters than allowed
[[nodiscard]] std::string format_row(const Row& row);
/// \param line  without its line end. \return nullopt unless format_row() would write just this.
[[nodiscard]] std::optional<Row> parse_row(std::string_view line);

}  // namespace navvi_study::record
