// What is done with texts in tables, lists of beats and playlists.
#include "audio/evaluate/beat_corpus.hpp"
#include "engine/setup/list_forms.hpp"
#include "motion/figures/label_tables.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {

void read_labels(std::string_view text) {
    static_cast<void>(motion::parse_labels(text, "x.tsv"));
    static_cast<void>(motion::parse_labels(text, "x.tsv", motion::BeatsColumn::optional));
}

void read_counts(std::string_view text) { static_cast<void>(motion::parse_counts(text, "x.tsv")); }

void read_faults(std::string_view text) { static_cast<void>(motion::parse_faults(text, "x.tsv")); }

void read_index(std::string_view text) {
    static_cast<void>(audio::parse_beat_index(text, "index.tsv"));
}

void read_beat_list(std::string_view text) {
    if (const auto beats = audio::parse_beats(text, "x.beats")) {
        if (!audio::parse_beats(audio::beats_text(*beats), "y.beats")) {
            __builtin_trap();
        }
    }
}

void read_playlist(std::string_view text) {
    for (const auto form : {engine::ListForm::m3u, engine::ListForm::pls, engine::ListForm::xspf}) {
        const auto list = engine::parse_list(text, form);
        if (!list) {
            continue;
        }
        for (const engine::ListEntry& entry : list->entries) {
            for (const std::string& name : entry) {
                static_cast<void>(engine::file_of_address(name));
                static_cast<void>(engine::scheme_of(name));
            }
        }
    }
}

}  // namespace raks::fuzz
