#include "apps/terminal/option_words.hpp"

#include <algorithm>
#include <cstddef>

namespace raks::apps {
namespace {

// CLI11 puts the checks of a value behind its type: "TEXT:rgba|y4m", "FLOAT:1..240".
std::string check_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const std::size_t colon = type.find(':');
    return colon == std::string::npos ? "" : type.substr(colon + 1);
}

std::vector<std::string> split(const std::string& text, char by) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(by, at), text.size());
        parts.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return parts;
}

bool is_shown(const CLI::Option& option) { return !option.get_group().empty(); }

}  // namespace

std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) {
        names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        names.push_back("--" + name);
    }
    return names;
}

bool has_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::vector<std::string> choices_of(const CLI::Option& option) {
    for (const std::string& text : {option.get_option_text(), check_of(option)}) {
        if (text.find('|') != std::string::npos && text.find_first_of(" :{") == std::string::npos) {
            return split(text, '|');
        }
    }
    return {};
}

std::string placeholder_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    return type.substr(0, type.find(':'));
}

std::string range_of(const CLI::Option& option) {
    const std::string check = check_of(option);
    return check.find("..") == std::string::npos ? "" : check;
}

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
    return command.get_options(
        [](const CLI::Option* option) { return is_shown(*option) && !names_of(*option).empty(); });
}

std::vector<const CLI::Option*> positionals_of(const CLI::App& command) {
    return command.get_options(
        [](const CLI::Option* option) { return is_shown(*option) && option->get_positional(); });
}

std::vector<const CLI::App*> commands_of(const CLI::App& command) {
    return command.get_subcommands(
        [](const CLI::App* inner) { return !inner->get_group().empty(); });
}

std::string full_name(const CLI::App& command) {
    const CLI::App* const parent = command.get_parent();
    return (parent == nullptr ? "" : full_name(*parent) + " ") + command.get_name();
}

}  // namespace raks::apps
