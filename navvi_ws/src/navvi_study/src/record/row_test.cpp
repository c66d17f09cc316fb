#include "record/row.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace navvi_study::record {
namespace {

Row example() {
  Row row{"trial-1", 3, -5, 12345678901234, "COLLISION", {}};
  row.fields.set("thing", std::string("a;b=c,d\"e\n%\0\xff", 13)).set("speed", 0.5);
  return row;
}

TEST(Row, reads_back_what_it_wrote_whatever_the_value_holds) {
  const std::string line = format_row(example());
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  const auto row = parse_row(std::string_view(line).substr(0, line.size() - 1));
  ASSERT_TRUE(row);
  EXPECT_EQ(*row, example());
}

TEST(Row, without_fields_is_a_row) {
  const Row bare{"t", 1, 0, 0, "TRIAL_END", {}};
  std::string line = format_row(bare);
  line.pop_back();
  EXPECT_EQ(parse_row(line).value(), bare);
}

TEST(Row, refuses_names_that_would_break_a_line) {
  EXPECT_THROW((void)format_row({"a,b", 1, 0, 0, "X", {}}), std::invalid_argument);
  EXPECT_THROW((void)format_row({"a", 1, 0, 0, "x\n", {}}), std::invalid_argument);
  EXPECT_THROW(Fields().set("a=b", "c"), std::invalid_argument);
  EXPECT_THROW(Fields().set("a", "b").set("a", "c"), std::invalid_argument);
}

TEST(Row, is_not_read_from_nonsense) {
  for (const char* line : {"", ",", ",,,,,,", "a,1,2,3,X,,00000000"}) {
    EXPECT_FALSE(parse_row(line)) << line;
  }
  EXPECT_FALSE(Fields::parse("a"));
  EXPECT_FALSE(Fields::parse("a=1;a=2"));
  EXPECT_FALSE(Fields::parse("a=%4"));
  EXPECT_FALSE(Fields::parse("a=%41")) << "only what must be escaped is";
}

TEST(Crc32, is_the_well_known_one) { EXPECT_EQ(crc32("123456789"), 0xcbf43926u); }

TEST(Fields, writes_a_number_that_is_none_as_such) {
  EXPECT_EQ(Fields().set("a", 0.0 / 0.0).format(), "a=n/a");
  EXPECT_FALSE(Fields().set("a", 0.0 / 0.0).number("a"));
  EXPECT_EQ(Fields().set("a", 1.25, 1).number("a").value(), 1.2);
}

}  // namespace
}  // namespace navvi_study::record
