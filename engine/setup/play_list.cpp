#include "engine/setup/play_list.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "base/printable.hpp"
#include "engine/setup/list_forms.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

// Larger files are no playlists: a million names of 64 bytes.
constexpr std::size_t kMostListBytes = std::size_t{64} << 20U;

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

char small(char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

// Takes the number at the start of `text`, without leading zeros.
std::string_view take_number(std::string_view& text) {
    std::size_t end = 0;
    while (end < text.size() && is_digit(text[end])) {
        ++end;
    }
    std::string_view number = text.substr(0, end);
    text.remove_prefix(end);
    number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
    return number;
}

// A file or folder by what it is, not by its name.
using Identity = std::pair<dev_t, ino_t>;

std::optional<Identity> identity_of(const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        return std::nullopt;
    }
    return Identity{status.st_dev, status.st_ino};
}

// Gathers what a list of names stands for.
class Gathering {
 public:
    /// A name of the command line.
    void add_given(const fs::path& name);
    [[nodiscard]] PlayList take() && { return std::move(list_); }

 private:
    void add_file(const fs::path& path);
    void add_folder(const fs::path& folder);
    void add_list(const fs::path& path, ListForm form);
    void add_entry(const ListEntry& entry, const fs::path& list);
    void skip(const fs::path& path, std::string_view why);
    [[nodiscard]] bool is_first_visit(const fs::path& path);

    PlayList list_;
    // Folders and lists that the name of the command line has led to: each is read once.
    std::set<Identity> visited_;
    bool is_full_ = false;
};

void Gathering::skip(const fs::path& path, std::string_view why) {
    list_.skipped.add(fmt::format("{}: {}", printable(path.string(), 300), why));
}

bool Gathering::is_first_visit(const fs::path& path) {
    const auto identity = identity_of(path);
    return !identity || visited_.insert(*identity).second;
}

void Gathering::add_file(const fs::path& path) {
    if (list_.files.size() < kMostFiles) {
        list_.files.push_back(path);
    } else if (!std::exchange(is_full_, true)) {
        skip(path,
             fmt::format("is one of more than {} files; it and the rest are left out", kMostFiles));
    }
}

constexpr std::string_view kNoNetwork =
    "is an address in the network, from where Raks loads nothing; save it as a file";

void Gathering::add_given(const fs::path& name) {
    std::error_code ignored;
    // The same folder may be named twice, to be played twice.
    visited_.clear();
    const std::string text = name.string();
    if (!scheme_of(text).empty() && !is_there(name)) {
        return skip(name, kNoNetwork);
    }
    const fs::path path = is_there(name) ? name : fs::path(file_of_address(text));
    if (fs::is_directory(path, ignored)) {
        const std::size_t before = list_.files.size() + list_.skipped.count();
        static_cast<void>(is_first_visit(path));
        add_folder(path);
        // A folder without music is rather a mistake than nothing to play.
        if (list_.files.size() + list_.skipped.count() == before) {
            skip(path, "no music in this folder");
        }
    } else if (const auto form = list_form_of(path)) {
        static_cast<void>(is_first_visit(path));
        add_list(path, *form);
    } else {
        add_file(path);
    }
}

void Gathering::add_folder(const fs::path& folder) {
    auto inside = list_folder(folder);
    if (!inside) {
        list_.skipped.add(inside.error().message);
        return;
    }
    std::erase_if(*inside,
                  [](const fs::path& path) { return path.filename().string().starts_with('.'); });
    std::sort(inside->begin(), inside->end(), [](const fs::path& a, const fs::path& b) {
        return comes_before(a.filename().native(), b.filename().native());
    });
    std::error_code ignored;
    for (const fs::path& path : *inside) {
        if (looks_like_music(path) && fs::is_regular_file(path, ignored)) {
            add_file(path);
        }
    }
    for (const fs::path& path : *inside) {
        if (is_full_ || !fs::is_directory(path, ignored)) {
            continue;
        }
        if (is_first_visit(path)) {
            add_folder(path);
        } else {
            skip(path, "leads back to a folder that is listed already");
        }
    }
}

void Gathering::add_list(const fs::path& path, ListForm form) {
    const auto bytes = read_file(path, kMostListBytes);
    if (!bytes) {
        list_.skipped.add(bytes.error().message);
        return;
    }
    const auto list = parse_list(*bytes, form);
    if (!list) {
        return skip(path, list.error().message);
    }
    if (list->entries.empty()) {
        return skip(path, "this playlist is empty");
    }
    for (const ListEntry& entry : list->entries) {
        if (is_full_) {
            return;
        }
        add_entry(entry, path);
    }
    if (list->is_cut) {
        skip(path, fmt::format("has more than {} entries; the rest is left out", kMostListEntries));
    }
}

// Other programs write backslashes, and percent signs for blanks. The name itself comes first.
std::vector<std::string> spellings_of(const std::string& name) {
    std::vector<std::string> spellings = {name};
    const std::string decoded = percent_decoded(name);
    if (decoded != name && decoded.find('\0') == std::string::npos) {
        spellings.push_back(decoded);
    }
    if (name.find('\\') != std::string::npos) {
        std::string slashed = name;
        std::replace(slashed.begin(), slashed.end(), '\\', '/');
        spellings.push_back(std::move(slashed));
    }
    return spellings;
}

