// The program raks-train-genre, that `raks train genre` starts: it alone needs FluidSynth and a
// BLAS, which the dancing program should not load.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "audio/beat/network/network_file.hpp"
#include "audio/genre/genre_file.hpp"
#include "audio/genre/training/genre_augmentation.hpp"
#include "audio/genre/training/genre_page.hpp"
#include "audio/genre/training/genre_trainer.hpp"
#include "audio/genre/training/music_folder.hpp"
#include "audio/genre/training/sound_damage.hpp"
#include "audio/genre/training/written_corpus.hpp"
#include "audio/io/audio_file.hpp"
#include "base/file.hpp"
#include "base/parallel.hpp"
#include "engine/hearing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

namespace {

using namespace raks;

constexpr int kRestShare = 6;  // written pieces a piece by a rhythm that may be left out

struct Options {
    std::filesystem::path folder;
    std::filesystem::path index;
    std::filesystem::path output;
    std::filesystem::path cache;
    std::filesystem::path report;
    int synthesize = 0;
    int test_pieces = 140;
    std::vector<std::filesystem::path> soundfonts;
    std::vector<std::filesystem::path> test_soundfonts;
    std::vector<std::string> left_out;  // genres
    bool is_strict = false;
    bool leaves_out_families = false;
    bool trains_on_free_alone = false;
    bool skips_validation = false;
    int altered = 2;
    bool leaves_out_energy = false;
    audio::GenreTrainingPlan plan;
    std::uint64_t seed = 1;
    int threads = 2;
};

void add_options(CLI::App& app, Options& options) {
    app.add_option("folder", options.folder, "of music: one folder a genre");
    app.add_option("--groups",
                   options.index,
                   "table of the folder's clips: clip, genre; artist, label, train_ok if known");
    app.add_option("-o,--out", options.output, "X.json");
    app.add_option(
           "--synthesize", options.synthesize, "pieces of music to write, play and learn from")
        ->check(CLI::Range(0, 100'000));
    app.add_option(
        "--soundfont", options.soundfonts, "SF2 or SF3 to play it with; one is drawn a piece");
    app.add_option("--test-soundfont",
                   options.test_soundfonts,
                   "report how music played with these is heard; not learnt from");
    app.add_option("--test-pieces", options.test_pieces, "of each kind of written test; 0: none")
        ->check(CLI::Range(0, 10'000));
    app.add_option("--cache", options.cache, "folder that keeps what was heard between runs");
    app.add_option("--report", options.report, "X.html: how recordings are told apart, by artist");
    app.add_option("--leave-out", options.left_out, "genres not to learn");
    app.add_flag("--leave-out-families",
                 options.leaves_out_families,
                 "do not learn from one or two rhythms a genre, but test with them");
    app.add_flag("--free-only",
                 options.trains_on_free_alone,
                 "learn only from clips whose train_ok is yes (validation uses all)");
    app.add_flag("--no-validation", options.skips_validation, "keep the default fusion");
    app.add_flag("--strict", options.is_strict, "a file that cannot be read is an error");
    app.add_flag("--no-energy", options.leaves_out_energy, "without C0 and its derivatives");
    app.add_option(
           "--altered", options.altered, "damaged copies of each recording to learn from; 0: none")
        ->check(CLI::Range(0, 50));
    app.add_option("--states", options.plan.mfcc.states, "of each genre's HMM")
        ->check(CLI::Range(1, 16));
    app.add_option("--mixtures", options.plan.mfcc.mixtures, "Gaussians a state")
        ->check(CLI::Range(1, 64));
    app.add_option(
           "--similarity", options.plan.mfcc.similarity_rounds, "rounds of inter-genre similarity")
        ->check(CLI::Range(0, 5));
    app.add_option("--units", options.plan.rhythm.units, "of the rhythm network")
        ->check(CLI::Range(2, 128));
    app.add_option("--steps", options.plan.rhythm.steps, "of its training")
        ->check(CLI::Range(10, 1'000'000));
    app.add_option("--recorded-share",
                   options.plan.rhythm.recorded_share,
                   "of what is drawn, where there are recordings and written music")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--folds", options.plan.folds)->check(CLI::Range(2, 20));
    app.add_option("--seed", options.seed, "same seed, same model");
    app.add_option("--threads", options.threads)->check(CLI::Range(1, 64));
}

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
                                                   const Options& options,
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
            audio::change_speed(dice.uniform(0.92, 1.08), samples);
            audio::augment_for_genre(music->rate.hertz(), samples, dice);
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
                                     const Options& options,
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

/// What was kept under this name, or what `make` gives, which is then kept.
template <class Make>
Expected<std::vector<audio::HeardPiece>> cached(const Options& options,
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

/// Written music, chunk by chunk: what a stopped run has finished is found again by the next.
Expected<std::vector<audio::HeardPiece>> written(const Options& options,
                                                 const audio::HearingPlan& hearing,
                                                 const std::string& name,
                                                 audio::WrittenCorpusPlan plan) {
    constexpr int kChunk = 70;
    const int all = plan.pieces;
    plan.hearing = hearing;
    plan.threads = options.threads;
    const auto start = std::chrono::steady_clock::now();
    std::vector<audio::HeardPiece> pieces;
    for (plan.first = 0; plan.first < all; plan.first += kChunk) {
        plan.pieces = std::min(kChunk, all - plan.first);
        auto chunk = cached(options,
                            fmt::format("{}-{}-{}-{}", name, plan.seed, plan.first, plan.pieces),
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

constexpr const char* kEvidenceNames[] = {"fused", "MFCC", "MFCC+IGS", "rhythm", "sound"};

/// ln chances of all these windows by some of the evidence; the model's fusion, or one fitted here.
std::vector<audio::WindowScore::Values> fused_scores(std::span<const audio::WindowScore> scores,
                                                     std::size_t window,
                                                     std::size_t classes,
                                                     audio::GenreEvidence evidence,
                                                     const audio::GenreModel* calibrated) {
    const bool is_ready = calibrated != nullptr && evidence == audio::GenreEvidence::fused;
    const auto fusion = is_ready ? calibrated->fusion[window]
                                 : audio::fit_fusion(scores, window, classes, evidence);
    std::vector<audio::WindowScore::Values> logs;
    logs.reserve(scores.size());
    for (const audio::WindowScore& score : scores) {
        logs.push_back(audio::fuse(score, fusion, evidence, classes));
    }
    return logs;
}

constexpr std::size_t kFiveSeconds = 3;  // of kGenreWindows
static_assert(audio::kGenreWindows[kFiveSeconds] == 10);

/// How every kind of evidence does at every window length.
audio::GenrePage page_of(const std::string& title,
                         std::span<const audio::WindowScore> scores,
                         std::span<const Genre> genres,
                         std::span<const std::size_t> asked,
                         const audio::GenreModel* calibrated) {
    using audio::GenreEvidence;
    audio::GenrePage page;
    page.title = title;
    page.genres.assign(genres.begin(), genres.end());
    const bool has_similarity = std::any_of(scores.begin(), scores.end(), [](const auto& score) {
        return score.similarity[0] != 0.0F;
    });
    for (const GenreEvidence evidence : {GenreEvidence::mfcc,
                                         GenreEvidence::mfcc_similarity,
                                         GenreEvidence::rhythm,
                                         GenreEvidence::sound,
                                         GenreEvidence::fused}) {
        if (evidence == GenreEvidence::mfcc_similarity && !has_similarity) {
            continue;
        }
        for (std::size_t window = 0; window < audio::kGenreWindows.size(); ++window) {
            const auto logs = fused_scores(scores, window, genres.size() + 1, evidence, calibrated);
            audio::GenrePage::Row row{kEvidenceNames[static_cast<std::size_t>(evidence)],
                                      audio::kGenreWindows[window] * audio::kSegmentSeconds,
                                      audio::tally(scores, logs, window, genres, asked)};
            if (row.tally.windows > 0) {
                page.rows.push_back(std::move(row));
            }
        }
    }
    return page;
}

void print_page(const audio::GenrePage& page, std::span<const std::size_t> asked) {
    fmt::print("{}\n{:10} {:>7} {:>9} {:>9} {:>9} {:>7}\n",
               page.title,
               "",
               "window",
               "macro",
               "2 dances",
               "unknown",
               "ECE");
    for (const audio::GenrePage::Row& row : page.rows) {
        fmt::print("{:10} {:5.1f} s {:9.3f} {:9.3f} {:9.3f} {:7.3f}\n",
                   row.evidence,
                   row.seconds,
                   row.tally.macro_recall,
                   row.tally.two_dances,
                   row.tally.auroc_unknown,
                   row.tally.calibration_error);
        if (row.evidence == "fused" && row.seconds == 5.0) {
            for (const std::size_t truth : asked) {
                fmt::print("    {:8} {:3} pieces  {:.2f}\n",
                           name_of(page.genres[truth]),
                           row.tally.pieces[truth],
                           fmt::join(row.tally.confusion[truth], " "));
            }
        }
    }
    std::fflush(stdout);
}

/// How often each recorded file's windows of 5 s were taken for what they are, among the asked.
std::vector<audio::GenrePage::File> judged_files(std::span<const audio::HeardPiece> pieces,
                                                 std::span<const audio::WindowScore> scores,
                                                 std::span<const Genre> genres,
                                                 std::span<const std::size_t> asked) {
    const auto logs =
        fused_scores(scores, kFiveSeconds, genres.size() + 1, audio::GenreEvidence::fused, nullptr);
    std::map<std::size_t, std::pair<int, int>> right_of_all;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const std::size_t truth = scores[i].truth;
        const bool is_asked = std::find(asked.begin(), asked.end(), truth) != asked.end();
        if (scores[i].window != kFiveSeconds || !is_asked) {
            continue;
        }
        const std::size_t best = *std::max_element(
            asked.begin(), asked.end(), [&](auto a, auto b) { return logs[i][a] < logs[i][b]; });
        auto& [right, all] = right_of_all[scores[i].piece];
        right += best == truth ? 1 : 0;
        ++all;
    }
    std::vector<audio::GenrePage::File> files;
    files.reserve(right_of_all.size());
    for (const auto& [piece, counts] : right_of_all) {
        files.push_back({pieces[piece].name,
                         pieces[piece].genre,
                         static_cast<double>(counts.first) / counts.second});
    }
    return files;
}

std::vector<audio::WindowScore> scores_of(const audio::GenreModel& model,
                                          std::span<const audio::HeardPiece> pieces,
                                          int threads) {
    std::vector<std::vector<audio::WindowScore>> parts(pieces.size());
    run_parallel(pieces.size(), threads, [&](std::size_t i) {
        parts[i] = audio::score_piece(model, pieces[i], i);
    });
    std::vector<audio::WindowScore> scores;
    for (auto& part : parts) {
        std::move(part.begin(), part.end(), std::back_inserter(scores));
    }
    return scores;
}

std::vector<std::size_t> all_genres(std::size_t count) {
    std::vector<std::size_t> classes(count);
    for (std::size_t i = 0; i < count; ++i) {
        classes[i] = i;
    }
    return classes;
}

/// Genres with recordings of at least five pieces.
std::vector<std::size_t> enough_recordings(std::span<const audio::HeardPiece> pieces,
                                           std::span<const Genre> genres) {
    std::vector<std::size_t> classes;
    for (std::size_t c = 0; c < genres.size(); ++c) {
        const auto count = std::count_if(pieces.begin(), pieces.end(), [&](const auto& piece) {
            return piece.genre == genres[c] && piece.kind == audio::HeardPiece::Kind::recorded;
        });
        if (count >= 5) {
            classes.push_back(c);
        }
    }
    return classes;
}

/// How the finished model hears written music that it never heard.
Expected<void> test_on_written(const Options& options,
                               const audio::HearingPlan& hearing,
                               const audio::GenreModel& model) {
    using Families = audio::WrittenCorpusPlan::Families;
    const auto test = [&](const std::string& name,
                          const auto& soundfonts,
                          Families families,
                          std::uint64_t seed) -> Expected<void> {
        auto pieces = written(options,
                              hearing,
                              name,
                              {.soundfonts = soundfonts,
                               .families = families,
                               .pieces = options.test_pieces,
                               .seed = seed,
                               .augmentation = audio::WrittenCorpusPlan::Augmentation::off,
                               .hearing = {}});
        if (!pieces) {
            return fail(pieces.error());
        }
        const auto asked = all_genres(model.genres.size());
        const auto scores = scores_of(model, *pieces, options.threads);
        print_page(page_of(name, scores, model.genres, asked, &model), asked);
        return {};
    };
    const std::uint64_t seed = options.seed + 500;
    const Families known = options.leaves_out_families ? Families::always : Families::all;
    if (auto ok = test("written, new seeds, soundfonts heard", options.soundfonts, known, seed);
        !ok) {
        return ok;
    }
    if (options.leaves_out_families) {
        if (auto ok = test(
                "written, rhythms never heard", options.soundfonts, Families::held_out, seed + 1);
            !ok) {
            return ok;
        }
    }
    if (!options.test_soundfonts.empty()) {
        return test("written, soundfont never heard", options.test_soundfonts, known, seed + 2);
    }
    return {};
}

std::string attribution_of(const std::vector<audio::MusicFile>& files, const Options& options) {
    std::string text;
    if (options.synthesize > 0) {
        text = "Music written by this program, played with soundfonts";
        for (const auto& soundfont : options.soundfonts) {
            text += " " + soundfont.filename().string();
        }
        text += ". ";
    }
    std::set<std::string> credits;
    for (const audio::MusicFile& file : files) {
        if (!file.credit.empty() && (file.may_train || !options.trains_on_free_alone)) {
            credits.insert(file.credit);
        }
    }
    return text + fmt::format("{}", fmt::join(credits, "; "));
}

/// The files asked for, heard.
Expected<std::vector<audio::HeardPiece>> gather_recordings(
    const Options& options,
    const audio::HearingPlan& hearing,
    const std::vector<audio::MusicFile>& files) {
    const auto make = [&]() -> Expected<std::vector<audio::HeardPiece>> {
        auto recordings = hear_recordings(files, options, hearing);
        if (!recordings) {
            return fail(recordings.error());
        }
        return std::move(recordings->pieces);
    };
    return cached(options, fmt::format("recordings-{}-{}", files.size(), options.altered), make);
}

/// The music asked for, written. What may be left out is written apart, so that a model without it
/// learns the same music else.
Expected<std::vector<audio::HeardPiece>> gather_written(const Options& options,
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

struct Material {
    std::vector<audio::MusicFile> files;
    std::vector<audio::HeardPiece> pieces;
};

Expected<Material> gather(const Options& options, const audio::HearingPlan& hearing) {
    Material material;
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
    std::erase_if(material.pieces, [&](const audio::HeardPiece& piece) {
        const auto& left_out = options.left_out;
        return std::find(left_out.begin(), left_out.end(), name_of(piece.genre)) != left_out.end();
    });
    if (material.pieces.empty()) {
        return fail("no music: name a folder, or --synthesize N with --soundfont X.sf2");
    }
    return material;
}

/// Pieces that the final model may learn from.
std::vector<const audio::HeardPiece*> free_pieces(const Options& options,
                                                  const Material& material) {
    std::set<std::string> barred;
    for (const audio::MusicFile& file : material.files) {
        if (!file.may_train && options.trains_on_free_alone) {
            barred.insert(file.name);
        }
    }
    std::vector<const audio::HeardPiece*> free;
    for (const audio::HeardPiece& piece : material.pieces) {
        if (!barred.contains(piece.name)) {
            free.push_back(&piece);
        }
    }
    return free;
}

/// Scores of pieces by models that did not hear their artist; prints how good they are.
Expected<std::vector<audio::WindowScore>> validate_by_group(const Options& options,
                                                            const Material& material,
                                                            const std::vector<Genre>& genres) {
    const std::vector<audio::HeardPiece>& pieces = material.pieces;
    auto scores = audio::cross_validate(pieces, genres, options.plan, [](int done, int all) {
        std::fprintf(stderr, "raks: fold %d of %d\n", done, all);
    });
    if (!scores) {
        return fail(scores.error());
    }
    std::vector<audio::WindowScore> recorded;
    std::copy_if(
        scores->begin(), scores->end(), std::back_inserter(recorded), [&](const auto& score) {
            return pieces[score.piece].is_recorded();
        });
    if (recorded.empty()) {
        return scores;
    }
    const auto asked = enough_recordings(pieces, genres);
    audio::GenrePage page = page_of("recordings, by artist", recorded, genres, asked, nullptr);
    print_page(page, asked);
    if (!options.report.empty()) {
        page.files = judged_files(pieces, recorded, genres, asked);
        if (auto saved = write_file(options.report, audio::genre_page(page)); !saved) {
            return fail(saved.error());
        }
    }
    return scores;
}

Expected<void> run(Options& options, const std::string& command) {
    auto network = engine::load_beat_network();
    if (!network) {
        return fail(network.error());
    }
    const audio::HearingPlan hearing{*network, options.plan.features.cepstral_mean};
    const auto material = gather(options, hearing);
    if (!material) {
        return fail(material.error());
    }
    const std::vector<Genre> genres = audio::genres_of(material->pieces);
    std::vector<audio::WindowScore> held_out;
    if (!options.skips_validation) {
        auto scores = validate_by_group(options, *material, genres);
        if (!scores) {
            return fail(scores.error());
        }
        held_out = std::move(*scores);
    }
    auto model = audio::train_genres(free_pieces(options, *material), genres, options.plan);
    if (!model) {
        return fail(model.error());
    }
    audio::calibrate(held_out, *model);
    model->made_with = command;
    model->attribution = attribution_of(material->files, options);
    if (!options.output.empty()) {
        if (auto saved = audio::save_genre(*model, options.output); !saved) {
            return saved;
        }
    }
    const bool is_tested = options.synthesize > 0 && options.test_pieces > 0;
    return is_tested ? test_on_written(options, hearing, *model) : Expected<void>{};
}

}  // namespace

int main(int argc, char** argv) try {
    Options options;
    CLI::App app("learns which dance music is for", "raks train genre");
    add_options(app, options);
    CLI11_PARSE(app, argc, argv);
    options.plan.mfcc.threads = options.threads;
    options.plan.mfcc.seed = options.plan.rhythm.seed = options.plan.sound.seed = options.seed;
    options.plan.mfcc.recorded_share = options.plan.sound.recorded_share =
        options.plan.rhythm.recorded_share;
    if (options.leaves_out_energy) {
        options.plan.features.energy = raks::audio::GenreFeatures::Energy::left_out;
    }
    std::string command = "raks train genre";
    for (int i = 1; i < argc; ++i) {
        command += ' ' + std::filesystem::path(argv[i]).filename().string();
    }
    if (const auto done = run(options, command); !done) {
        std::fprintf(stderr, "raks: %s\n", done.error().message.c_str());
        return 1;
    }
    return 0;
} catch (const std::exception& error) {  // no memory, or a fault of ours
    std::fprintf(stderr, "raks: %s\n", error.what());
    return 1;
}
