#include "base/json.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace raks {
namespace {

TEST(Json, keys_keep_the_order_in_which_they_are_added) {
    Json json = {{"b", 1}, {"a", 2}};
    json["c"] = 3;
    json["b"] = 4;  // stays where it is
    EXPECT_EQ(json.text(), R"({"b":4,"a":2,"c":3})");
    EXPECT_EQ(json.size(), 3U);
}

TEST(Json, pairs_of_a_text_and_a_value_are_an_object_and_all_else_is_an_array) {
    EXPECT_EQ(Json({{"a", 1}, {"b", 2}}).text(), R"({"a":1,"b":2})");
    EXPECT_EQ(Json({"a", 1}).text(), R"(["a",1])");
    EXPECT_EQ(Json({{1, 2}, {3, 4}}).text(), "[[1,2],[3,4]]");
    EXPECT_EQ(Json::array({{"a", 1}}).text(), R"([["a",1]])");
    EXPECT_EQ(Json(std::vector<std::string>{"a", "b"}).text(), R"(["a","b"])");
    EXPECT_EQ(Json::array().text(), "[]");
    EXPECT_EQ(Json::object().text(), "{}");
    EXPECT_EQ(Json().text(), "null");
}

TEST(Json, null_becomes_what_is_put_into_it) {
    Json json;
    json["rows"].push_back(1);
    json["rows"].push_back({{"deep", true}});
    EXPECT_EQ(json.text(), R"({"rows":[1,{"deep":true}]})");
}

TEST(Json, numbers_are_written_so_that_they_are_read_back_as_they_were) {
    EXPECT_EQ(Json(0.1).text(), "0.1");
    EXPECT_EQ(Json(1.0).text(), "1.0");
    EXPECT_EQ(Json(0.1F).text(), "0.10000000149011612");
    EXPECT_EQ(Json(std::numeric_limits<std::uint64_t>::max()).text(), "18446744073709551615");
    EXPECT_EQ(Json(std::numeric_limits<std::int64_t>::min()).text(), "-9223372036854775808");
    EXPECT_EQ(Json(false).text(), "false");
    EXPECT_EQ(Json(std::numeric_limits<double>::infinity()).text(), "null");
    EXPECT_EQ(Json(std::numeric_limits<double>::quiet_NaN()).text(), "null");
}

TEST(Json, texts_are_escaped_and_bytes_that_are_no_utf8_replaced) {
    EXPECT_EQ(Json("a\"b\\c\n\x01").text(), R"("a\"b\\c\n\u0001")");
    EXPECT_EQ(Json(std::string("a\xff") + "b").text(),
              "\"a\xef\xbf\xbd"
              "b\"");
}

TEST(Json, an_indent_puts_each_value_on_a_line_of_its_own) {
    EXPECT_EQ(Json({{"a", {1, 2}}}).text(2), "{\n  \"a\": [\n    1,\n    2\n  ]\n}");
}

}  // namespace
}  // namespace raks