// Where an entry of a list lies; nothing where it is not there.
std::optional<fs::path> place_of(const ListEntry& entry, const fs::path& list) {
    for (const std::string& name : entry) {
        for (const std::string& spelling : spellings_of(file_of_address(name))) {
            const fs::path path = list.parent_path() / spelling;
            if (is_there(path)) {
                return path;
            }
        }
    }
    return std::nullopt;
}

void Gathering::add_entry(const ListEntry& entry, const fs::path& list) {
    const auto place = place_of(entry, list);
    if (!place) {
        const bool is_address = !scheme_of(entry.front()).empty();
        // The last spelling is the one that can be read.
        const std::string& name = is_address ? entry.front() : entry.back();
        return skip(name,
                    is_address ? std::string(kNoNetwork)
                               : fmt::format("is not there (named by {})",
                                             printable(list.filename().string(), 100)));
    }
    std::error_code ignored;
    const auto form = list_form_of(*place);
    if (fs::is_directory(*place, ignored)) {
        return is_first_visit(*place)
                   ? add_folder(*place)
                   : skip(*place, "leads back to a folder that is listed already");
    }
    if (!fs::is_regular_file(*place, ignored)) {
        return skip(*place, "is not a plain file");
    }
    if (!form) {
        return add_file(*place);
    }
    if (!is_first_visit(*place)) {
        return skip(*place, "is named by a playlist that it names itself, or twice");
    }
    add_list(*place, *form);
}

}  // namespace

void SkippedFiles::add(std::string line) {
    ++count_;
    if (lines_.size() < kMostLines) {
        lines_.push_back(std::move(line));
    }
}

std::vector<std::string> SkippedFiles::report() const {
    if (count_ == 0) {
        return {};
    }
    std::vector<std::string> report = {fmt::format("{} skipped:", count_)};
    for (const std::string& line : lines_) {
        report.push_back("  " + line);
    }
    if (count_ > lines_.size()) {
        report.push_back(fmt::format("  and {} more", count_ - lines_.size()));
    }
    return report;
}

Expected<PlayList> read_play_list(const std::vector<fs::path>& names) {
    Gathering gathering;
    for (const fs::path& name : names) {
        gathering.add_given(name);
    }
    PlayList list = std::move(gathering).take();
    if (list.files.empty()) {
        const std::size_t reasons = list.skipped.count();
        std::string line =
            reasons == 0 ? std::string("no file is named") : list.skipped.lines().front();
        if (reasons > 1) {
            line += fmt::format(" (and {} more; nothing is left to play)", reasons - 1);
        }
        return fail(std::move(line));
    }
    return list;
}

namespace {

constexpr std::array<std::string_view, 45> kMusicEndings = {
    ".3gp",  ".aac", ".ac3", ".aif",  ".aifc", ".aiff", ".amr",  ".ape",  ".au",
    ".avi",  ".caf", ".dsf", ".dts",  ".flac", ".flv",  ".m4a",  ".m4b",  ".m4v",
    ".mka",  ".mkv", ".mov", ".mp2",  ".mp3",  ".mp4",  ".mpc",  ".mpeg", ".mpg",
    ".mpga", ".oga", ".ogg", ".ogv",  ".ogx",  ".opus", ".rf64", ".snd",  ".spx",
    ".tta",  ".w64", ".wav", ".wave", ".weba", ".webm", ".wma",  ".wmv",  ".wv"};

}  // namespace

std::span<const std::string_view> music_endings() noexcept { return kMusicEndings; }

bool looks_like_music(const fs::path& path) {
    // Compared in lower case: "SONG.MP3" is music, too.
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), small);
    return std::find(kMusicEndings.begin(), kMusicEndings.end(), ending) != kMusicEndings.end();
}

bool comes_before(std::string_view a, std::string_view b) noexcept {
    const std::string_view whole_a = a;
    const std::string_view whole_b = b;
    while (!a.empty() && !b.empty()) {
        if (is_digit(a.front()) && is_digit(b.front())) {
            const std::string_view number_a = take_number(a);
            const std::string_view number_b = take_number(b);
            // Of numbers without leading zeros the longer one is larger.
            if (number_a.size() != number_b.size()) {
                return number_a.size() < number_b.size();
            }
            if (number_a != number_b) {
                return number_a < number_b;
            }
            continue;
        }
        const auto letter_a = static_cast<unsigned char>(small(a.front()));
        const auto letter_b = static_cast<unsigned char>(small(b.front()));
        if (letter_a != letter_b) {
            return letter_a < letter_b;
        }
        a.remove_prefix(1);
        b.remove_prefix(1);
    }
    if (a.empty() != b.empty()) {
        return a.empty();
    }
    return whole_a < whole_b;
}

bool is_pipe(const fs::path& path) noexcept {
    std::error_code ignored;
    return path == "-" || fs::is_fifo(path, ignored);
}

}  // namespace raks::engine
