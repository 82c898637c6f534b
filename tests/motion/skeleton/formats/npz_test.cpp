// NumPy's arrays: types, orders, packing, and what is damaged.
#include "motion/skeleton/formats/npz.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "motion/skeleton/formats/json_arrays.hpp"
#include "motion/skeleton/formats/npy.hpp"
#include "motion/skeleton/formats/zip_archive.hpp"
#include "tests/motion/skeleton/formats/motion_writers.hpp"

namespace raks::motion::npz_test {
namespace {

// Exact in every type that is written.
const NumberArray kArray = {{2, 3}, {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}};
constexpr std::array<std::string_view, 2> kNames = {"a", "b"};

template <typename T>
std::string message(const Expected<T>& result) {
    return result ? "read" : result.error().message;
}

TEST(Npy, every_type_and_order_gives_the_same_numbers) {
    for (const char* type : {"<f2", ">f2", "<f4", ">f4", "<f8", ">f8", "<i4", ">i4", "|u1"}) {
        for (const bool is_fortran : {false, true}) {
            const auto read = parse_npy(raks::test::npy_bytes(kArray, {type, is_fortran}));
            ASSERT_TRUE(read) << type << ": " << message(read);
            EXPECT_EQ(read->shape, kArray.shape) << type;
            EXPECT_EQ(read->values, kArray.values) << type << is_fortran;
        }
    }
}

TEST(Npy, halves_are_those_of_ieee_754) {
    const NumberArray halves = {{4}, {-0.5, 1.5, 65504.0, 0.00006103515625}};
    EXPECT_EQ(parse_npy(raks::test::npy_bytes(halves, {"<f2", false}))->values, halves.values);
    std::string special = raks::test::npy_bytes({{3}, {0.0, 0.0, 0.0}}, {"<f2", false});
    special.replace(special.size() - 6, 6, std::string("\x01\x00\x00\xFC\x00\x7E", 6));
    const auto read = parse_npy(special);
    EXPECT_EQ(read->values[0], std::ldexp(1.0, -24));  // the least of all
    EXPECT_EQ(read->values[1], -HUGE_VAL);
    EXPECT_TRUE(std::isnan(read->values[2]));
}

TEST(Npy, what_is_no_array_of_numbers_is_refused) {
    const auto head = [](std::string text) {
        text.resize(118, ' ');
        return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + text;
    };
    const struct {
        std::string bytes;
        const char* part;
    } rows[] = {
        {"PK", "is not a NumPy array"},
        {head("{'descr': '|O', 'fortran_order': False, 'shape': ()}"), "pickles are programs"},
        {head("{'descr': '<U7', 'fortran_order': False, 'shape': ()}"), "is of type \"<U7\""},
        {head("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (1,)}"), "columns"},
        {head("{'descr': '<f4', 'fortran_order': False, 'shape': (1000000,)}"),
         "has the shape (1000000,), but ends after 0 numbers"},
        {head("{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967296, 2)}"),
         "but ends after 0"},
        {head("{'descr': '<f4', 'fortran_order': False, 'shape': (a,)}"), "not a list of counts"},
        {raks::test::npy_bytes(kArray).substr(0, 40), "ends inside its header"},
    };
    for (const auto& row : rows) {
        EXPECT_NE(message(parse_npy(row.bytes)).find(row.part), std::string::npos)
            << message(parse_npy(row.bytes));
    }
}

TEST(Npz, stored_and_deflated_give_the_arrays_that_were_asked_for) {
    const NumberArray other = {{}, {7.0}};
    for (const raks::test::Packing packing :
         {raks::test::Packing::stored, raks::test::Packing::deflated}) {
        const auto read = read_npz(
            raks::test::npz_bytes({{"a", kArray}, {"b", other}, {"c", kArray}}, packing), kNames);
        ASSERT_TRUE(read) << message(read);
        EXPECT_EQ(read->names, (std::vector<std::string>{"a", "b", "c"}));
        EXPECT_EQ(read->arrays.size(), 2U);
        EXPECT_EQ(read->arrays.at("a").values, kArray.values);
        EXPECT_EQ(read->arrays.at("b").values, other.values);
    }
}

TEST(Npz, of_a_file_that_was_not_asked_for_nothing_is_read) {
    const auto read =
        read_npz(raks::test::zip_bytes({{"gender.npy", "no array"}, {"x.txt", "y"}}), kNames);
    ASSERT_TRUE(read) << message(read);
    EXPECT_TRUE(read->arrays.empty());
    EXPECT_EQ(read->names, std::vector<std::string>{"gender"});
}

TEST(Npz, bombs_and_damage_are_refused) {
    const std::string good = raks::test::npz_bytes({{"a", kArray}}, raks::test::Packing::deflated);
    EXPECT_NE(message(read_npz(good.substr(0, good.size() - 30), kNames)).find("cut off"),
              std::string::npos);
    // Sizes that the directory declares, in bytes: more than is ever read; more than deflate can
    // have made of so few; fewer than come out.
    for (const auto& [size, part] : {std::pair(600U << 20U, "at most 536870912 are read"),
                                     std::pair(400U << 20U, "as no motion does"),
                                     std::pair(15U << 20U, "a.npy is damaged"),
                                     std::pair(100U, "a.npy is damaged")}) {
        std::string bomb = good;
        const std::size_t at = bomb.find("PK\x01\x02") + 24;
        for (std::size_t byte = 0; byte < 4; ++byte) {
            bomb[at + byte] = static_cast<char>((size >> (8 * byte)) & 0xFFU);
        }
        EXPECT_NE(message(read_npz(bomb, kNames)).find(part), std::string::npos)
            << message(read_npz(bomb, kNames));
    }
    // What a body that stands still for hours shrinks to.
    const NumberArray still = {{40'000, 72}, std::vector<double>(40'000 * 72)};
    EXPECT_NE(message(read_npz(raks::test::npz_bytes({{"a", still}}, raks::test::Packing::deflated),
                               kNames))
                  .find("as no motion does"),
              std::string::npos);
    EXPECT_EQ(message(read_npz(raks::test::zip_bytes({{"a.npy", raks::test::npy_bytes(kArray)},
                                                      {"a.npy", raks::test::npy_bytes(kArray)}}),
                               kNames)),
              "a is packed twice; save the file again");
    std::string broken = good;
    broken[60] = static_cast<char>(broken[60] ^ 0x10);
    EXPECT_NE(message(read_npz(broken, kNames)).find("a.npy is damaged"), std::string::npos);
    std::string locked = good;
    locked[locked.find("PK\x01\x02") + 8] = 1;
    EXPECT_NE(message(read_npz(locked, kNames)).find("is encrypted"), std::string::npos);
}

TEST(JsonArrays, have_the_shape_of_their_nesting) {
    const auto read = read_json_arrays(
        R"({"a": [[0,1,2],[3,4.0,5]], "name": "x", "c": {"a": [1]}, "b": 30, "d": [[1],2]})",
        kNames);
    ASSERT_TRUE(read) << message(read);
    EXPECT_EQ(read->arrays.size(), 2U);
    EXPECT_EQ(read->arrays.at("a").shape, kArray.shape);
    EXPECT_EQ(read->arrays.at("a").values, kArray.values);
    EXPECT_EQ(read->arrays.at("b").shape, std::vector<std::size_t>{});
    EXPECT_EQ(read->arrays.at("b").values, std::vector<double>{30.0});
}

TEST(JsonArrays, that_are_not_even_or_no_numbers_are_refused) {
    const struct {
        const char* text;
        const char* part;
    } rows[] = {
        {"{\"a\": [[1,2],[3]]}", "a: has rows of different lengths: 2 and 1"},
        {"{\"a\": [1,[2]]}", "a: has rows of different lengths"},
        {"{\"a\": [[[1]],[2]]}", "a: has rows of different lengths"},
        {"{\"a\": [\"1\"]}", "a: holds something that is not a number"},
        {"{\"a\": {\"x\": 1}}", "a: holds an object"},
        {"{\"a\": [[[[[[[[[1]]]]]]]]]}", "a: is nested too deeply"},
        {"[1,2]", "not an object"},
        {"3", "not an object"},
        {"{\"a\": [NaN]}", "no JSON from byte 8 on"},
        {"{\"a\": [1", "no JSON from byte"},
    };
    for (const auto& row : rows) {
        const auto read = read_json_arrays(row.text, kNames);
        EXPECT_NE(message(read).find(row.part), std::string::npos) << row.text << message(read);
    }
}

}  // namespace
}  // namespace raks::motion::npz_test
