#include "apps/terminal/completion.hpp"

#include <algorithm>
#include <cstddef>
#include <regex>
#include <set>
#include <string_view>

#include "apps/terminal/option_words.hpp"
#include "base/printable.hpp"

namespace raks::apps {
namespace {

const CLI::App* command_named(const CLI::App& command, const std::string& name) {
    for (const CLI::App* inner : commands_of(command)) {
        if (inner->get_name() == name) {
            return inner;
        }
    }
    return nullptr;
}

const CLI::Option* option_named(const CLI::App& command, const std::string& name) {
    for (const CLI::Option* option : options_of(command)) {
        const auto names = names_of(*option);
        if (std::find(names.begin(), names.end(), name) != names.end()) {
            return option;
        }
    }
    return nullptr;
}

// Where the line stands when its last word is typed.
struct Place {
    const CLI::App* command = nullptr;
    const CLI::Option* option = nullptr;  // whose value comes; null: none
    std::size_t positionals = 0;          // that were given
    bool is_behind_dashes = false;        // behind "--", where nothing is an option
};

void take(Place& place, const std::string& word) {
    if (place.option != nullptr) {
        place.option = nullptr;  // its value
        return;
    }
    if (!place.is_behind_dashes && word == "--") {
        place.is_behind_dashes = true;
    } else if (!place.is_behind_dashes && word.size() > 1 && word.front() == '-') {
        const CLI::Option* const option = option_named(*place.command, word);
        place.option = option != nullptr && has_value(*option) ? option : nullptr;
    } else if (const CLI::App* inner = command_named(*place.command, word);
               inner != nullptr && place.positionals == 0) {
        place.command = inner;
    } else {
        ++place.positionals;
    }
}

// The endings that a help names: "X.png, a film (.mp4, .avi), or a folder of pictures".
void add_files_of_help(const std::string& help, Candidates& candidates) {
    static const std::regex kEnding("(?:^|[ (A-Z])(\\.[a-z][a-z0-9]*)\\b|(\\.[0-9][a-z]+)\\b");
    static const std::regex kFolder("\\bfolders?\\b|FOLDER");
    static const std::regex kFile("\\bfiles?\\b|FILE");
    for (std::sregex_iterator at(help.begin(), help.end(), kEnding), end; at != end; ++at) {
        candidates.endings.push_back(at->str(1) + at->str(2));  // .png; .3ds
    }
    candidates.has_folders = std::regex_search(help, kFolder);
    candidates.has_files = !candidates.endings.empty() || std::regex_search(help, kFile);
}

Candidates values_of(const CLI::Option& option, const KnownValues& known) {
    Candidates candidates;
    for (const std::string& word : choices_of(option)) {
        candidates.words.push_back({word, ""});
    }
    if (candidates.words.empty()) {
        add_files_of_help(option.get_description(), candidates);
        known(option, candidates);
    }
    return candidates;
}

Candidates names_in(const CLI::App& command) {
    Candidates candidates;
    for (const CLI::Option* option : options_of(command)) {
        for (const std::string& name : names_of(*option)) {
            // The long name says what the short one does, where there is one.
            if (name.starts_with("--") || names_of(*option).size() == 1) {
                candidates.words.push_back({name, option->get_description()});
            }
        }
    }
    return candidates;
}

Candidates words_in(const Place& place, const KnownValues& known) {
    Candidates candidates;
    const auto positionals = positionals_of(*place.command);
    if (!positionals.empty()) {
        const std::size_t last = positionals.size() - 1;
        const bool goes_on = positionals[last]->get_items_expected_max() > 1;
        if (place.positionals <= last || goes_on) {
            candidates = values_of(*positionals[std::min(place.positionals, last)], known);
        }
    }
    if (place.positionals == 0) {
        for (const CLI::App* inner : commands_of(*place.command)) {
            candidates.words.push_back({inner->get_name(), inner->get_description()});
        }
    }
    return candidates;
}

}  // namespace

Candidates complete(const CLI::App& program,
                    std::span<const std::string> words,
                    const KnownValues& known) {
    Place place{.command = &program};
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        take(place, words[i]);
    }
    const std::string word = words.empty() ? "" : words.back();
    if (place.option != nullptr) {
        return values_of(*place.option, known);
    }
    if (place.is_behind_dashes || !word.starts_with('-')) {
        return words_in(place, known);
    }
    if (const std::size_t equals = word.find('='); equals != std::string::npos) {
        const CLI::Option* const option = option_named(*place.command, word.substr(0, equals));
        return option == nullptr ? Candidates() : values_of(*option, known);
    }
    return names_in(*place.command);
}

std::string text_of(const Candidates& candidates) {
    std::string text = candidates.has_files     ? "files"
                       : candidates.has_folders ? "folders"
                                                : "words";
    for (const std::string& ending :
         std::set(candidates.endings.begin(), candidates.endings.end())) {
        text += " " + ending;
    }
    text += "\n";
    for (const Candidate& candidate : candidates.words) {
        text += printable(candidate.word) + "\t" + printable(candidate.help) + "\n";
    }
    return text;
}

std::optional<std::vector<std::string>> words_to_complete(int argc, const char* const* argv) {
    const std::span<const char* const> words(argv, static_cast<std::size_t>(argc));
    if (words.size() < 2 || std::string_view(words[1]) != "--complete") {
        return std::nullopt;
    }
    return std::vector<std::string>(words.begin() + 2, words.end());
}

}  // namespace raks::apps
