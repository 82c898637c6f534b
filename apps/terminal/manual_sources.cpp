#include "apps/terminal/manual_sources.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <regex>
#include <sstream>
#include <utility>

#include "base/file.hpp"

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

std::string without_spaces_around(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \n");
    const std::size_t end = text.find_last_not_of(" \n");
    return begin == std::string_view::npos ? "" : std::string(text.substr(begin, end + 1 - begin));
}

// "raks play song.mp3     # window and sound".
std::optional<ManualExample> example_in(const std::string& line) {
    if (!line.starts_with("raks ")) {
        return std::nullopt;
    }
    const std::size_t remark = line.find(" # ");
    ManualExample example{without_spaces_around(line.substr(0, remark)), ""};
    if (remark != std::string::npos) {
        example.remark = without_spaces_around(line.substr(remark + 3));
    }
    return example;
}

// What follows the heading, up to the next one.
std::string section_of(const std::string& document, std::string_view heading) {
    const std::string line = "\n## " + std::string(heading) + "\n";
    const std::size_t at = document.find(line);
    if (at == std::string::npos) {
        return {};
    }
    const std::size_t begin = at + line.size();
    return document.substr(begin, document.find("\n## ", begin) - begin);
}

using Cells = std::vector<std::string>;

// The lines of a table, without those of its head.
std::vector<Cells> table_in(const std::string& text) {
    std::vector<Cells> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("| ") && !line.starts_with("|-")) {
            continue;
        }
        Cells cells;
        for (std::size_t at = 1; at < line.size();) {
            const std::size_t end = std::min(line.find('|', at), line.size());
            cells.push_back(without_spaces_around(line.substr(at, end - at)));
            at = end + 1;
        }
        rows.push_back(std::move(cells));
    }
    rows.erase(rows.begin(), rows.begin() + std::min<std::ptrdiff_t>(2, std::ssize(rows)));
    return rows;
}

// Keys and what they do: the last two columns, or the first and what stands in the others.
std::vector<ManualRow> keys_in(const std::string& section) {
    std::vector<ManualRow> keys;
    const bool has_actions = section.find("| action |") != std::string::npos;
    for (const Cells& cells : table_in(section)) {
        const std::size_t first = has_actions ? 1 : 0;
        ManualRow row{cells.size() > first ? cells[first] : "", ""};
        for (std::size_t i = first + 1; i < cells.size(); ++i) {
            const bool is_new = !cells[i].empty() && cells[i] != row.text;
            row.text += is_new ? (row.text.empty() ? "" : "; ") + cells[i] : "";
        }
        keys.push_back(std::move(row));
    }
    return keys;
}

// "`raks play [FILES...]`: plays files ..." becomes "Plays files ...": the page says the rest
// above.
std::string without_usage(std::string paragraph) {
    const std::size_t usage = paragraph.find("`: ");
    if (paragraph.starts_with("`raks") && usage != std::string::npos) {
        paragraph.erase(0, usage + 3);
        paragraph[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(paragraph[0])));
    }
    return paragraph;
}

}  // namespace

Expected<ManualSources> ManualSources::read(const fs::path& tree) {
    std::vector<fs::path> documents;
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator(tree / "docs/using", problem)) {
        documents.push_back(entry.path());
    }
    std::sort(documents.begin(), documents.end());
    ManualSources sources;
    for (const auto& [page, name] :
         {std::pair{&sources.readme_, "README.md"},
          std::pair{&sources.commands_, "docs/reference/commands.md"},
          std::pair{&sources.keys_, "docs/reference/keys.md"},
          std::pair{&sources.settings_page_, "docs/reference/settings.md"}}) {
        auto text = read_file(tree / name);
        if (!text) {
            return fail(std::move(text.error()));
        }
        *page = std::move(*text);
    }
    documents.insert(documents.begin(), tree / "README.md");
    documents.push_back(tree / "docs/reference/commands.md");
    for (const fs::path& document : documents) {
        const auto text = read_file(document);
        if (!text) {
            return fail(text.error());
        }
        sources.find_examples(*text);
    }
    sources.find_settings();
    return sources;
}

void ManualSources::find_examples(const std::string& document) {
    std::istringstream lines(document);
    bool is_of_shell = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("```")) {
            is_of_shell = line.starts_with("```sh");
        } else if (auto example = is_of_shell ? example_in(line) : std::nullopt) {
            examples_.push_back(std::move(*example));
        }
    }
}

