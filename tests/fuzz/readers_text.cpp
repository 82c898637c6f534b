// What is done with texts in tables, lists of beats and playlists.
#include "audio/evaluate/beat_corpus.hpp"
#include "audio/evaluate/event_corpus.hpp"
#include "engine/setup/dance_corrections.hpp"
#include "engine/setup/list_forms.hpp"
#include "motion/figures/label_tables.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {

bool read_labels(std::string_view text) {
    static_cast<void>(motion::parse_labels(text, "x.tsv", motion::BeatsColumn::optional));
    return motion::parse_labels(text, "x.tsv").has_value();
}

bool read_counts(std::string_view text) { return motion::parse_counts(text, "x.tsv").has_value(); }

bool read_take_beats(std::string_view text) {
    return motion::parse_take_beats(text, "x.tsv").has_value();
}

bool read_faults(std::string_view text) { return motion::parse_faults(text, "x.tsv").has_value(); }

bool read_index(std::string_view text) {
    return audio::parse_beat_index(text, "index.tsv").has_value();
}

bool read_dance_corrections(std::string_view text) {
    const auto corrections = engine::DanceCorrections::parse(text, "x.tsv");
    if (!corrections) {
        return false;
    }
    const auto again = engine::DanceCorrections::parse(corrections->to_tsv(), "y.tsv");
    must(again && again->all() == corrections->all());
    return true;
}

bool read_beat_list(std::string_view text) {
    const auto beats = audio::parse_beats(text, "x.beats");
    // What was read can be written and read again.
    must(!beats || audio::parse_beats(audio::beats_text(*beats), "y.beats"));
    return beats.has_value();
}

bool read_event_list(std::string_view text) {
    const auto events = audio::parse_events(text, "x.events");
    if (!events) {
        must_be_one_line(events.error().message);
        return false;
    }
    const auto again = audio::parse_events(audio::events_text(*events), "y.events");
    must(again && again->size() == events->size());
    return true;
}

bool read_playlist(std::string_view text) {
    bool is_good = false;
    for (const auto form : {engine::ListForm::m3u, engine::ListForm::pls, engine::ListForm::xspf}) {
        const auto list = engine::parse_list(text, form);
        if (!list) {
            continue;
        }
        is_good = true;
        for (const engine::ListEntry& entry : list->entries) {
            for (const std::string& name : entry) {
                static_cast<void>(engine::file_of_address(name));
                static_cast<void>(engine::scheme_of(name));
            }
        }
    }
    return is_good;
}

}  // namespace raks::fuzz
