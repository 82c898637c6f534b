#include "engine/cli/genre_material.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <utility>

#include "audio/genre/training/genre_augmentation.hpp"
#include "audio/genre/training/sound_damage.hpp"
#include "audio/io/audio_file.hpp"
#include "base/parallel.hpp"

#include <fmt/format.h>

namespace raks::cli {
namespace {

constexpr int kRestShare = 6;  // written pieces a piece by a rhythm that may be left out

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Recordings {
    std::vector<audio::HeardPiece> pieces;
    std::vector<std::string> skipped;  // why
    double seconds = 0.0;              // of music
};

/// One recording: clean, then its altered copies.
Expected<std::vector<audio::HeardPiece>> hear_file(const audio::MusicFile& file,
                                                   std::size_t number,
                                                   const GenreOptions& options,
                                                   const audio::HearingPlan& hearing) {
    const auto music = audio::read_all_mono(file.path);
    if (!music) {
        return fail(music.error());
    }
    std::vector<audio::HeardPiece> pieces;
    for (int copy = 0; copy <= options.altered; ++copy) {
        std::vector<float> samples = music->samples;
        audio::HeardPiece& piece = pieces.emplace_back();
        piece.name = file.name;
        piece.group = file.group;
        piece.genre = file.genre;
        if (copy > 0) {
            audio::Dice dice(options.seed + 1000, number * 64 + static_cast<std::size_t>(copy));
            piece.kind = audio::HeardPiece::Kind::altered;
            if (options.effects.has(audio::SoundEffect::speed)) {
                audio::change_speed(dice.uniform(0.92, 1.08), samples);
            }
            const auto altered =
                audio::augment_for_genre(music->rate.hertz(), samples, dice, options.effects);
            if (!altered) {
                return fail(file.path.string() + ": " + altered.error().message);
            }
        }
        if (auto heard = audio::hear_piece(samples, music->rate, hearing, piece); !heard) {
            return fail(file.path.string() + ": " + heard.error().message);
        }
        if (copy == 0 && piece.windows.empty()) {
            return fail(file.path.string() + ": is silent or shorter than 1 s");
        }
    }
    return pieces;
}

Expected<Recordings> hear_recordings(const std::vector<audio::MusicFile>& files,
                                     const GenreOptions& options,
                                     const audio::HearingPlan& hearing) {
    std::vector<Expected<std::vector<audio::HeardPiece>>> heard(files.size(), fail("not heard"));
    run_parallel(files.size(), options.threads, [&](std::size_t i) {
        heard[i] = hear_file(files[i], i, options, hearing);
    });
    Recordings recordings;
    for (auto& pieces : heard) {
        if (!pieces) {
            recordings.skipped.push_back(pieces.error().message);
            continue;
        }
        std::move(pieces->begin(), pieces->end(), std::back_inserter(recordings.pieces));
    }
    for (const std::string& reason : recordings.skipped) {
        std::fprintf(stderr, "raks: skipped %s\n", reason.c_str());
    }
    if (!recordings.skipped.empty()) {
        std::fprintf(
            stderr, "raks: %zu of %zu files skipped\n", recordings.skipped.size(), files.size());
    }
    if (options.is_strict && !recordings.skipped.empty()) {
        return fail(fmt::format("{} files cannot be read (--strict): {}",
                                recordings.skipped.size(),
                                recordings.skipped.front()));
    }
    return recordings;
}

/// What tells music altered in one way from music altered in another: nothing if all may happen.
std::string without(const audio::SoundEffects& effects) {
    std::string suffix;
    for (std::size_t i = 0; i < std::size(audio::kSoundEffectNames); ++i) {
        if (!effects.has(static_cast<audio::SoundEffect>(i))) {
            suffix += fmt::format("-no-{}", audio::kSoundEffectNames[i]);
        }
    }
    return suffix;
}

/// What was kept under this name, or what `make` gives, which is then kept.
template <class Make>
Expected<std::vector<audio::HeardPiece>> cached(const GenreOptions& options,
                                                const std::string& name,
                                                const Make& make) {
    const std::filesystem::path path = options.cache / (name + ".pieces");
    if (!options.cache.empty() && std::filesystem::exists(path)) {
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

/// The files asked for, heard.
Expected<std::vector<audio::HeardPiece>> gather_recordings(
    const GenreOptions& options,
    const audio::HearingPlan& hearing,
    const std::vector<audio::MusicFile>& files) {
    const auto make = [&]() -> Expected<std::vector<audio::HeardPiece>> {
        auto recordings = hear_recordings(files, options, hearing);
        if (!recordings) {
            return fail(recordings.error());
        }
        return std::move(recordings->pieces);
    };
    const std::string name = fmt::format(
        "recordings-{}-{}-codec{}", files.size(), options.altered, without(options.effects));
    return cached(options, name, make);
}

/// The music asked for, written. What may be left out is written apart, so that a model without it
/// learns the same music else.
Expected<std::vector<audio::HeardPiece>> gather_written(const GenreOptions& options,
                                                        const audio::HearingPlan& hearing) {
    if (options.soundfonts.empty()) {
        return fail("--synthesize needs --soundfont X.sf2: what the music is played with");
    }
    using Families = audio::WrittenCorpusPlan::Families;
    struct Part {
        const char* name;
        Families families;
        int pieces;
    };
    std::vector<Part> parts = {{"written", Families::always, options.synthesize}};
    if (!options.leaves_out_families) {
        parts.push_back({"written-rest", Families::held_out, options.synthesize / kRestShare});
    }
    std::vector<audio::HeardPiece> pieces;
    for (const Part& part : parts) {
        auto more = written(options,
                            hearing,
                            part.name,
                            {.soundfonts = options.soundfonts,
                             .families = part.families,
                             .pieces = part.pieces,
                             .seed = options.seed,
                             .hearing = {}});
        if (!more) {
            return more;
        }
        std::move(more->begin(), more->end(), std::back_inserter(pieces));
    }
    return pieces;
}

}  // namespace

Expected<std::vector<audio::HeardPiece>> written(const GenreOptions& options,
                                                 const audio::HearingPlan& hearing,
                                                 const std::string& name,
                                                 audio::WrittenCorpusPlan plan) {
    constexpr int kChunk = 70;
    const int all = plan.pieces;
    plan.hearing = hearing;
    plan.threads = options.threads;
    plan.effects = options.effects;
    plan.edition = static_cast<audio::WrittenCorpusPlan::Edition>(options.edition);
    const bool is_altered = plan.augmentation == audio::WrittenCorpusPlan::Augmentation::on;
    const std::string variant = (options.edition > 1 ? "-second" : "") +
                                (is_altered ? without(options.effects) : std::string());
    const auto start = std::chrono::steady_clock::now();
    std::vector<audio::HeardPiece> pieces;
    for (plan.first = 0; plan.first < all; plan.first += kChunk) {
        plan.pieces = std::min(kChunk, all - plan.first);
        auto chunk =
            cached(options,
                   fmt::format("{}-{}-{}-{}{}", name, plan.seed, plan.first, plan.pieces, variant),
                   [&] { return audio::write_corpus(plan); });
        if (!chunk) {
            return chunk;
        }
        std::move(chunk->begin(), chunk->end(), std::back_inserter(pieces));
        const double done = static_cast<double>(pieces.size()) / all;
        std::fprintf(stderr,
                     "raks: %s: %zu of %d pieces played and heard, %.0f s left\n",
                     name.c_str(),
                     pieces.size(),
                     all,
                     seconds_since(start) * (1.0 - done) / done);
    }
    return pieces;
}

Expected<GenreMaterial> gather(const GenreOptions& options, const audio::HearingPlan& hearing) {
    GenreMaterial material;
    if (!options.folder.empty()) {
        auto listed = options.index.empty() ? audio::list_music(options.folder)
                                            : audio::list_music(options.folder, options.index);
        if (!listed) {
            return fail(listed.error());
        }
        material.files = std::move(*listed);
        if (auto distinct = audio::check_distinct(material.files); !distinct) {
            return fail(distinct.error());
        }
        auto heard = gather_recordings(options, hearing, material.files);
        if (!heard) {
            return fail(heard.error());
        }
        material.pieces = std::move(*heard);
    }
    if (options.synthesize > 0) {
        auto more = gather_written(options, hearing);
        if (!more) {
            return fail(more.error());
        }
        std::move(more->begin(), more->end(), std::back_inserter(material.pieces));
    }
    if (!options.beats_corpus.empty()) {
        using Families = audio::WrittenCorpusPlan::Families;
        auto more = audio::read_beats_corpus(
            options.beats_corpus, options.leaves_out_families ? Families::always : Families::all);
        if (!more) {
            return fail(more.error());
        }
        std::move(more->begin(), more->end(), std::back_inserter(material.pieces));
    }
    std::erase_if(material.pieces, [&](const audio::HeardPiece& piece) {
        const auto& left_out = options.left_out;
        return std::find(left_out.begin(), left_out.end(), name_of(piece.genre)) != left_out.end();
    });
    if (material.pieces.empty()) {
        return fail("no music: name a folder, or --synthesize N with --soundfont X.sf2");
    }
    return material;
}

}  // namespace raks::cli
