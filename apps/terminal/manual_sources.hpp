#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::apps {

/// A command that a document shows, and what it says beside it: "keep to one dance".
struct ManualExample {
    std::string command;
    std::string remark;  ///< empty: none
};

/// A line of a list: keys, a file or a setting, and what is said of it, both in Markdown.
struct ManualRow {
    std::string term;
    std::string text;
};

/// What the documents of the source tree say of commands. The reference describes each, its keys
/// and settings, and all documents show some: tests compare the one with the program's tables and
/// run the others (tests/end_to_end/document_commands_test.cpp).
class ManualSources {
 public:
    /// Reads README.md, docs/using and docs/reference of a source tree. Errors: one of them is not
    /// there.
    [[nodiscard]] static Expected<ManualSources> read(const std::filesystem::path& tree);

    /// What the program is: README's first paragraph.
    [[nodiscard]] std::vector<std::string> introduction() const;
    /// The paragraphs of the reference on a command, "raks play", in Markdown, without its list of
    /// options; empty: it has none.
    [[nodiscard]] std::vector<std::string> description(std::string_view command) const;
    /// At most `most` commands that begin so, those with a remark first.
    [[nodiscard]] std::vector<ManualExample> examples(std::string_view command,
                                                      std::size_t most) const;
    /// The keys of its windows, "raks capture", each window's below its name: "capture label".
    [[nodiscard]] std::map<std::string, std::vector<ManualRow>> keys(
        std::string_view command) const;
    /// All settings: "picture.theme", and what it does with its default.
    [[nodiscard]] std::vector<ManualRow> settings() const;
    /// The setting of an option, "--theme"; empty: it has none.
    [[nodiscard]] std::string setting_of(const std::string& option) const;
    /// Folders and what lies in them.
    [[nodiscard]] std::vector<ManualRow> folders() const;

 private:
    void find_examples(const std::string& document);
    void find_settings();

    std::string readme_;
    std::string commands_;
    std::string keys_;
    std::string settings_page_;
    std::vector<ManualRow> settings_;
    std::map<std::string, std::string> settings_of_options_;
    std::vector<ManualExample> examples_;
};

}  // namespace raks::apps
