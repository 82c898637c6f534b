#include "apps/raks_train/genre_features.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <utility>

#include "audio/beat/network/beat_network.hpp"
#include "audio/genre/genre_file.hpp"
#include "audio/io/audio_file.hpp"
#include "audio/music/damage/genre_augmentation.hpp"
#include "audio/music/damage/sound_damage.hpp"
#include "base/hash.hpp"
#include "base/parallel.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

constexpr int kChunk = 70;
constexpr std::size_t kReportEvery = 20;  // recordings

/// Seconds that this thread has computed.
double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// What hearing a recording took, in seconds.
struct Cost {
    double music = 0.0;              // its length
    double feature_plan = 0.0;       // computed: reading and hearing it as it is
    double altering = 0.0;           // computed: making the altered copies
    double extracting_copies = 0.0;  // computed
    Cost& operator+=(const Cost& other) {
        music += other.music;
        feature_plan += other.feature_plan;
        altering += other.altering;
        extracting_copies += other.extracting_copies;
        return *this;
    }
};

std::string hex(std::uint64_t number) { return fmt::format("{:016x}", number); }

/// One recording, clean and then its altered copies (a copy depends on the file's name and the
/// seed), or damaged.
Expected<std::vector<audio::PieceFeatures>> extract_file(const audio::MusicFile& file,
                                                         const GenreOptions& options,
                                                         const audio::FeaturePlan& feature_plan,
                                                         audio::Damage damage,
                                                         Cost& cost) {
    double start = thread_seconds();
    const auto lap = [&start] {
        const double before = std::exchange(start, thread_seconds());
        return start - before;
    };
    const auto music = audio::read_all_mono(file.path);
    if (!music) {
        return fail(music.error());
    }
    cost.music = static_cast<double>(music->samples.size()) / music->rate.hertz();
    std::vector<audio::PieceFeatures> pieces;
    const int copies = damage == audio::Damage::none ? options.augmentation.copies : 0;
    for (int copy = 0; copy <= copies; ++copy) {
        std::vector<float> samples = music->samples;
        audio::PieceFeatures& piece = pieces.emplace_back();
        if (auto damaged = audio::damage(damage, music->rate.hertz(), samples); !damaged) {
            return fail(file.path.string() + ": " + damaged.error().message);
        }
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
        (copy == 0 ? cost.feature_plan : cost.extracting_copies) += lap();
        if (copy == 0 && piece.windows.empty()) {
            return fail(file.path.string() + ": is silent or shorter than 1 s");
        }
    }
    return pieces;
}

/// What was kept under this name, or what `make` gives, which is then kept.
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

/// Under which name the cache keeps a recording: another as soon as the file or its hearing is.
std::string name_in_cache(const audio::MusicFile& file,
                          const GenreOptions& options,
                          std::uint64_t feature_plan,
                          audio::Damage damage) {
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
                                                  feature_plan,
                                                  without(options.augmentation.effects),
                                                  damaged)));
}

void print_cost(const Cost& cost, const GenreOptions& options) {
    if (cost.music <= 0.0) {
        return;  // all of it was in the cache
    }
    std::fprintf(stderr,
                 "raks: %.1f min of recordings heard in %.1f s of computing",
                 cost.music / 60.0,
                 cost.feature_plan);
    if (options.augmentation.copies > 0) {
        std::fprintf(stderr,
                     "; %d altered copies made in %.1f s, heard in %.1f s",
                     options.augmentation.copies,
                     cost.altering,
                     cost.extracting_copies);
    }
    std::fputc('\n', stderr);
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
    const auto weights = feature_plan.beat_network->parameters();
    const std::uint64_t network =
        hash_of({reinterpret_cast<const char*>(weights.data()), weights.size_bytes()});
    return hash_of(audio::features_text(features), network);
}

std::vector<audio::FeatureUnit> extract_recordings(const std::vector<audio::MusicFile>& files,
                                                   const GenreOptions& options,
                                                   const audio::FeaturePlan& feature_plan,
                                                   audio::Damage damage) {
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
        for (audio::PieceFeatures& piece : unit.pieces) {
            piece.name = file.name;
            piece.group = file.group;
            piece.genre = file.genre;
        }
        // relaxed: only a count for the eye.
        const std::size_t finished = done.fetch_add(1, std::memory_order_relaxed) + 1;
        if (finished % kReportEvery == 0) {
            std::fprintf(stderr,
                         "raks: %zu of %zu recordings heard, %.0f s left\n",
                         finished,
                         own.size(),
                         seconds_since(start) * static_cast<double>(own.size() - finished) /
                             static_cast<double>(finished));
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
    std::uint64_t soundfonts = hash_of("");
    for (const auto& soundfont : plan.soundfonts) {
        soundfonts = hash_of(soundfont.filename().string() + "\n", soundfonts);
    }
    const std::string variant =
        fmt::format("-edition{}-styles{}-{}{}",
                    options.written.edition,
                    hex(fingerprint(options.written.styles)),
                    hex(soundfonts),
                    is_altered ? without(options.augmentation.effects) : std::string());
    std::vector<WrittenChunk> chunks;
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