std::vector<std::string> ManualSources::introduction() const {
    std::istringstream lines(readme_);
    std::string paragraph;
    for (std::string line; std::getline(lines, line);) {
        const bool is_text = !line.empty() && line.front() != '#' && line.front() != '!';
        if (is_text) {
            paragraph += (paragraph.empty() ? "" : "\n") + line;
        } else if (!paragraph.empty()) {
            break;
        }
    }
    return {paragraph};
}

std::vector<std::string> ManualSources::description(std::string_view command) const {
    std::vector<std::string> paragraphs;
    std::istringstream lines(section_of(commands_, command));
    bool is_text = true;  // no list, table or code
    bool is_new = true;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("- ") || line.starts_with("|") || line.starts_with("```")) {
            is_text = false;
        }
        if (line.empty()) {
            is_text = is_new = true;
        } else if (is_text && std::exchange(is_new, false)) {
            paragraphs.push_back(without_usage(line));
        } else if (is_text) {
            paragraphs.back() += "\n" + line;
        }
    }
    return paragraphs;
}

std::vector<ManualExample> ManualSources::examples(std::string_view command,
                                                   std::size_t most) const {
    std::vector<ManualExample> chosen;
    for (const ManualExample& example : examples_) {
        const bool is_of_it =
            example.command == command || example.command.starts_with(std::string(command) + " ");
        const bool is_whole = !example.command.ends_with('\\');
        const bool is_known = std::any_of(chosen.begin(), chosen.end(), [&](const auto& other) {
            return other.command == example.command;
        });
        if (is_of_it && is_whole && !is_known) {
            chosen.push_back(example);
        }
    }
    std::stable_partition(
        chosen.begin(), chosen.end(), [](const auto& example) { return !example.remark.empty(); });
    chosen.resize(std::min(chosen.size(), most));
    return chosen;
}

std::map<std::string, std::vector<ManualRow>> ManualSources::keys(std::string_view command) const {
    // "## In the window of `play` and `live`": each name that is of the command.
    static const std::regex kHeading("\n## (In the window of [^\n]*)\n");
    static const std::regex kName("`([^`]*)`");
    const std::string name(command.substr(std::min(command.find(' ') + 1, command.size())));
    std::map<std::string, std::vector<ManualRow>> windows;
    for (std::sregex_iterator at(keys_.begin(), keys_.end(), kHeading), end; at != end; ++at) {
        const std::string title = (*at)[1];
        for (std::sregex_iterator word(title.begin(), title.end(), kName); word != end; ++word) {
            const std::string window = (*word)[1];
            if (window == name || window.starts_with(name + " ")) {
                windows[window] = keys_in(section_of(keys_, title));
            }
        }
    }
    return windows;
}

// "| `theme` | `"stage"` | `--theme` | `stage`, ... |", below a line "| **[picture]** | | | |".
void ManualSources::find_settings() {
    static const std::regex kOption("--[a-z-]+");
    std::string section;
    const std::string page = settings_page_.substr(0, settings_page_.find("\n## "));
    for (const Cells& cells : table_in(page)) {
        if (cells.size() != 4) {
            continue;
        }
        if (cells[0].starts_with("**[")) {
            section = cells[0].substr(3, cells[0].find(']') - 3);
        } else if (!section.empty()) {
            const std::string name = section + "." + cells[0].substr(1, cells[0].size() - 2);
            settings_.push_back({name, cells[3] + ". Default: " + cells[1]});
            const std::string& options = cells[2];
            for (std::sregex_iterator at(options.begin(), options.end(), kOption), end; at != end;
                 ++at) {
                settings_of_options_[at->str()] = name;
            }
        }
    }
}

std::vector<ManualRow> ManualSources::settings() const { return settings_; }

std::string ManualSources::setting_of(const std::string& option) const {
    const auto found = settings_of_options_.find(option);
    return found == settings_of_options_.end() ? "" : found->second;
}

std::vector<ManualRow> ManualSources::folders() const {
    std::vector<ManualRow> folders;
    for (const Cells& cells : table_in(section_of(settings_page_, "Folders"))) {
        if (cells.size() == 2) {
            folders.push_back({cells[0], cells[1]});
        }
    }
    return folders;
}

}  // namespace raks::apps
