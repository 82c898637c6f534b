#include "apps/terminal/manual_page.hpp"

#include <algorithm>
#include <cctype>
#include <span>
#include <string_view>
#include <utility>

#include "apps/terminal/option_words.hpp"
#include "apps/terminal/roff.hpp"
#include "base/pending_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

// "raks play": "raks-play".
std::string page_name(const CLI::App& command) {
    std::string name = full_name(command);
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

std::string in_capitals(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
        return static_cast<char>(std::toupper(c));
    });
    return text;
}

std::string heading(std::string_view title) { return fmt::format(".SH {}\n", title); }
std::string entry(std::string_view term, std::string_view text) {
    return fmt::format(".TP\n{}\n{}\n", term, text);
}

// The program itself, and not `raks train`, which is one, too.
bool is_raks(const CLI::App& command) { return full_name(command) == "raks"; }

// Its help begins with its name: "raks: an avatar that ...".
std::string help_of(const CLI::App& command) {
    const std::string help = command.get_description();
    return help.substr(is_raks(command) ? std::string_view("raks: ").size() : 0);
}

// Commands of another program: `raks train figure`.
bool is_of_other_program(const CLI::App& command) {
    const auto inner = commands_of(command);
    return !inner.empty() && inner.front()->get_prefix_command();
}

// "raks play [OPTIONS] [files]..."
std::string usage_of(const CLI::App& command) {
    std::string usage = roff_bold(full_name(command)) + " [" + roff_italic("OPTION") + "]...";
    if (command.get_parent() == nullptr) {
        usage += " " + roff_italic("COMMAND");
    }
    for (const CLI::Option* option : positionals_of(command)) {
        const std::string name = roff_italic(option->get_name(true));
        usage += option->get_required() ? " " + name : " [" + name + "]";
        usage += option->get_items_expected_max() > 1 ? "..." : "";
    }
    return usage + "\n";
}

// The commands that can be given, in the order of their tables: of `genre`, below which there is
// `merge`, both.
std::vector<const CLI::App*> whole_commands(const CLI::App& command) {
    std::vector<const CLI::App*> whole;
    if (command.get_require_subcommand_min() == 0) {
        whole.push_back(&command);
    }
    for (const CLI::App* inner : commands_of(command)) {
        const auto below = whole_commands(*inner);
        whole.insert(whole.end(), below.begin(), below.end());
    }
    return whole;
}

std::string synopsis_of(const CLI::App& command) {
    std::string text;
    for (const CLI::App* whole : whole_commands(command)) {
        text += (text.empty() ? "" : ".br\n") + usage_of(*whole);
    }
    return text;
}

// "-o, --out X.png"
std::string term_of(const CLI::Option& option) {
    if (option.get_positional()) {
        return roff_italic(option.get_name(true));
    }
    std::string term;
    for (const std::string& name : names_of(option)) {
        term += (term.empty() ? "" : ", ") + roff_bold(name);
    }
    if (!has_value(option)) {
        return term;
    }
    const auto choices = choices_of(option);
    return term + " " +
           (choices.empty() ? roff_italic(placeholder_of(option))
                            : roff_bold(fmt::format("{}", fmt::join(choices, "|"))));
}

using Names = std::vector<std::string>;

// Those of engine::SettingCommands: elsewhere an option of the same name is about one file.
bool has_settings(const CLI::App& command) {
    constexpr std::string_view kCommands[] = {
        "raks play", "raks live", "raks render", "raks dance", "raks sheet"};
    return std::find(std::begin(kCommands), std::end(kCommands), full_name(command)) !=
           std::end(kCommands);
}

std::string text_of(const CLI::App& command,
                    const CLI::Option& option,
                    const ManualSources& sources) {
    std::string text = option.get_description();
    text += text.empty() || text.ends_with('.') ? "" : ".";
    if (const std::string range = range_of(option); !range.empty()) {
        text += " Range: " + range + ".";
    }
    text += option.get_required() ? " Required." : "";
    for (const CLI::Option* other : option.get_needs()) {
        text += " Only with " + other->get_name() + ".";
    }
    for (const CLI::Option* other : option.get_excludes()) {
        text += " Not with " + other->get_name() + ".";
    }
    for (const std::string& name : has_settings(command) ? names_of(option) : Names()) {
        if (const std::string setting = sources.setting_of(name); !setting.empty()) {
            text += " Setting: " + setting + ".";
            break;
        }
    }
    return roff_of_markdown(text);
}

std::string paragraphs_of(const CLI::App& command, const ManualSources& sources) {
    std::string text;
    const auto paragraphs =
        is_raks(command) ? sources.introduction() : sources.description(full_name(command));
    for (const std::string& paragraph : paragraphs) {
        text += (text.empty() ? "" : ".PP\n") + roff_of_markdown(paragraph) + "\n";
    }
    return text.empty() ? roff_text(help_of(command)) + ".\n" : text;
}

std::string options_text(const CLI::App& command, const ManualSources& sources) {
    std::string text;
    for (const auto& options : {positionals_of(command), options_of(command)}) {
        for (const CLI::Option* option : options) {
            text += entry(term_of(*option), text_of(command, *option, sources));
        }
    }
    return text;
}

