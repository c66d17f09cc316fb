#include "navvi_files/json.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <limits>

namespace navvi_files {
namespace {

TEST(Json, is_read_back_by_a_reader_of_yaml_which_takes_json) {
  const std::string hard = "a \"word\", a \\ and a line\nwith a tab\t, \xc3\xa9";
  const YAML::Node read = YAML::Load(json_object({{"text", json_text(hard)},
                                                  {"half", json_number(0.5, 2)},
                                                  {"two", json_list({json_text("x"), "1"})},
                                                  {"none", json_list({})}}));
  EXPECT_EQ(read["text"].as<std::string>(), hard);
  EXPECT_EQ(read["half"].Scalar(), "0.50");
  EXPECT_EQ(read["two"].size(), 2U);
  EXPECT_EQ(read["none"].size(), 0U);
}

TEST(Json, has_null_for_what_is_not_finite) {
  EXPECT_EQ(json_number(std::numeric_limits<double>::quiet_NaN()), "null");
  EXPECT_EQ(json_number(-std::numeric_limits<double>::infinity()), "null");
}

}  // namespace
}  // namespace navvi_files
