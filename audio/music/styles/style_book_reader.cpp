#include "audio/music/styles/style_book_reader.hpp"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "audio/music/styles/band_palette.hpp"
#include "audio/music/styles/rhythm_reader.hpp"
#include "base/file.hpp"
#include "base/plain_name.hpp"
#include "base/printable.hpp"
#include "base/toml_reader.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = std::size_t{1} << 20U;  // of a file
// Behind every number that a file may give itself.
constexpr int kLastOrder = 10'000;

constexpr NumberRange kChance = {0, 1};
// General MIDI's programs, counted from 0.
constexpr NumberRange kPrograms = {0, 127};
constexpr std::size_t kMostPrograms = 64;

/// The instruments under `key`, which must be there and hold at least one: a part without
/// instrument could not be drawn.
std::vector<int> read_programs(const toml::table& table,
                               std::string_view key,
                               TomlComplaints& complaints) {
    std::vector<int> programs;
    const toml::node* const node =
        complaints.needed(table, key, fmt::format("{} = [program, ...]", key));
    if (node == nullptr) {
        return programs;
    }
    const toml::array* const array = node->as_array();
    if (array == nullptr || array->empty() || array->size() > kMostPrograms) {
        complaints.complain(
            *node,
            fmt::format("{} must be 1 to {} programs of General MIDI, from 0", key, kMostPrograms));
        return programs;
    }
    for (const toml::node& one : *array) {
        programs.push_back(complaints.whole(one, key, kPrograms));
    }
    return programs;
}

/// Chances of the band's players; what the file does not say stays as it is.
void read_players(const toml::table& table, TomlComplaints& complaints, BandChances& players) {
    constexpr std::array<std::string_view, 3> kKeys = {"bass", "chords", "lead"};
    const toml::node* const node = table.get("players");
    if (node == nullptr) {
        return;
    }
    const toml::table* const chances = node->as_table();
    if (chances == nullptr) {
        complaints.complain(*node, "players must be { bass = ..., chords = ..., lead = ... }");
        return;
    }
    // An unknown key is mostly a misspelt one, so it is a fault.
    complaints.check_keys(*chances, kKeys);
    complaints.read(*chances, "bass", kChance, players.bass);
    complaints.read(*chances, "chords", kChance, players.chords);
    complaints.read(*chances, "lead", kChance, players.lead);
}

/// The generator's music for this dance; nothing where the palette has none.
std::optional<OwnMusic> read_own(const toml::table& table, TomlComplaints& complaints) {
    const toml::node* const node = table.get("own");
    if (node == nullptr) {
        return std::nullopt;
    }
    const toml::table* const own = node->as_table();
    if (own == nullptr) {
        complaints.complain(*node, "own must be { style = ..., name = ..., tempo = [.., ..] }");
        return std::nullopt;
    }
    constexpr std::array<std::string_view, 4> kKeys = {"style", "name", "tempo", "share"};
    complaints.check_keys(*own, kKeys);
    OwnMusic music;
    music.style = complaints.text(*own, "style");
    music.name = complaints.text(*own, "name");
    // Both are used to find and to name such pieces.
    for (const std::string* const name : {&music.style, &music.name}) {
        if (name->empty()) {
            complaints.complain(*node, "own needs style = \"...\" and name = \"...\"");
        } else if (!is_plain_name(*name)) {
            complaints.complain(*node, why_no_plain_name(*name));
        }
    }
    if (const auto* const tempo = complaints.needed(*own, "tempo", "tempo = [lowest, highest]")) {
        // The same limits as for rhythms.
        const auto range =
            complaints.numbers<2>(*tempo, "tempo", {30.0, 300.0}, "[lowest, highest] in BPM");
        if (range[0] > range[1]) {
            complaints.complain(*tempo, "tempo: the lowest must come first");
        }
        music.lowest_bpm = range[0];
        music.highest_bpm = range[1];
    }
    complaints.read(*own, "share", kChance, music.share);
    return music;
}

/// Reads one [[palette]] of a file of styles. Faults go to `complaints`; after one, the result is
/// not to be used.
BandPalette read_palette(const toml::table& table, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 11> kKeys = {"dance",
                                                        "melody",
                                                        "bass",
                                                        "chords",
                                                        "leads",
                                                        "kits",
                                                        "band_chance",
                                                        "lead_chance",
                                                        "drumless_chance",
                                                        "players",
                                                        "own"};
    BandPalette palette;
    const std::string dance = complaints.text(table, "dance");
    if (dance.empty()) {
        complaints.complain(table, "a palette needs dance = \"...\", or \"none\"");
    } else if (!is_plain_name(dance)) {
        complaints.complain(table, "dance: " + why_no_plain_name(dance));
    }
    // Every complaint from here on names the palette.
    complaints.enter(fmt::format("palette of \"{}\"", dance));
    complaints.check_keys(table, kKeys);
    palette.dance = dance_named(dance);
    if (const auto* const melody = complaints.needed(table, "melody", "melody = \"...\"")) {
        // The word's index in kMelodyNames is the enumerator.
        palette.melody = static_cast<Melody>(complaints.word(*melody, "melody", kMelodyNames));
    }
    palette.bass = read_programs(table, "bass", complaints);
    palette.chords = read_programs(table, "chords", complaints);
    palette.leads = read_programs(table, "leads", complaints);
    palette.kits = read_programs(table, "kits", complaints);
    // Chances are optional: the defaults are those of BandPalette.
    complaints.read(table, "band_chance", kChance, palette.band_chance);
    complaints.read(table, "lead_chance", kChance, palette.lead_chance);
    complaints.read(table, "drumless_chance", kChance, palette.drumless_chance);
    read_players(table, complaints, palette.players);
    palette.own = read_own(table, complaints);
    return palette;
}

