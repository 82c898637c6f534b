#include "render/import/json_field.hpp"

#include <gtest/gtest.h>

#include <string>

namespace {

using namespace raks::render;

/// The first fault of reading `read` from the document.
template <typename Read>
std::string fault_of(std::string_view text, const Read& read) {
    const auto document = JsonDocument::parse(text);
    if (!document) {
        return document.error().message;
    }
    JsonFaults faults;
    read(document->root(faults));
    const auto good = faults.finish();
    return good ? "" : good.error().message;
}

TEST(JsonField, reads_values_and_defaults) {
    const auto document =
        JsonDocument::parse(R"({"a":{"b":[1,2.0,"x",true]},"n":-3,"v":[1,2,3],"z":"\u0041"})");
    ASSERT_TRUE(document);
    JsonFaults faults;
    const JsonField root = document->root(faults);
    const auto items = root["a"]["b"].items();
    ASSERT_EQ(items.size(), 4U);
    EXPECT_EQ(items[1].whole(0, 5), 2);
    EXPECT_EQ(items[2].text(), "x");
    EXPECT_TRUE(items[3].truth_or(false));
    EXPECT_EQ(root["n"].number(-5.0F, 5.0F), -3.0F);
    EXPECT_EQ(root["none"]["deeper"].whole_or(7, 0, 9), 7);
    EXPECT_EQ(root["none"].index_or_none(3), -1);
    EXPECT_EQ(root["v"].numbers_or<3>({0, 0, 0}), (std::array<float, 3>{1, 2, 3}));
    EXPECT_EQ(root["z"].choice_or(0, {"B", "A"}), 1U);
    EXPECT_EQ(items[2].path(), "a.b[2]");
    EXPECT_TRUE(faults.finish());
}

TEST(JsonField, names_the_place_of_the_first_fault) {
    const std::string_view text = R"({"a":[{"b":5}],"c":"d"})";
    EXPECT_EQ(fault_of(text,
                       [](const JsonField& root) {
                           (void)root["a"].items()[0]["b"].index(3);
                           (void)root["c"].number(0, 1);
                       }),
              "a[0].b: 5 does not exist: there are 3, counted from 0");
    EXPECT_EQ(fault_of(text, [](const JsonField& root) { (void)root["c"].items(); }),
              "c: is a text, not a list");
    EXPECT_EQ(fault_of(text, [](const JsonField& root) { (void)root["x"]["y"].text(); }),
              "x.y: is missing");
}

TEST(JsonField, notes_faults_of_a_part_where_it_is_told_to) {
    const auto document = JsonDocument::parse(R"({"spring":{"drag":9}})");
    ASSERT_TRUE(document);
    JsonFaults all;
    JsonFaults part;
    const JsonField spring = document->root(all)["spring"].noting_to(part, "springs[0]");
    (void)spring["drag"].number(0, 1);
    EXPECT_FALSE(all.any());
    EXPECT_EQ(part.finish().error().message, "springs[0].drag: 9 is not in 0 .. 1");
}

TEST(JsonDocument, refuses_what_is_no_clear_document) {
    const auto none = [](const JsonField&) {};
    EXPECT_EQ(fault_of("[1]", none), "is not an object of JSON");
    EXPECT_EQ(fault_of(R"({"a":1,"b":{"c":1,"c":2}})", none), "has a key twice in one object");
    EXPECT_NE(fault_of(R"({"a":NaN})", none), "");
    EXPECT_NE(fault_of("{\"a\":\"\xFF\"}", none), "");
    EXPECT_NE(fault_of("", none), "");
    const std::string deep = "{\"a\":" + std::string(100, '[') + std::string(100, ']') + "}";
    EXPECT_EQ(fault_of(deep, none), "has JSON that is nested deeper than 64 levels");
}

}  // namespace
