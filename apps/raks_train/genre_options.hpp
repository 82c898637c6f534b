#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "audio/evaluate/genre_folder.hpp"
#include "audio/music/damage/sound_augmentation.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/dance_list.hpp"
#include "training/genre/feature_shard.hpp"
#include "training/genre/genre_samples.hpp"
#include "training/genre/genre_trainer.hpp"

/// What `raks train genre` was asked for, one struct a stage. Filled by the command line, checked
/// once by check_options, then read only.
namespace raks::apps {

/// Recordings to learn from.
struct RecordingOptions {
    std::filesystem::path folder;              ///< one folder a genre; empty: no recordings
    std::filesystem::path index;               ///< table of the folder's clips, or empty
    std::vector<std::string> left_out_genres;  ///< are not read
    bool trains_on_free_alone = false;         ///< only clips whose train_ok is yes
    bool is_strict = false;                    ///< a file that cannot be read is an error
    std::vector<audio::MusicFile> kept;        ///< songs whose dance a person kept, with --add
};

/// Music that is written, performed and played to learn from.
struct WrittenMusicOptions {
    int pieces = 0;           ///< of all genres together
    int edition = 4;          ///< of the arrangements, 1 to 4: older ones can be made again
    audio::StyleBook styles;  ///< that it is written in; loaded where any is asked for
    std::vector<std::filesystem::path> soundfonts;  ///< one is drawn for each piece
    bool leaves_out_families = false;               ///< one or two rhythms a genre are kept to test
    std::filesystem::path beats_corpus;  ///< music that `raks train beats --corpus` kept, or empty
};

/// Written music that the finished model is tested with.
struct WrittenTestOptions {
    int pieces = 140;                               ///< of each kind of test; 0: none
    std::vector<std::filesystem::path> soundfonts;  ///< that nothing was learnt from
};

/// Damaged copies of the recordings, which are learnt from as well.
struct AugmentationOptions {
    int copies = 2;               ///< of each recording
    audio::SoundEffects effects;  ///< that may happen: all but those left out
};

/// Cross-validation over groups (artists), from which the fusion is fitted.
struct ValidationOptions {
    bool is_skipped = false;        ///< the default fusion is kept
    bool judges_damage = false;     ///< scores damaged copies, too
    std::string judged_labels;      ///< of clips that are scored; empty: all
    std::filesystem::path report;   ///< page that shows how recordings are told apart, or empty
    std::vector<std::string> pair;  ///< two dances that are compared with each other
};

/// Work that several machines share.
struct ShardOptions {
    std::string share_text;                     ///< "i/n" as given, or empty: one machine does all
    audio::ShardNumber share;                   ///< read from share_text
    std::vector<std::filesystem::path> merged;  ///< shards to learn from
};

/// Arguments of `raks train genre`.
struct GenreOptions {
    RecordingOptions recordings;
    WrittenMusicOptions written;
    WrittenTestOptions written_test;
    AugmentationOptions augmentation;
    ValidationOptions validation;
    ShardOptions shards;
    audio::GenreTrainingPlan plan;            ///< of the models themselves
    std::shared_ptr<const DanceList> dances;  ///< whose music is told apart
    std::filesystem::path output;             ///< model to write, or shard with shards.share_text
    std::filesystem::path add_to;             ///< model that is added to, or empty
    bool adds_kept = false;                   ///< learns from the songs that a person kept
    std::filesystem::path tagger_for;         ///< model that gets the tagger's classes, or empty
    std::filesystem::path cache;              ///< folder that keeps features between runs, or empty
    int sample_kilobytes = static_cast<int>(audio::kMostSampleBytes / 1'000);  ///< kept of a genre
    bool leaves_out_energy = false;  ///< MFCC without C0 and its derivatives
    std::uint64_t seed = 1;
    int threads = 2;
};

}  // namespace raks::apps