/// A file as TOML, before what it says is read.
struct StyleFile {
    std::string name;
    int order = kLastOrder;
    toml::table root;
};

/// Format, version and top-level keys: a file of another kind is told from one with a fault.
void check_head(const toml::table& root, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 8> kKeys = {"format",
                                                       "version",
                                                       "order",
                                                       "beat_training",
                                                       "machines",
                                                       "rhythm",
                                                       "palette",
                                                       "corpus_style"};
    // Shown to the user when the key is missing.
    const std::string form = fmt::format("format = \"{}\"", kStylesFormat);
    const toml::node* const format = complaints.needed(root, "format", form);
    if (format != nullptr && complaints.text(root, "format") != kStylesFormat) {
        complaints.complain(*format, fmt::format("format must be \"{}\"", kStylesFormat));
    }
    const toml::node* const version =
        complaints.needed(root, "version", fmt::format("version = {}", kStylesVersion));
    const auto number = version != nullptr ? version->value_exact<std::int64_t>() : std::nullopt;
    if (version != nullptr && (!number || *number < 1 || *number > kStylesVersion)) {
        complaints.complain(
            *version,
            fmt::format("version must be a number up to {}; is Raks older than the file?",
                        kStylesVersion));
    }
    // Behind the version: a newer file may have keys that are unknown here.
    complaints.check_keys(root, kKeys);
}

/// Parses one file and reads its head; what it holds is read once the files are in order.
Expected<StyleFile> parse_file(const StyleText& text) {
    auto root = parse_toml(text.text, text.name);
    if (!root) {
        return fail(root.error());
    }
    StyleFile file{text.name, kLastOrder, std::move(*root)};
    TomlComplaints complaints(text.name);
    check_head(file.root, complaints);
    if (const toml::node* const order = file.root.get("order")) {
        file.order = complaints.whole(*order, "order", {0, kLastOrder - 1});
    }
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    return file;
}

/// Gathers the files of one book.
class BookReader {
 public:
    Expected<StyleBook> read(const std::vector<StyleFile>& files, const std::string& name) {
        for (const StyleFile& file : files) {
            if (auto done = read_file(file); !done) {
                return fail(done.error());
            }
        }
        // Only the whole book can tell, since a dance and its palette may be in different files.
        if (auto whole = check_dances(name); !whole) {
            return fail(whole.error());
        }
        return std::move(book_);
    }

 private:
    /// File and line of a name, for errors about two places.
    struct Place {
        std::string file;
        std::size_t line = 0;
    };
    using Places = std::map<std::string, Place, std::less<>>;

    /// Adds a file's rhythms, palettes and corpus styles to the book.
    Expected<void> read_file(const StyleFile& file) {
        TomlComplaints complaints(file.name);
        // Flags stand at a file's top and hold for all of its rhythms.
        const bool is_for_beats = read_flag(file.root, "beat_training", true, complaints);
        const bool is_by_machines = read_flag(file.root, "machines", false, complaints);
        for_each_table(file.root, "rhythm", complaints, [&](const toml::table& table) {
            RhythmStyle rhythm = read_rhythm(table, complaints);
            rhythm.is_for_beats = is_for_beats;
            rhythm.is_by_machines = is_by_machines;
            note_once({file.name, line_of(table, "name")}, rhythm.name, complaints, rhythms_);
            if (rhythm.label) {
                // The first mention is kept, for the error about a dance without a palette.
                dances_.emplace(rhythm.label->dance, Place{file.name, line_of(table, "dance")});
            }
            book_.rhythms.push_back(std::move(rhythm));
        });
        for_each_table(file.root, "palette", complaints, [&](const toml::table& table) {
            BandPalette palette = read_palette(table, complaints);
            note_once({file.name, line_of(table, "dance")}, palette.dance, complaints, palettes_);
            book_.palettes.push_back(std::move(palette));
        });
        for_each_table(file.root, "corpus_style", complaints, [&](const toml::table& table) {
            read_corpus_style(table, file.name, complaints);
        });
        return complaints.is_sound() ? Expected<void>{} : fail(complaints.fault());
    }

