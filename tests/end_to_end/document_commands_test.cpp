// Every command of README and the manual does what it says; what cannot be run here has options
// that the program knows; the reference of commands and settings names all that there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "engine/setup/settings_table.hpp"
#include "tests/end_to_end/manual.hpp"
#include "tests/end_to_end/program_fixture.hpp"

#include <fmt/format.h>

namespace raks::test {
namespace {

namespace fs = std::filesystem;

using Names = std::set<std::string>;

std::string text_of(const std::string& document) {
    const auto text = read_file(fs::path(RAKS_SOURCE_DIR) / document);
    EXPECT_TRUE(text) << document;
    return text.value_or("");
}

/// All long options in a text.
Names options_in(const std::string& text) {
    static const std::regex kOption("--[a-z][a-z-]*");
    return {std::sregex_token_iterator(text.begin(), text.end(), kOption),
            std::sregex_token_iterator()};
}

/// Described once, for all commands.
bool is_of_every_command(const std::string& option) {
    return option == "--help" || option == "--quiet" || option == "--verbose";
}

/// What `raks COMMAND --help` lists.
struct Help {
    Names options;
    Names commands;
};

/// Options stand at the start of a line, before their description; commands in a list of their own.
Help read_help(const std::string& text) {
    static const std::regex kGap(" {2,}| (Needs|Excludes): ");
    Help help;
    bool are_commands = false;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const bool is_entry = line.starts_with("  ") && line.size() > 2 && line[2] != ' ';
        if (line.ends_with(':')) {
            are_commands = line == "Subcommands:";
        } else if (is_entry && are_commands) {
            help.commands.insert(line.substr(2, line.find(' ', 2) - 2));
        } else if (is_entry && line[2] == '-') {
            const std::string entry = line.substr(2);
            help.options.merge(
                options_in(*std::sregex_token_iterator(entry.begin(), entry.end(), kGap, -1)));
        }
    }
    return help;
}

/// The lines of a help's list of commands, each with what it does, sorted.
std::set<std::string> lines_of_commands(const std::string& help) {
    const std::size_t begin = help.find("Subcommands:\n");
    std::istringstream lines(help.substr(std::min(begin, help.size())));
    std::set<std::string> commands;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("  ")) {
            commands.insert(line);
        }
    }
    return commands;
}

class DocumentCommands : public ProgramTest {
 protected:
    /// Of a command; asked for once.
    const Help& help_of(const std::vector<std::string>& command) {
        const auto known = helps_.find(command);
        if (known != helps_.end()) {
            return known->second;
        }
        std::vector<std::string> arguments = command;
        arguments.emplace_back("--help");
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << fmt::format("{}", fmt::join(arguments, " "));
        return helps_[command] = read_help(result.out);
    }

    /// What is wrong with a command's names; empty: nothing.
    std::string fault_of(const std::vector<std::string>& words) {
        std::vector<std::string> command;
        Names known = help_of(command).options;
        for (const std::string& word : words) {
            const Help& help = help_of(command);
            if (help.commands.contains(word)) {
                command.push_back(word);
                known.merge(Names(help_of(command).options));
            } else if (command.empty() && std::islower(static_cast<unsigned char>(word[0])) != 0) {
                return word + " is no command";
            } else {
                break;
            }
        }
        for (const std::string& word : words) {
            for (const std::string& option : options_in(word)) {
                if (!known.contains(option)) {
                    return option + " is no option of it";
                }
            }
        }
        return {};
    }

    /// In the test's folder.
    void run_here(const ManualCommand& command) const {
        ProcessPlan here = plan(without_window(command.words));
        here.folder = folder_.path().string();
        const ProcessResult result = run_process(here);
        EXPECT_EQ(result.exit_code, 0) << command.said() << "\n" << result.err;
    }

 private:
    std::map<std::vector<std::string>, Help> helps_;
};

/// Those lines are run by teach_dance_test.cpp, which looks at what comes out of them.
bool is_run_elsewhere(const ManualCommand& command) {
    return command.document == "README.md" && command.section == "Teach it a dance";
}

std::vector<ManualCommand> commands_to_run(const std::string& document) {
    std::vector<ManualCommand> commands = commands_of(document);
    std::erase_if(commands, [](const ManualCommand& command) {
        return !command.is_run || is_run_elsewhere(command);
    });
    return commands;
}

std::vector<std::string> documents_to_run() {
    std::vector<std::string> documents = manual_documents();
    std::erase_if(documents,
                  [](const std::string& document) { return commands_to_run(document).empty(); });
    return documents;
}

/// "docs_using_dancer_md"
std::string test_name(const ::testing::TestParamInfo<std::string>& document) {
    return std::regex_replace(document.param, std::regex("[^A-Za-z0-9]"), "_");
}

class DocumentRun : public DocumentCommands, public ::testing::WithParamInterface<std::string> {};

TEST_P(DocumentRun, does_every_command) {
    write_manual_files(folder_.path());
    draw_small_pictures();
    for (const ManualCommand& command : commands_to_run(GetParam())) {
        if (command.words == std::vector<std::string>{"config", "init"}) {
            fs::remove(folder_ / "config" / "raks" / "config.toml");  // it writes over none
        }
        run_here(command);
    }
}

INSTANTIATE_TEST_SUITE_P(Manual, DocumentRun, ::testing::ValuesIn(documents_to_run()), test_name);

TEST_F(DocumentCommands, are_run_in_most_places) {
    std::size_t runs = 0;
    for (const std::string& document : manual_documents()) {
        runs += commands_to_run(document).size();
    }
    EXPECT_GE(runs, 50U);
}

