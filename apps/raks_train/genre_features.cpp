#include "apps/raks_train/genre_features.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <string>
#include <utility>

#include "apps/terminal/say.hpp"
#include "audio/beat/network/beat_network.hpp"
#include "audio/genre/genre_file.hpp"
#include "audio/io/audio_file.hpp"
#include "audio/music/damage/sound_augmentation.hpp"
#include "audio/music/damage/sound_damage.hpp"
#include "base/hash.hpp"
#include "base/parallel.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

// Pieces a chunk: what an interrupted run loses at most.
constexpr int kChunk = 70;
// Recordings between two lines of progress.
constexpr std::size_t kReportEvery = 20;

// Processor time of this thread, seconds: threads that wait for one another do not count.
double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Wall-clock time, for the estimate of the time left.
double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// What computing the features of a recording took, in seconds.
struct Cost {
    double music = 0.0;       // its length
    double extracting = 0.0;  // processor time: reading it and computing its features as it is
    double altering = 0.0;    // processor time: making the altered copies
    double extracting_copies = 0.0;  // processor time: computing the copies' features
    Cost& operator+=(const Cost& other) {
        music += other.music;
        extracting += other.extracting;
        altering += other.altering;
        extracting_copies += other.extracting_copies;
        return *this;
    }
};

// Hashes as they stand in names of files: 16 digits.
std::string hex(std::uint64_t number) { return fmt::format("{:016x}", number); }

// Features of one recording: as it is, and then of its altered copies, or, with `damage`, of the
// damaged recording alone. The draws of a copy depend on the file's name, its number and the seed,
// so that the order of the files does not matter.
Expected<std::vector<audio::PieceFeatures>> extract_file(const audio::MusicFile& file,
                                                         const GenreOptions& options,
                                                         const audio::FeaturePlan& feature_plan,
                                                         audio::Damage damage,
                                                         Cost& cost) {
    double start = thread_seconds();
    const auto lap = [&start] {
        // Seconds since the last call of this function.
        const double before = std::exchange(start, thread_seconds());
        return start - before;
    };
    const auto music = audio::read_all_mono(file.path);
    if (!music) {
        return fail(music.error());
    }
    cost.music = static_cast<double>(music->samples.size()) / music->rate.hertz();
    std::vector<audio::PieceFeatures> pieces;
    // Damaged recordings only judge; copies are for training.
    const int copies = damage == audio::Damage::none ? options.augmentation.copies : 0;
    for (int copy = 0; copy <= copies; ++copy) {
        std::vector<float> samples = music->samples;
        audio::PieceFeatures& piece = pieces.emplace_back();
        if (auto damaged = audio::damage(damage, music->rate.hertz(), samples); !damaged) {
            return fail(file.path.string() + ": " + damaged.error().message);
        }
        // Copy 0 is the recording as it is.
        if (copy > 0) {
            Dice dice(options.seed + 1000, hash_of(file.name) + static_cast<std::uint64_t>(copy));
            piece.kind = audio::PieceFeatures::Kind::altered;
            const auto altered = audio::alter_recording(
                music->rate.hertz(), copy, samples, dice, options.augmentation.effects);
            if (!altered) {
                return fail(file.path.string() + ": " + altered.error().message);
            }
            cost.altering += lap();
        }
        if (auto extracted = audio::extract_features(samples, music->rate, feature_plan, piece);
            !extracted) {
            return fail(file.path.string() + ": " + extracted.error().message);
        }
        (copy == 0 ? cost.extracting : cost.extracting_copies) += lap();
        // Too little for one window; a copy is as long as its recording.
        if (copy == 0 && piece.windows.empty()) {
            return fail(file.path.string() + ": is silent or shorter than 1 s");
        }
    }
    return pieces;
}

// The pieces that the cache holds under this name, or those that `make` returns, which are then
// stored.
template <class Make>
Expected<std::vector<audio::PieceFeatures>> cached(const GenreOptions& options,
                                                   const std::string& name,
                                                   const Make& make) {
    const fs::path path = options.cache / (name + ".pieces");
    std::error_code ignored;
    if (!options.cache.empty() && fs::exists(path, ignored)) {
        return audio::load_pieces(path);
    }
    auto pieces = make();
    if (pieces && !options.cache.empty()) {
        if (auto saved = audio::save_pieces(*pieces, path); !saved) {
            return fail(saved.error());
        }
    }
    return pieces;
}

// Name of a recording in the cache. It contains a hash of all that its features depend on: the
// file's name, size and time, the seed, the copies, the way of computing, the effects and the
// damage.
std::string name_in_cache(const audio::MusicFile& file,
                          const GenreOptions& options,
                          std::uint64_t key,
                          audio::Damage damage) {
    // Size and time stand for the content, which is not read for a recording in the cache.
    std::error_code error;
    const auto size = fs::file_size(file.path, error);
    const auto written = fs::last_write_time(file.path, error).time_since_epoch().count();
    const std::string damaged =
        damage == audio::Damage::none
            ? std::string()
            : fmt::format(" {}", audio::kDamageNames[static_cast<std::size_t>(damage)]);
    return "recording-" + hex(hash_of(fmt::format("{} {} {} {} {}/{} {}{}{}",
                                                  file.name,
                                                  size,
                                                  written,
                                                  options.seed,
                                                  options.augmentation.copies,
                                                  audio::kRoomEvery,
                                                  key,
                                                  without(options.augmentation.effects),
                                                  damaged)));
}