    /// A truth value that need not be there.
    static bool read_flag(const toml::table& root,
                          std::string_view key,
                          bool otherwise,
                          TomlComplaints& complaints) {
        const toml::node* const node = root.get(key);
        if (node != nullptr && !node->is_boolean()) {
            complaints.complain(*node, fmt::format("{} must be true or false", key));
        }
        return node == nullptr ? otherwise : node->value_or(otherwise);
    }

    /// Calls read(table) for each [[key]] until something is wrong.
    template <class Read>
    static void for_each_table(const toml::table& root,
                               std::string_view key,
                               TomlComplaints& complaints,
                               const Read& read) {
        const toml::node* const node = root.get(key);
        if (node == nullptr) {
            return;
        }
        const toml::array* const array = node->as_array();
        if (array == nullptr || !array->is_homogeneous(toml::node_type::table)) {
            complaints.complain(*node,
                                fmt::format("{} must be tables, each under [[{}]]", key, key));
            return;
        }
        for (const toml::node& one : *array) {
            complaints.enter("");
            if (!complaints.is_sound()) {
                return;
            }
            read(*one.as_table());
        }
        complaints.enter("");
    }

    /// Adds one [[corpus_style]].
    void read_corpus_style(const toml::table& table,
                           const std::string& file,
                           TomlComplaints& complaints) {
        constexpr std::array<std::string_view, 3> kKeys = {"name", "dance", "style"};
        complaints.check_keys(table, kKeys);
        CorpusStyle style{complaints.text(table, "name"),
                          complaints.text(table, "dance"),
                          complaints.text(table, "style")};
        if (style.name.empty() || style.dance.empty()) {
            complaints.complain(table, "a corpus_style needs name = \"...\" and dance = \"...\"");
        }
        style.dance = dance_named(style.dance);
        dances_.emplace(style.dance, Place{file, line_of(table, "dance")});
        book_.corpus_styles.push_back(std::move(style));
    }

    /// Line of a key, or of the table where it does not have the key.
    static std::size_t line_of(const toml::table& table, std::string_view key) {
        const toml::node* const node = table.get(key);
        return (node != nullptr ? *node : table).source().begin.line;
    }

    /// Complains when a name was given before, and says where.
    static void note_once(Place place,
                          const std::string& name,
                          TomlComplaints& complaints,
                          Places& places) {
        // Read before `place` is moved from.
        const std::size_t line = place.line;
        const auto [other, is_new] = places.emplace(name, std::move(place));
        if (!is_new) {
            complaints.complain(line,
                                fmt::format("is there twice, first in {}, line {}",
                                            other->second.file,
                                            other->second.line));
        }
    }

    /// Fails unless every dance that is named has a palette, and so has music for none of them.
    Expected<void> check_dances(const std::string& name) const {
        std::vector<std::string_view> known;
        // Only for the suggestion of the nearest name.
        for (const auto& [dance, place] : palettes_) {
            known.push_back(dance.empty() ? "none" : std::string_view(dance));
        }
        if (!palettes_.contains("")) {
            return fail(name + ": no file has a [[palette]] with dance = \"none\"");
        }
        for (const auto& [dance, place] : dances_) {
            if (!palettes_.contains(dance)) {
                return fail(fmt::format("{}: line {}: no [[palette]] has this dance: {}",
                                        place.file,
                                        place.line,
                                        unknown_name("dance", dance, known)));
            }
        }
        return {};
    }

    StyleBook book_;
    Places rhythms_;
    Places palettes_;
    Places dances_;  // where each was named first
};

/// Parses every file, puts them in order and reads the book.
Expected<StyleBook> parse_book(std::span<const StyleText> texts, const std::string& name) {
    std::vector<StyleFile> files;
    for (const StyleText& text : texts) {
        auto file = parse_file(text);
        if (!file) {
            return fail(file.error());
        }
        files.push_back(std::move(*file));
    }
    std::stable_sort(files.begin(), files.end(), [](const StyleFile& a, const StyleFile& b) {
        return a.order < b.order;
    });
    return BookReader().read(files, name);
}

}  // namespace

Expected<StyleBook> parse_styles(std::span<const StyleText> files, const std::string& name) {
    auto book = parse_book(files, name);
    if (!book) {  // names in quotes may hold anything
        return fail(printable(book.error().message));
    }
    return book;
}

Expected<StyleBook> load_styles(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> paths;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (entry->path().extension() == ".toml") {
            paths.push_back(entry->path());
        }
    }
    if (error) {
        return fail(folder.string() + ": cannot be listed: " + error.message());
    }
    if (paths.empty()) {
        return fail(folder.string() +
                    ": holds no .toml file, but styles of music are needed there");
    }
    // A folder lists its files in any order; the book's order must not depend on that.
    std::sort(paths.begin(), paths.end());
    std::vector<StyleText> texts;
    for (const fs::path& path : paths) {
        auto text = read_text_file(path, kMostBytes);
        if (!text) {
            return fail(text.error());
        }
        texts.push_back({path.string(), std::move(*text)});
    }
    return parse_styles(texts, folder.string());
}

}  // namespace raks::audio
