#include "audio/music/styles/style_book.hpp"

#include <algorithm>
#include <iterator>

#include "base/assert.hpp"
#include "base/hash.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::audio {
namespace {

/// Pointers to the rhythms for which is_chosen(rhythm) is true, in their order.
template <class IsChosen>
std::vector<const RhythmStyle*> chosen_from(const std::vector<RhythmStyle>& rhythms,
                                            const IsChosen& is_chosen) {
    std::vector<const RhythmStyle*> chosen;
    for (const RhythmStyle& rhythm : rhythms) {
        if (is_chosen(rhythm)) {
            chosen.push_back(&rhythm);
        }
    }
    return chosen;
}

/// The values by name: names stay when enumerators move.
template <class Enum, std::size_t Count>
std::string names_of(const std::vector<Enum>& values,
                     const std::array<std::string_view, Count>& names) {
    std::string text;
    for (const Enum value : values) {
        text += fmt::format(" {}", names[static_cast<std::size_t>(value)]);
    }
    return text;
}

/// A rhythm as text to be hashed. Names of variable length stand on lines of their own, so that two
/// rhythms cannot run together into one text.
std::string text_of(const RhythmStyle& rhythm) {
    std::string text = fmt::format("{}\n{}\n{} {} {} {} {} {} {} {}\n",
                                   rhythm.name,
                                   rhythm.family,
                                   rhythm.is_for_beats,
                                   rhythm.is_by_machines,
                                   rhythm.lowest_bpm,
                                   rhythm.highest_bpm,
                                   rhythm.beats_per_bar,
                                   rhythm.cell_beats,
                                   rhythm.steps_per_beat,
                                   rhythm.weight);
    // A rhythm without label adds nothing, which differs from a label of the empty dance.
    if (rhythm.label) {
        text += fmt::format("for {} {}\n",
                            rhythm.label->dance,
                            kUseNames[static_cast<std::size_t>(rhythm.label->use)]);
    }
    for (const DrumLane& lane : rhythm.lanes) {
        text += fmt::format("{} {} {}\n", lane.key, lane.pattern, lane.chance);
    }
    return text + names_of(rhythm.bass, kBassLineNames) + "\n" +
           names_of(rhythm.comping, kCompingNames) + "\n";
}

/// A palette as text to be hashed; one without own music counts as having the default's.
std::string text_of(const BandPalette& palette) {
    const OwnMusic own = palette.own.value_or(OwnMusic{});
    return fmt::format("{}\n{}\n{}\n{}\n{}\n{} {} {} {} {} {} {}\n{} {} {} {} {}\n",
                       palette.dance,
                       fmt::join(palette.bass, " "),
                       fmt::join(palette.chords, " "),
                       fmt::join(palette.leads, " "),
                       fmt::join(palette.kits, " "),
                       palette.band_chance,
                       palette.lead_chance,
                       palette.drumless_chance,
                       palette.players.bass,
                       palette.players.chords,
                       palette.players.lead,
                       kMelodyNames[static_cast<std::size_t>(palette.melody)],
                       own.style,
                       own.name,
                       own.lowest_bpm,
                       own.highest_bpm,
                       own.share);
}

}  // namespace

std::vector<const RhythmStyle*> StyleBook::rhythms_for_beats() const {
    return chosen_from(rhythms, [](const RhythmStyle& rhythm) { return rhythm.is_for_beats; });
}

std::vector<const RhythmStyle*> StyleBook::rhythms_for(std::string_view dance) const {
    return chosen_from(rhythms, [dance](const RhythmStyle& rhythm) {
        return rhythm.label && rhythm.label->dance == dance;
    });
}

std::vector<std::string> StyleBook::dances() const {
    std::vector<std::string> dances;
    for (const BandPalette& palette : palettes) {
        // The palette of music for no dance has the empty name.
        if (!palette.dance.empty()) {
            dances.push_back(palette.dance);
        }
    }
    return dances;
}

std::string StyleBook::own_name(std::string_view style) const {
    const auto found = std::find_if(
        corpus_styles.begin(), corpus_styles.end(), [style](const CorpusStyle& corpus_style) {
            return corpus_style.style == style;
        });
    // The name of a style that the book does not mention.
    return found != corpus_styles.end() ? found->name : fmt::format("own {}", style);
}

const BandPalette& StyleBook::palette_of(std::string_view dance) const {
    const auto find = [this](std::string_view name) {
        return std::find_if(palettes.begin(), palettes.end(), [name](const BandPalette& palette) {
            return palette.dance == name;
        });
    };
    const auto own = find(dance);
    // A dance of which no palette knows gets the instruments of music for no dance.
    const auto found = own != palettes.end() ? own : find("");
    RAKS_ASSERT(found != palettes.end());
    return *found;
}

std::optional<DanceLabel> StyleBook::label_of(std::string_view name) const {
    const auto rhythm =
        std::find_if(rhythms.begin(), rhythms.end(), [name](const RhythmStyle& style) {
            return style.label && style.name == name;
        });
    if (rhythm != rhythms.end()) {
        return rhythm->label;
    }
    const auto style = std::find_if(
        corpus_styles.begin(), corpus_styles.end(), [name](const CorpusStyle& corpus_style) {
            // "groove rock" stands for "groove rock-folk", too, but the hyphen is needed.
            return corpus_style.name == name || name.starts_with(corpus_style.name + "-");
        });
    return style == corpus_styles.end() ? std::nullopt
                                        : std::optional(DanceLabel{.dance = style->dance});
}

std::uint64_t fingerprint(const StyleBook& book) {
    // Each text is hashed onto the hash before it, so the order counts, too.
    std::uint64_t hash = hash_of("");
    for (const RhythmStyle& rhythm : book.rhythms) {
        hash = hash_of(text_of(rhythm), hash);
    }
    for (const BandPalette& palette : book.palettes) {
        hash = hash_of(text_of(palette), hash);
    }
    for (const CorpusStyle& style : book.corpus_styles) {
        hash = hash_of(fmt::format("{}\n{}\n{}\n", style.name, style.dance, style.style), hash);
    }
    return hash;
}

}  // namespace raks::audio
