#include "engine/setup/settings_table.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

#include "base/suggest.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

// A field's value; the row is of that type.
template <typename Value>
Value& value_of(const SettingRow& row, Settings& settings) {
    return settings.*std::get<Value Settings::*>(row.field);
}

// Settings in which this number is another.
Settings with_number(const SettingRow& row, double number) {
    Settings settings;
    if (std::holds_alternative<double Settings::*>(row.field)) {
        value_of<double>(row, settings) = number;
    } else {
        value_of<std::int64_t>(row, settings) = static_cast<std::int64_t>(number);
    }
    return settings;
}

bool is_number(const SettingRow& row) {
    return std::holds_alternative<double Settings::*>(row.field) ||
           std::holds_alternative<std::int64_t Settings::*>(row.field);
}

TEST(SettingsTable, has_each_key_field_and_option_once_and_a_help_for_each) {
    std::set<std::string> keys;
    std::set<SettingField> fields;
    std::set<std::string_view> options;
    for (const SettingRow& row : setting_rows()) {
        EXPECT_TRUE(keys.insert(full_name(row)).second) << full_name(row);
        EXPECT_EQ(&row_of(row.field), &row) << full_name(row);
        EXPECT_FALSE(help_of(row).empty()) << full_name(row);
        EXPECT_EQ(row.option.name.empty(), row.option.commands == 0) << full_name(row);
        if (!row.option.name.empty()) {
            EXPECT_TRUE(row.option.name.starts_with("--")) << full_name(row);
            EXPECT_TRUE(options.insert(row.option.name).second) << full_name(row);
        }
    }
    EXPECT_GE(keys.size(), 30U);
}

TEST(SettingsTable, has_a_range_for_each_number_and_words_for_texts_alone) {
    for (const SettingRow& row : setting_rows()) {
        EXPECT_EQ(row.range.low < row.range.high, is_number(row)) << full_name(row);
        if (!row.words.all().empty()) {
            EXPECT_TRUE(std::holds_alternative<std::string Settings::*>(row.field))
                << full_name(row);
        }
    }
}

TEST(SettingsTable, takes_the_defaults) { EXPECT_EQ(validate({}), std::vector<std::string>()); }

TEST(SettingsTable, takes_every_word_of_a_row_and_names_the_nearest_to_another) {
    for (const SettingRow& row : setting_rows()) {
        const auto words = row.words.all();
        for (const std::string_view word : words) {
            Settings settings;
            value_of<std::string>(row, settings) = word;
            EXPECT_EQ(validate(settings), std::vector<std::string>()) << full_name(row) << word;
            const std::string misspelt = std::string(word) + "_";
            value_of<std::string>(row, settings) = misspelt;
            EXPECT_EQ(validate(settings),
                      std::vector{fmt::format("{} \"{}\" is unknown; did you mean \"{}\"?",
                                              full_name(row),
                                              misspelt,
                                              nearest_name(misspelt, words))});
            EXPECT_EQ(nearest_name(misspelt, words), word);
        }
    }
}

TEST(SettingsTable, takes_numbers_from_one_end_of_the_range_to_the_other) {
    for (const SettingRow& row : setting_rows()) {
        if (!is_number(row)) {
            continue;
        }
        EXPECT_EQ(fault_of(row, with_number(row, row.range.low)), "");
        EXPECT_EQ(fault_of(row, with_number(row, row.range.high)), "");
        EXPECT_EQ(fault_of(row, with_number(row, 0.0)).empty(),
                  row.range.has_zero || (row.range.low <= 0.0 && row.range.high >= 0.0));
        for (const double number :
             {row.range.low - (row.range.has_zero ? 1.5 : 1.0), row.range.high + 1.0}) {
            EXPECT_EQ(validate(with_number(row, number)),
                      std::vector{fmt::format("{} is {}, must be {}{} to {}",
                                              full_name(row),
                                              number,
                                              row.range.has_zero ? "0, or " : "",
                                              row.range.low,
                                              row.range.high)});
        }
        if (std::holds_alternative<double Settings::*>(row.field)) {
            EXPECT_NE(fault_of(row, with_number(row, std::numeric_limits<double>::quiet_NaN())),
                      "");
        }
    }
}

TEST(SettingsTable, says_the_words_where_a_row_has_no_help_of_its_own) {
    EXPECT_EQ(help_of(row_of(&Settings::quality)), "auto, fast or high");
}

}  // namespace
}  // namespace raks::engine
