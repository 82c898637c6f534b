#include "engine/setup/dance_corrections.hpp"

#include <algorithm>
#include <string>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "audio/evaluate/table_cells.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/plain_name.hpp"
#include "base/printable.hpp"
#include "engine/setup/user_folders.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHead = "dance\tartist\tfolder\tsong";
constexpr std::size_t kColumns = 4;

bool has_control_character(std::string_view text) {
    return std::any_of(text.begin(), text.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20U || c == '\x7F';
    });
}

std::string line_of(const DanceCorrection& row) {
    return fmt::format(
        "{}\t{}\t{}\t{}\n", row.dance, row.artist, row.folder.string(), row.song.string());
}

Expected<void> check(const DanceCorrection& row) {
    if (!is_plain_name(row.dance)) {
        return fail(why_no_plain_name(row.dance));
    }
    for (const std::string& text : {row.artist, row.folder.string(), row.song.string()}) {
        if (has_control_character(text)) {
            return fail(printable(text) + ": has a control character in it");
        }
    }
    for (const fs::path& path : {row.folder, row.song}) {
        if (!path.is_absolute()) {
            return fail(fmt::format("\"{}\" is no absolute path", printable(path.string())));
        }
    }
    return {};
}

Expected<DanceCorrection> row_of_line(std::string_view line) {
    const auto cells = audio::cells_of(line);
    if (cells.size() != kColumns) {
        return fail(fmt::format("{} columns, there must be {}", cells.size(), kColumns));
    }
    return DanceCorrection{
        std::string(cells[0]), std::string(cells[1]), fs::path(cells[2]), fs::path(cells[3])};
}

// Of several rows of a song the last one counts. One pass: a file may have 100,000 rows.
void keep_last_of_each_song(std::vector<DanceCorrection>& rows) {
    std::unordered_set<std::string> songs;
    const auto is_older = [&](const DanceCorrection& row) {
        return !songs.insert(row.song.string()).second;
    };
    std::reverse(rows.begin(), rows.end());
    auto kept = rows.begin();
    for (DanceCorrection& row : rows) {
        if (!is_older(row)) {
            std::swap(*kept++, row);
        }
    }
    rows.erase(kept, rows.end());
    std::reverse(rows.begin(), rows.end());
}

}  // namespace

fs::path place_of_song(const fs::path& file) {
    std::error_code error;
    fs::path place = fs::weakly_canonical(fs::absolute(file, error), error);
    return error ? fs::absolute(file, error).lexically_normal() : place;
}

Expected<void> DanceCorrections::set(DanceCorrection correction) {
    if (auto checked = check(correction); !checked) {
        return checked;
    }
    std::erase_if(rows_, [&](const DanceCorrection& row) { return row.song == correction.song; });
    rows_.push_back(std::move(correction));
    return {};
}

std::string_view DanceCorrections::of_song(const fs::path& file) const {
    const fs::path song = place_of_song(file);
    const auto found = std::find_if(
        rows_.begin(), rows_.end(), [&](const DanceCorrection& row) { return row.song == song; });
    return found == rows_.end() ? std::string_view() : std::string_view(found->dance);
}

std::vector<std::pair<std::string, int>> DanceCorrections::of_album(std::string_view artist,
                                                                    const fs::path& file) const {
    std::vector<std::pair<std::string, int>> dances;
    const fs::path folder = place_of_song(file).parent_path();
    for (const DanceCorrection& row : rows_) {
        if (artist.empty() || row.artist != artist || row.folder != folder) {
            continue;
        }
        const auto known = std::find_if(dances.begin(), dances.end(), [&](const auto& dance) {
            return dance.first == row.dance;
        });
        if (known == dances.end()) {
            dances.emplace_back(row.dance, 1);
        } else {
            ++known->second;
        }
    }
    return dances;
}

Expected<DanceCorrections> DanceCorrections::parse(std::string_view text, const std::string& name) {
    DanceCorrections corrections;
    std::size_t number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (++number == 1) {
            if (line != kHead) {
                return fail(name +
                            ": line 1: must name the columns dance, artist, folder and song; this "
                            "is another kind of file");
            }
            continue;
        }
        if (line.empty()) {
            continue;
        }
        auto row = row_of_line(line);
        const auto checked = row ? check(*row) : fail(row.error());
        if (!checked) {
            return fail(fmt::format("{}: line {}: {}", name, number, checked.error().message));
        }
        corrections.rows_.push_back(std::move(*row));
    }
    keep_last_of_each_song(corrections.rows_);
    return corrections;
}

Expected<DanceCorrections> DanceCorrections::load() {
    const fs::path file = path();
    if (file.empty() || !is_there(file)) {
        return DanceCorrections();
    }
    const auto text = read_text_file(file, kMostBytes);
    return text ? parse(*text, file.string()) : fail(text.error());
}

std::string DanceCorrections::to_tsv() const {
    std::string rows;
    std::size_t bytes = kHead.size() + 1;
    auto first = rows_.end();
    for (; first != rows_.begin(); --first) {
        bytes += line_of(*std::prev(first)).size();
        if (bytes > kMostBytes) {
            break;
        }
    }
    std::string text(kHead);
    text += '\n';
    for (; first != rows_.end(); ++first) {
        text += line_of(*first);
    }
    return text;
}

Expected<void> DanceCorrections::save() const {
    const fs::path file = path();
    if (file.empty()) {
        return fail("there is no folder to keep it in: set HOME or XDG_STATE_HOME");
    }
    auto made = make_folders(file.parent_path());
    return made ? write_file(file, to_tsv()) : made;
}

fs::path DanceCorrections::path() {
    const fs::path folder = xdg_folder("XDG_STATE_HOME", ".local/state");
    return folder.empty() ? folder : folder / "dances.tsv";
}

KeptCorrections::KeptCorrections(DanceCorrections corrections)
    : now_(std::make_shared<const DanceCorrections>(std::move(corrections))) {}

std::shared_ptr<const DanceCorrections> KeptCorrections::now() const {
    const std::lock_guard lock(mutex_);
    return now_;
}

// Another program of the same person may have kept one meanwhile.
Expected<void> KeptCorrections::keep(DanceCorrection correction) {
    auto corrections = DanceCorrections::load();
    if (!corrections) {
        return fail(std::move(corrections.error()));
    }
    if (auto set = corrections->set(std::move(correction)); !set) {
        return set;
    }
    if (auto saved = corrections->save(); !saved) {
        return saved;
    }
    const std::lock_guard lock(mutex_);
    now_ = std::make_shared<const DanceCorrections>(std::move(*corrections));
    return {};
}

std::string keep_dance(KeptCorrections& kept, const DanceToKeep& wish) {
    if (wish.dance.empty()) {
        return "no dance is kept: choose one first (D)";
    }
    if (std::find(wish.known.begin(), wish.known.end(), wish.dance) == wish.known.end()) {
        return wish.dance + " is not kept: no model tells it from music yet (raks train genre)";
    }
    const fs::path song = place_of_song(wish.song);
    const fs::path folder = song.parent_path();
    const std::string artist = printable(wish.artist);
    if (auto done = kept.keep({wish.dance, artist, folder, song}); !done) {
        return fmt::format("{} is not kept: {}", wish.dance, done.error().message);
    }
    if (artist.empty()) {
        return wish.dance + " is kept for this song";
    }
    const fs::path name = folder.has_filename() ? folder.filename() : folder;
    return fmt::format(
        "{} is kept for this song, and for {} in {}", wish.dance, artist, printable(name.string()));
}

}  // namespace raks::engine
