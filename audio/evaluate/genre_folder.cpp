#include "audio/evaluate/genre_folder.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <system_error>
#include <utility>

#include "audio/evaluate/table_cells.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestIndex = std::size_t{16} << 20U;  // bytes
constexpr std::string_view kOther = "other";  // label of music for none of the dances

// The allowed labels for an error message: "salsa (latin), house or other".
std::string labels_of(const DanceList& dances) {
    std::string text;
    for (const DanceInfo& dance : dances.all()) {
        text += (text.empty() ? "" : ", ") + dance.name;
        if (!dance.labels.empty()) {
            text += fmt::format(" ({})", fmt::join(dance.labels, ", "));
        }
    }
    return fmt::format("{} or {}", text, kOther);
}

// Lines without their ends. Empty ones are kept, so that index + 1 is the number in the file.
std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r')) {
            line.remove_suffix(1);
        }
        lines.push_back(line);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return lines;
}

// The head line of a table: where each column is.
class Head {
 public:
    explicit Head(std::string_view line) {
        const auto cells = cells_of(line);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            columns_.emplace(cells[i], i);
        }
        count_ = cells.size();
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] bool has(std::string_view name) const { return columns_.contains(name); }
    // The cell of a column; empty where the table has no such column.
    [[nodiscard]] std::string cell(const std::vector<std::string_view>& cells,
                                   std::string_view name) const {
        const auto found = columns_.find(name);
        return found == columns_.end() ? std::string() : std::string(cells[found->second]);
    }

 private:
    std::map<std::string_view, std::size_t> columns_;
    std::size_t count_ = 0;
};

// One row of the table as a file. The error names the allowed labels, not the line.
Expected<MusicFile> file_of(const Head& head,
                            const std::vector<std::string_view>& cells,
                            const fs::path& folder,
                            const DanceList& dances) {
    const std::string label = head.cell(cells, "genre");
    const auto genre = genre_from_label(label, dances);
    if (!genre) {
        return fail(fmt::format("genre '{}' must be {}", label, labels_of(dances)));
    }
    MusicFile file;
    file.name = head.cell(cells, "clip");
    file.path = folder / file.name;
    file.genre = *genre;
    // Files by one artist must not be divided between training and validation: a model would
    // recognise the artist's sound instead of the genre.
    // The same holds for a game or an album, where the table names groups.
    file.group = file.name;
    for (const char* const column : {"artist", "group"}) {
        if (head.has(column)) {
            file.group = head.cell(cells, column);
        }
    }
    file.label = head.cell(cells, "label");
    file.may_train = !head.has("train_ok") || head.cell(cells, "train_ok") == "yes";
    if (head.has("artist")) {
        file.credit = head.cell(cells, "artist");
        if (const std::string title = head.cell(cells, "title"); !title.empty()) {
            file.credit += ", " + title;
        }
        if (const std::string licence = head.cell(cells, "licence"); !licence.empty()) {
            file.credit += " (" + licence + ")";
        }
    }
    return file;
}

}  // namespace

std::optional<std::string> genre_from_label(std::string_view label, const DanceList& dances) {
    if (label == kOther) {
        return std::string();
    }
    for (const DanceInfo& dance : dances.all()) {
        const auto& labels = dance.labels;
        if (dance.name == label || std::find(labels.begin(), labels.end(), label) != labels.end()) {
            return dance.name;
        }
    }
    return std::nullopt;
}

Expected<std::vector<MusicFile>> list_music(const fs::path& folder, const DanceList& dances) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) {
        return fail(folder.string() + ": no such folder");
    }
    std::vector<MusicFile> files;
    const auto listed = list_folder(folder, ListingDepth::tree);
    if (!listed) {
        return fail(listed.error());
    }
    for (const fs::path& path : *listed) {
        const fs::path inside = path.lexically_relative(folder);
        const bool is_hidden = std::any_of(inside.begin(), inside.end(), [](const fs::path& part) {
            return part.string().starts_with('.');
        });
        if (!fs::is_regular_file(path, error) || is_hidden) {
            continue;
        }
        // The first folder below `folder` names the genre; deeper ones (albums, artists) do not
        // matter.
        const std::string label = inside.begin()->string();
        if (std::next(inside.begin()) == inside.end()) {
            continue;  // beside the genres' folders: lists, licences
        }
        const auto genre = genre_from_label(label, dances);
        if (!genre) {
            return fail(fmt::format(
                "{}: folder '{}' must be named {}", folder.string(), label, labels_of(dances)));
        }
        files.push_back({path, inside.string(), *genre, inside.string(), "", true, ""});
    }
    if (files.empty()) {
        return fail(folder.string() + ": holds no folder of music; it needs one a genre");
    }
    return files;
}

Expected<std::vector<MusicFile>> list_music(const fs::path& folder,
                                            const fs::path& index,
                                            const DanceList& dances) {
    const auto text = read_text_file(index, kLargestIndex);
    if (!text) {
        return fail(text.error());
    }
    const auto lines = lines_of(*text);
    if (lines.empty()) {
        return fail(index.string() + ": is empty");
    }
    const Head head(lines.front());
    for (const char* const column : {"clip", "genre"}) {
        if (!head.has(column)) {
            return fail(fmt::format("{}: line 1 names no column '{}'", index.string(), column));
        }
    }
    std::vector<MusicFile> files;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        // An empty line at the end is usual.
        if (lines[i].empty()) {
            continue;
        }
        const auto cells = cells_of(lines[i]);
        if (cells.size() != head.count()) {
            return fail(fmt::format("{}: line {}: {} columns, the first line has {}",
                                    index.string(),
                                    i + 1,
                                    cells.size(),
                                    head.count()));
        }
        auto file = file_of(head, cells, folder, dances);
        if (!file) {
            return fail(
                fmt::format("{}: line {}: {}", index.string(), i + 1, file.error().message));
        }
        files.push_back(std::move(*file));
    }
    if (files.empty()) {
        return fail(index.string() + ": names no file");
    }
    return files;
}

// Files of different size differ, so only files that share their size are read.
Expected<void> check_distinct(std::span<const MusicFile> files) {
    std::map<std::uintmax_t, std::vector<const MusicFile*>> by_size;
    for (const MusicFile& file : files) {
        std::error_code error;
        const std::uintmax_t size = fs::file_size(file.path, error);
        if (!error) {
            by_size[size].push_back(&file);
        }
    }
    for (const auto& [size, same_size] : by_size) {
        // Hashes, not contents: many WAV files of equal length together may exceed the memory.
        std::map<std::uint64_t, const MusicFile*> by_content;
        for (const MusicFile* file : same_size) {
            const Expected<std::string> content =
                same_size.size() > 1 ? read_file(file->path) : fail("alone in its size");
            if (!content) {
                continue;  // reported when its features are computed
            }
            const auto [found, is_new] = by_content.try_emplace(hash_of(*content), file);
            if (!is_new && found->second->genre != file->genre) {
                return fail(fmt::format("{} and {} are the same file under two genres; remove one",
                                        found->second->path.string(),
                                        file->path.string()));
            }
        }
    }
    return {};
}

}  // namespace raks::audio