// Each command below it, with its options.
std::string commands_text(const CLI::App& command, const ManualSources& sources) {
    std::string text;
    for (const CLI::App* inner : whole_commands(command)) {
        if (inner != &command) {
            text += fmt::format(".SS {}\n{}{}",
                                roff_text(full_name(*inner)),
                                paragraphs_of(*inner, sources),
                                options_text(*inner, sources));
        }
    }
    return text;
}

// Each command with the page that describes it.
std::string list_of_commands(const CLI::App& program) {
    std::string text;
    for (const CLI::App* command : commands_of(program)) {
        const std::string page = page_name(*command);
        const std::string package =
            is_of_other_program(*command) ? ", in the package " + roff_text(page) : "";
        text += entry(fmt::format("\\fB{}\\fP(1)", roff_text(page)),
                      roff_text(command->get_description()) + package + ".");
    }
    return text;
}

std::string examples_text(const CLI::App& command, const ManualSources& sources) {
    constexpr std::size_t kMost = 8;
    std::string text;
    for (const ManualExample& example : sources.examples(full_name(command), kMost)) {
        std::string remark = example.remark;
        if (!remark.empty()) {
            remark += remark.ends_with('?') ? "" : ":";
            remark[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(remark[0])));
        }
        text += fmt::format(".PP\n{}.RS 4\n.EX\n{}\n.EE\n.RE\n",
                            remark.empty() ? "" : roff_of_markdown(remark) + "\n",
                            roff_text(example.command));
    }
    return text.empty() ? "" : heading("EXAMPLES") + text;
}

std::string rows_text(std::string_view title, const std::vector<ManualRow>& rows) {
    std::string text = heading(title);
    for (const ManualRow& row : rows) {
        text +=
            entry("\\fB" + roff_of_markdown(row.term) + "\\fP", roff_of_markdown(row.text) + ".");
    }
    return text;
}

// Of a page with several windows each has a part of its own.
std::string keys_text(const CLI::App& command, const ManualSources& sources) {
    const auto windows = sources.keys(full_name(command));
    std::string text;
    for (const auto& [window, rows] : windows) {
        const std::string list = rows_text("", rows).substr(heading("").size());
        text += (windows.size() > 1 ? ".SS raks " + roff_text(window) + "\n" : "") + list;
    }
    return text.empty() ? "" : heading("KEYS") + text;
}

constexpr std::pair<std::string_view, std::string_view> kExitCodes[] = {
    {"0", "done"},
    {"1", "the work failed: one line on standard error says what, where and what to do"},
    {"2", "wrong usage"},
    {"3", "done, but some of the inputs were skipped"},
    {"130, 143", "stopped by a signal; what was finished is kept"},
};

std::string exit_codes_text() {
    std::string text = heading("EXIT STATUS");
    for (const auto& [code, meaning] : kExitCodes) {
        text += entry(roff_bold(code), fmt::format("{}.", roff_text(meaning)));
    }
    return text;
}

}  // namespace

std::string manual_page(const CLI::App& command, const ManualSources& sources) {
    const bool is_program = is_raks(command);
    const std::string name = roff_text(page_name(command));
    std::string page =
        fmt::format(".TH {} 1 \"\" \"raks {}\" \"Raks\"\n", in_capitals(name), RAKS_VERSION);
    page += heading("NAME") + fmt::format("{} \\- {}\n", name, roff_text(help_of(command)));
    page += heading("SYNOPSIS") + (is_program ? usage_of(command) : synopsis_of(command));
    page += heading("DESCRIPTION") + paragraphs_of(command, sources);
    if (is_program) {
        page += heading("COMMANDS") + list_of_commands(command);
    } else if (!commands_of(command).empty()) {
        page += heading("COMMANDS") + commands_text(command, sources);
    }
    page += heading("OPTIONS") + options_text(command, sources);
    page += keys_text(command, sources);
    if (is_program) {
        page += rows_text("SETTINGS", sources.settings()) + rows_text("FILES", sources.folders());
    }
    page += examples_text(command, sources) + exit_codes_text();
    page += heading("SEE ALSO") +
            (is_program ? "" : "\\fBraks\\fP(1) for files and settings.\n.PP\n") +
            "The manual of which this is a part lies in \\fIshare/doc/raks\\fP below where Raks is "
            "installed.\n";
    return page;
}

Expected<void> write_manual(const CLI::App& program, const fs::path& folder, const fs::path& tree) {
    const auto sources = ManualSources::read(tree);
    if (!sources) {
        return fail(sources.error());
    }
    std::vector<const CLI::App*> commands = {&program};
    if (is_raks(program)) {
        for (const CLI::App* command : commands_of(program)) {
            if (!is_of_other_program(*command)) {
                commands.push_back(command);
            }
        }
    }
    std::error_code problem;
    fs::create_directories(folder, problem);
    for (const CLI::App* command : commands) {
        const fs::path file = folder / (page_name(*command) + ".1");
        if (auto written = write_file(file, manual_page(*command, *sources)); !written) {
            return written;
        }
    }
    return {};
}

std::optional<ManualWish> manual_wish(int argc, const char* const* argv) {
    const std::span<const char* const> words(argv, static_cast<std::size_t>(argc));
    if (words.size() != 4 || std::string_view(words[1]) != "--write-manual") {
        return std::nullopt;
    }
    return ManualWish{words[2], words[3]};
}

}  // namespace raks::apps