// One line about the processor time; nothing when everything came from the cache.
void print_cost(const Cost& cost, const GenreOptions& options) {
    if (cost.music <= 0.0) {
        return;  // all of it was in the cache
    }
    std::string line = fmt::format("{:.1f} min of recordings analyzed in {:.1f} s of computing",
                                   cost.music / 60.0,
                                   cost.extracting);
    if (options.augmentation.copies > 0) {
        line += fmt::format("; {} altered copies made in {:.1f} s, analyzed in {:.1f} s",
                            options.augmentation.copies,
                            cost.altering,
                            cost.extracting_copies);
    }
    say(line);
}

}  // namespace

std::string without(const audio::SoundEffects& effects) {
    std::string suffix;
    for (std::size_t i = 0; i < std::size(audio::kSoundEffectNames); ++i) {
        if (!effects.has(static_cast<audio::SoundEffect>(i))) {
            suffix += fmt::format("-no-{}", audio::kSoundEffectNames[i]);
        }
    }
    return suffix;
}

std::uint64_t feature_key(const audio::FeaturePlan& feature_plan,
                          const audio::GenreFeatures& features) {
    // The weights themselves: a network that was trained anew computes other rhythm features.
    const auto weights = feature_plan.beat_network->parameters();
    const std::uint64_t network =
        hash_of({reinterpret_cast<const char*>(weights.data()), weights.size_bytes()});
    return hash_of(audio::features_text(features), network);
}

std::vector<audio::FeatureUnit> extract_recordings(const std::vector<audio::MusicFile>& files,
                                                   const GenreOptions& options,
                                                   const audio::FeaturePlan& feature_plan,
                                                   audio::Damage damage) {
    // Only this machine's share is computed; units of the others stay empty in their places.
    const std::uint64_t way = feature_key(feature_plan, options.plan.features);
    std::vector<audio::FeatureUnit> units(files.size());
    std::vector<Cost> costs(files.size());
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (options.shards.share.has(i)) {
            own.push_back(i);
        }
    }
    const auto start = std::chrono::steady_clock::now();
    std::atomic<std::size_t> done{0};
    run_parallel(own.size(), options.threads, [&](std::size_t turn) {
        // Each turn writes to its own places: no lock is needed.
        const audio::MusicFile& file = files[own[turn]];
        audio::FeatureUnit& unit = units[own[turn]];
        auto pieces = cached(options, name_in_cache(file, options, way, damage), [&] {
            return extract_file(file, options, feature_plan, damage, costs[own[turn]]);
        });
        if (pieces) {
            unit.pieces = std::move(*pieces);
        } else {
            unit.fault = pieces.error().message;
        }
        // The cache is shared between runs whose lists name and label a file otherwise.
        for (audio::PieceFeatures& piece : unit.pieces) {
            piece.name = file.name;
            piece.group = file.group;
            piece.genre = file.genre;
        }
        // relaxed: a count for the progress line only.
        const std::size_t finished = done.fetch_add(1, std::memory_order_relaxed) + 1;
        if (finished % kReportEvery == 0) {
            say(fmt::format("{} of {} recordings analyzed, {:.0f} s left",
                            finished,
                            own.size(),
                            seconds_since(start) * static_cast<double>(own.size() - finished) /
                                static_cast<double>(finished)));
        }
    });
    Cost all;
    for (const Cost& cost : costs) {
        all += cost;
    }
    print_cost(all, options);
    return units;
}

std::vector<WrittenChunk> chunks_of(const GenreOptions& options,
                                    const audio::FeaturePlan& feature_plan,
                                    const std::string& name,
                                    audio::WrittenCorpusPlan plan) {
    const int all = plan.pieces;
    plan.feature_plan = feature_plan;
    plan.styles = &options.written.styles;
    plan.threads = options.threads;
    plan.effects = options.augmentation.effects;
    plan.edition = static_cast<audio::WrittenCorpusPlan::Edition>(options.written.edition);
    const bool is_altered = plan.augmentation == audio::WrittenCorpusPlan::Augmentation::on;
    // The soundfonts count by name and order: which one a piece gets is drawn from the list.
    std::uint64_t soundfonts = hash_of("");
    for (const auto& soundfont : plan.soundfonts) {
        soundfonts = hash_of(soundfont.filename().string() + "\n", soundfonts);
    }
    // All else that the music depends on, so that the cache does not mix variants.
    const std::string variant =
        fmt::format("-edition{}-styles{}-{}{}",
                    options.written.edition,
                    hex(fingerprint(options.written.styles)),
                    hex(soundfonts),
                    is_altered ? without(options.augmentation.effects) : std::string());
    std::vector<WrittenChunk> chunks;
    // The last chunk may be shorter.
    for (plan.first = 0; plan.first < all; plan.first += kChunk) {
        plan.pieces = std::min(kChunk, all - plan.first);
        chunks.push_back(
            {fmt::format("{}-{}-{}-{}{}", name, plan.seed, plan.first, plan.pieces, variant),
             plan});
    }
    return chunks;
}

Expected<std::vector<audio::PieceFeatures>> extract_chunk(const GenreOptions& options,
                                                          const WrittenChunk& chunk) {
    return cached(options, chunk.name, [&] { return audio::write_corpus(chunk.plan); });
}

}  // namespace raks::apps