TEST_F(DocumentCommands, that_cannot_be_run_here_have_options_that_there_are) {
    std::size_t checked = 0;
    for (const std::string& document : manual_documents()) {
        for (const ManualCommand& command : commands_of(document)) {
            EXPECT_EQ(fault_of(command.words), "") << command.said();
            checked += command.is_run ? 0 : 1;
        }
    }
    EXPECT_GE(checked, 80U);
}

TEST_F(DocumentCommands, with_a_wrong_name_are_found) {
    EXPECT_EQ(fault_of({"play", "song.mp3", "--dance", "waltz"}), "");
    EXPECT_EQ(fault_of({"play", "--danse", "waltz"}), "--danse is no option of it");
    EXPECT_EQ(fault_of({"paly", "song.mp3"}), "paly is no command");
    EXPECT_EQ(fault_of({"eval", "beats", "--role=lead"}), "--role is no option of it");
    EXPECT_EQ(fault_of({"train", "genre", "merge", "1.shard", "-o", "x.json", "--units", "8"}), "");
}

TEST_F(DocumentCommands, of_other_programs_are_all_known_to_raks) {
    for (const auto& [command, program] :
         {std::pair{"train", RAKS_TRAIN_PROGRAM}, std::pair{"capture", RAKS_CAPTURE_PROGRAM}}) {
        if (*program == '\0') {
            continue;  // a build without it
        }
        ProcessPlan theirs = plan({"--help"});
        theirs.command.front() = program;
        const auto commands = lines_of_commands(run_process(theirs).out);
        EXPECT_GE(commands.size(), 4U) << program;
        EXPECT_EQ(lines_of_commands(run({command, "--help"}).out), commands);
    }
}

/// The lines of a page's list: "- `--start S`, `--duration S`: ...", without what stands behind.
std::string list_of(const std::string& section) {
    std::string heads;
    std::istringstream lines(section);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("- `")) {
            heads += line.substr(0, line.find("`: ")) + "\n";
        }
    }
    return heads;
}

/// Those of the reference of settings that are not of one command alone: "| `--calm`, `--no-calm`
/// |".
Names options_of_settings() {
    static const std::regex kCell("\\| `--[^|]*\\|");
    const std::string page = text_of("docs/reference/settings.md");
    Names names;
    for (std::sregex_iterator at(page.begin(), page.end(), kCell), end; at != end; ++at) {
        names.merge(options_in(at->str()));
    }
    return names;
}

TEST_F(DocumentCommands, and_their_options_are_all_in_the_reference) {
    static const std::regex kHeading("\n## ([^\n]*)\n");
    const std::string page = text_of("docs/reference/commands.md");
    const Names common = options_of_settings();
    Names described;
    for (std::sregex_iterator at(page.begin(), page.end(), kHeading), end; at != end; ++at) {
        const std::string title = (*at)[1];
        const auto begin = static_cast<std::size_t>(at->position() + at->length());
        const std::string section = page.substr(begin, page.find("\n## ", begin) - begin);
        const Names listed = options_in(list_of(section));
        if (!title.starts_with("raks ")) {
            continue;
        }
        described.insert(title);
        std::istringstream words(title.substr(5));
        const Help& help = help_of({std::istream_iterator<std::string>(words), {}});
        for (const std::string& option : listed) {
            EXPECT_TRUE(help.options.contains(option)) << title << " has no " << option;
        }
        for (const std::string& option : help.options) {
            EXPECT_TRUE(is_of_every_command(option) || listed.contains(option) ||
                        common.contains(option))
                << "docs/reference/commands.md: " << title << ": " << option << " is missing";
        }
    }
    for (const std::string& command : help_of({}).commands) {
        const Help& help = help_of({command});
        if (help.commands.empty()) {
            EXPECT_TRUE(described.contains("raks " + command)) << command;
        }
        for (const std::string& second : help.commands) {
            EXPECT_TRUE(described.contains("raks " + command + " " + second)) << second;
        }
    }
}

/// What stands in place of one that a setting takes; nothing: any text and both truth values are
/// taken.
std::optional<std::string> wrong_value_of(const engine::SettingRow& row) {
    if (row.range.high > row.range.low) {
        return fmt::format("{}", row.range.high + 1.0);
    }
    const auto words = row.words.all();
    return words.empty() ? std::nullopt : std::optional(std::string(words.front()) + "_");
}

TEST_F(DocumentCommands, have_the_options_of_their_settings) {
    const std::pair<engine::SettingCommands, const char*> commands[] = {{engine::kPlay, "play"},
                                                                        {engine::kLive, "live"},
                                                                        {engine::kRender, "render"},
                                                                        {engine::kDance, "dance"},
                                                                        {engine::kSheet, "sheet"}};
    for (const auto& [command, name] : commands) {
        for (const engine::SettingRow& row : engine::setting_rows()) {
            const std::string option(row.option.name);
            const bool has_option = (row.option.commands & command) != 0;
            EXPECT_TRUE(!has_option || help_of({name}).options.contains(option))
                << name << " " << option;
        }
    }
}

TEST_F(DocumentCommands, set_what_their_options_are_the_settings_of) {
    for (const engine::SettingRow& row : engine::setting_rows()) {
        const auto wrong = wrong_value_of(row);
        if (!wrong || row.option.name.empty()) {
            continue;
        }
        const bool is_of_film = (row.option.commands & engine::kRender) != 0;
        std::vector<std::string> words =
            is_of_film ? std::vector<std::string>{"render", "-o", path("x.mp4")}
                       : std::vector<std::string>{"play", "--headless"};
        words.insert(words.end(), {std::string(row.option.name), *wrong});
        expect_one_line(words, 2, engine::full_name(row));
    }
}

}  // namespace
}  // namespace raks::test
