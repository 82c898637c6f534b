#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "audio/music/damage/sound_augmentation.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/dance_list.hpp"
#include "training/genre/feature_shard.hpp"
#include "training/genre/genre_samples.hpp"
#include "training/genre/genre_trainer.hpp"

namespace raks::apps {

/// What `raks train genre` was asked for.
struct GenreOptions {
    std::shared_ptr<const DanceList> dances;  // whose music is told apart
    std::vector<std::string> pair;            // two that are compared
    std::filesystem::path folder;
    std::filesystem::path index;
    std::filesystem::path output;
    std::filesystem::path cache;
    std::filesystem::path beats_corpus;
    std::filesystem::path add_to;                                              // a model
    int sample_kilobytes = static_cast<int>(audio::kMostSampleBytes / 1'000);  // of each genre
    std::string share_text;                                                    // "i/n"
    audio::ShardNumber share;
    std::vector<std::filesystem::path> shards;  // to merge
    std::filesystem::path report;
    int synthesize = 0;
    int edition = 4;          // of the written music
    audio::StyleBook styles;  // that it is written in; loaded where any is asked for
    int test_pieces = 140;
    std::vector<std::filesystem::path> soundfonts;
    std::vector<std::filesystem::path> test_soundfonts;
    std::vector<std::string> left_out;  // genres
    bool is_strict = false;
    bool leaves_out_families = false;
    bool trains_on_free_alone = false;
    std::string judged_labels;  // of clips that the validation judges by; empty: of all
    bool skips_validation = false;
    bool judges_damage = false;  // in the validation
    int altered = 2;
    std::vector<std::string> left_out_effects;  // names of SoundEffect
    audio::SoundEffects effects;
    bool leaves_out_energy = false;
    audio::GenreTrainingPlan plan;
    std::uint64_t seed = 1;
    int threads = 2;
};

}  // namespace raks::apps
