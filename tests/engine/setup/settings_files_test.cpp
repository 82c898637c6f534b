// What is written from the table of settings: config/default.toml and the table of
// docs/reference/settings.md. `RAKS_REWRITE=1 ctest --preset release -R SettingsFiles` writes both
// anew.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "engine/setup/settings_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::engine {
namespace {

// The file has this text; or, where it is asked for, gets it.
void expect_text(const std::string& file, const std::string& text) {
    const auto path = std::filesystem::path(RAKS_SOURCE_DIR) / file;
    if (std::getenv("RAKS_REWRITE") != nullptr) {  // NOLINT(concurrency-mt-unsafe)
        const auto written = write_file(path, text);
        ASSERT_TRUE(written) << written.error().message;
    }
    EXPECT_EQ(read_file(path).value_or(""), text);
}

// `auto`, `fast` or `high`.
std::string words_in_markdown(const SettingRow& row) {
    std::string text;
    const auto words = row.words.all();
    for (std::size_t i = 0; i < words.size(); ++i) {
        text += fmt::format("{}`{}`",
                            i == 0                  ? ""
                            : i + 1 == words.size() ? " or "
                                                    : ", ",
                            words[i]);
    }
    return text;
}

// What a setting does, and the range of a number.
std::string what_of(const SettingRow& row) {
    std::string what(!row.manual.empty() ? row.manual : row.help);
    if (what.empty()) {
        what = words_in_markdown(row);
    }
    if (row.range.high > row.range.low) {
        what += fmt::format(
            "; {}{} to {}", row.range.has_zero ? "0, or " : "", row.range.low, row.range.high);
    }
    return what;
}

// `--theme`, where all three that show a dance have it; else `play`, `live --buffer`.
std::string option_of(const SettingRow& row) {
    if (row.option.name.empty()) {
        return {};
    }
    const std::string name(row.option.name);
    if ((row.option.commands & kShows) == kShows) {
        const bool is_flag = std::holds_alternative<bool Settings::*>(row.field);
        return "`" + name + "`" + (is_flag ? ", `--no-" + name.substr(2) + "`" : "");
    }
    std::vector<std::string> commands;
    for (const auto& [command, word] : {std::pair{kPlay, "play"},
                                        {kLive, "live"},
                                        {kRender, "render"},
                                        {kDance, "dance"},
                                        {kSheet, "sheet"}}) {
        if ((row.option.commands & command) != 0) {
            commands.emplace_back(word);
        }
    }
    return fmt::format("`{} {}`", fmt::join(commands, "`, `"), name);
}

// The values of to_toml({}), one a row.
std::vector<std::string> defaults() {
    std::vector<std::string> values;
    std::istringstream lines(to_toml({}));
    for (std::string line; std::getline(lines, line);) {
        const std::size_t begin = line.find(" = ");
        const std::size_t end = line.find("  # ");
        if (begin != std::string::npos && end != std::string::npos) {
            values.push_back(line.substr(begin + 3, end - begin - 3));
        }
    }
    return values;
}

std::string manual_table() {
    std::string text =
        "| key | default | option | what |\n|---|---|---|---|\n"
        "| `format`, `version` | `\"raks-config\"`, 1 | | the file's form |\n";
    const std::vector<std::string> values = defaults();
    const auto rows = setting_rows();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i == 0 || rows[i].section != rows[i - 1].section) {
            text += fmt::format("| **[{}]** | | | |\n", rows[i].section);
        }
        const std::string option = option_of(rows[i]);
        text += fmt::format("| `{}` | `{}` |{}| {} |\n",
                            rows[i].name,
                            values.at(i),
                            option.empty() ? " " : " " + option + " ",
                            what_of(rows[i]));
    }
    return text;
}

TEST(SettingsFiles, the_installed_file_lists_every_key_with_its_default) {
    expect_text("config/default.toml", to_toml({}));
}

TEST(SettingsFiles, the_reference_lists_every_key_with_its_option) {
    const std::string file = "docs/reference/settings.md";
    const auto page = read_file(std::filesystem::path(RAKS_SOURCE_DIR) / file);
    ASSERT_TRUE(page) << page.error().message;
    const std::size_t begin = page->find("| key |");
    const std::size_t end = page->find("\n\n## Folders");
    ASSERT_LT(begin, end);
    ASSERT_LT(end, page->size());
    expect_text(file, page->substr(0, begin) + manual_table() + page->substr(end + 1));
}

}  // namespace
}  // namespace raks::engine
