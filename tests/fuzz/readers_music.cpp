// What is done with MIDI files and what genre training keeps.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "audio/music/score/midi_scores.hpp"
#include "audio/music/score/score.hpp"
#include "base/dice.hpp"
#include "base/file.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"
#include "training/beat/corpus.hpp"
#include "training/genre/feature_shard.hpp"
#include "training/genre/genre_samples.hpp"

namespace raks::fuzz {
namespace {

constexpr std::size_t kMostStretches = 50;     // of a file that are played
constexpr double kPerformedSeconds = 5.0;      // of each
constexpr std::size_t kSampleBytes = 100'000;  // of each genre, drawn again
constexpr std::size_t kMostBeats = 1'000'000;  // of a stretch: far above an hour's

// As people would play it: the start of what becomes sound.
void play(const audio::Score& score) {
    must(score.bar_position.size() < kMostBeats);
    Dice dice(1, 2);
    const audio::Performance played = audio::perform(score, kPerformedSeconds, dice);
    for (const audio::PlayedNote& note : played.notes) {
        must(std::isfinite(note.time) && note.time >= 0.0 && std::isfinite(note.length));
        must(note.key >= 0 && note.key <= 127 && note.velocity >= 1 && note.velocity <= 127);
    }
    const auto beats = static_cast<int>(score.bar_position.size());
    must(audio::cut_beats(score, beats / 2, beats - beats / 2).bar_position.size() ==
         static_cast<std::size_t>(beats - beats / 2));
}

// As one of the songs of a set. True: it is MIDI.
bool read_song_of(const audio::MidiPackRow& row, std::string_view bytes) {
    const auto stretches = audio::midi_stretches(bytes, row);
    if (!stretches) {
        must_be_one_line(stretches.error().message);
        return false;
    }
    for (std::size_t i = 0; i < std::min(stretches->size(), kMostStretches); ++i) {
        play((*stretches)[i].score);
    }
    return true;
}

bool read_index_of_pack(std::string_view bytes) {
    const MemoryFile file(bytes);
    const auto text = read_text_file(file.path(), bytes.size());
    const auto rows = text ? audio::parse_midi_index(*text, "index.tsv") : fail(text.error());
    if (!rows) {
        must_be_one_line(rows.error().message);
    }
    return rows.has_value();
}

// Features are what networks learn from: numbers.
void must_be_features(const audio::PieceFeatures& piece) {
    for (const float magnitude : piece.mel) {
        must(std::isfinite(magnitude));
    }
}

// A sample of a sample, as when a genre is added to a model.
void draw_again(const audio::GenreSamples& samples) {
    std::vector<const audio::PieceFeatures*> pieces;
    for (const audio::PieceFeatures& piece : samples.pieces) {
        must_be_features(piece);
        pieces.push_back(&piece);
    }
    static_cast<void>(audio::sample_pieces(pieces, samples.genres, kSampleBytes, 1));
}

}  // namespace

bool read_midi(std::string_view bytes) {
    // A pack's index begins otherwise than a MIDI file.
    if (!bytes.starts_with("MThd")) {
        return read_index_of_pack(bytes);
    }
    // A fill has no least length, and its tempo and signature are the index's.
    static_cast<void>(
        read_song_of({"x.mid", "groove", true, 120.0, audio::MidiSignature{}}, bytes));
    return read_song_of({"x.mid", "lieder"}, bytes);
}

bool read_genre_samples(std::string_view bytes) {
    const MemoryFile file(bytes);
    if (const auto samples = audio::load_samples(file.path())) {
        draw_again(*samples);
        return true;
    }
    // What else training keeps: shares of the features, all features, the corpus of the beats.
    if (const auto shard = audio::load_shard(file.path())) {
        const std::vector<std::filesystem::path> alone = {file.path()};
        static_cast<void>(audio::merge_shards(alone));
        return true;
    }
    if (const auto pieces = audio::load_pieces(file.path())) {
        for (const audio::PieceFeatures& piece : *pieces) {
            must_be_features(piece);
        }
        return true;
    }
    return audio::load_corpus(file.path()).has_value();
}

}  // namespace raks::fuzz
