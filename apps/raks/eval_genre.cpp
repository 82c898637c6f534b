// `raks eval genre`: measures how well a model tells dances apart on a folder of music.
#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <utility>

#include "apps/raks/commands.hpp"
#include "apps/raks/genre_evaluation.hpp"
#include "apps/raks/genre_watch.hpp"
#include "apps/reports/genre_plot.hpp"
#include "apps/terminal/say.hpp"
#include "audio/evaluate/genre_folder.hpp"
#include "audio/evaluate/genre_scores.hpp"
#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/genre_file.hpp"
#include "audio/io/audio_file.hpp"
#include "audio/music/damage/sound_damage.hpp"
#include "base/parallel.hpp"
#include "base/pending_file.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "engine/setup/told_genre.hpp"

namespace raks::apps {
namespace {

using audio::GenreEvidence;

// One file: features for the scores, and what the program would show.
struct AnalyzedFile {
    audio::PieceFeatures piece;
    GenreEvaluation::File shown;
    GenreTrack track;
};

// Computes both for one file after this damage. Errors: it cannot be read, or is too short.
Expected<AnalyzedFile> analyze_file(const audio::MusicFile& file,
                                    audio::Damage damage,
                                    const engine::AnalyzerModels& models) {
    auto music = audio::read_all_mono(file.path);
    if (!music) {
        return fail(music.error());
    }
    if (auto done = audio::damage(damage, music->rate.hertz(), music->samples); !done) {
        return fail(done.error());
    }
    AnalyzedFile analyzed;
    analyzed.piece.name = file.name;
    analyzed.piece.group = file.group;
    analyzed.piece.genre = file.genre;
    // The features in windows, as the training computes them, with the model's options.
    if (auto done = audio::extract_features(music->samples,
                                            music->rate,
                                            {models.beats, models.genres->features.cepstral_mean},
                                            analyzed.piece);
        !done) {
        return fail(file.path.string() + ": " + done.error().message);
    }
    if (analyzed.piece.windows.empty()) {
        return fail(file.path.string() + ": is silent or shorter than 1 s");
    }
    auto analyzer = engine::make_analyzer(
        music->rate, models, audio::BeatMethod::pointer, engine::make_tagger(models));
    if (!analyzer) {
        return fail(analyzer.error());
    }
    // The whole program's analyzer, on the same samples; what the tags say is kept apart.
    GenreWatch watch(*analyzer,
                     {.truth = audio::class_of(file.genre, models.genres->genres),
                      .prior = engine::told(models, music->tags, file.path).genre_prior,
                      .has_tagger = models.tagger != nullptr});
    analyzer->process(music->samples, watch);
    analyzed.shown = {file.name, file.genre, watch.shown(), watch.claims()};
    analyzed.track = watch.track();
    return analyzed;
}

// A picture of what each part thought of a file over time, under the file's name without folders;
// none where there is no folder for it.
Expected<void> plot_file(const std::filesystem::path& folder,
                         const audio::MusicFile& file,
                         const GenreTrack& track) {
    if (folder.empty()) {
        return {};
    }
    std::string name = std::filesystem::path(file.name).replace_extension().string();
    std::replace(name.begin(), name.end(), '/', '_');
    auto plot = PendingFile::create(folder / (name + ".svg"));
    if (!plot) {
        return fail(std::move(plot.error()));
    }
    auto written =
        plot->write(draw_genre_plot(track, name, audio::class_of(file.genre, track.genres)));
    return written ? plot->commit() : written;
}

// The kinds of evidence in the order of the tables.
constexpr std::array kEvidence = {std::pair{GenreEvidence::mfcc, "mfcc"},
                                  std::pair{GenreEvidence::mfcc_similarity, "mfcc+igs"},
                                  std::pair{GenreEvidence::rhythm, "rhythm"},
                                  std::pair{GenreEvidence::sound, "sound"},
                                  std::pair{GenreEvidence::network, "network"},
                                  std::pair{GenreEvidence::fused, "fused"}};

// Adds one row for each kind of evidence and window length.
void add_rows(const audio::GenreModel& model,
              const std::vector<audio::WindowScore>& scores,
              const std::string& damage,
              GenreEvaluation& evaluation) {
    for (const auto& [evidence, name] : kEvidence) {
        // Not every model has that evidence.
        if (evidence == GenreEvidence::mfcc_similarity && !model.similarity) {
            continue;
        }
        for (std::size_t window = 0; window < audio::kGenreWindows.size(); ++window) {
            // The model's fusion weighs all evidence; a single kind is taken as it is.
            const audio::GenreFusion fusion = evidence == GenreEvidence::fused
                                                  ? model.fusion[window]
                                                  : audio::GenreFusion{{1.0F}, {1.0F}, {}};
            std::vector<audio::GenreScores::Values> logs;
            logs.reserve(scores.size());
            for (const audio::WindowScore& score : scores) {
                logs.push_back(audio::fuse(score, fusion, evidence, model.classes()));
            }
            GenreEvaluation::Row row{
                damage,
                name,
                audio::kGenreWindows[window] * audio::kSegmentSeconds,
                audio::tally(
                    scores, logs, window, evaluation.genres, evaluation.asked, evaluation.pair)};
            // No file is as long as this window.
            if (row.tally.windows == 0) {
                continue;
            }
            evaluation.rows.push_back(std::move(row));
            // What the own parts say of a song that is known ahead: the mean of all its windows.
            if (evidence == GenreEvidence::fused) {
                const audio::PieceScores songs = audio::whole_pieces(scores, logs, window);
                evaluation.rows.push_back({damage,
                                           "song",
                                           audio::kGenreWindows[window] * audio::kSegmentSeconds,
                                           audio::tally(songs.scores,
                                                        songs.log_chances,
                                                        window,
                                                        evaluation.genres,
                                                        evaluation.asked,
                                                        evaluation.pair)});
            }
        }
    }
}

// The classes that occur in at least `least` files, so that their recall means something; all that
// occur when these are fewer than two.
std::vector<std::size_t> asked_genres(const std::vector<audio::MusicFile>& files,
                                      const std::vector<std::string>& genres,
                                      std::ptrdiff_t least) {
    std::vector<std::size_t> asked;
    for (std::size_t c = 0; c < genres.size(); ++c) {
        const auto count = std::count_if(
            files.begin(), files.end(), [&](const auto& file) { return file.genre == genres[c]; });
        if (count >= least) {
            asked.push_back(c);
        }
    }
    return asked.size() < 2 && least > 1 ? asked_genres(files, genres, 1) : asked;
}

// The shipped models, but for the one that is measured.
Expected<engine::AnalyzerModels> models_of(const EvalGenreArguments& arguments,
                                           const engine::DanceCatalogue& catalogue,
                                           std::shared_ptr<const audio::GenreModel> measured) {
    auto models =
        engine::load_analyzer_models(catalogue.list(), {arguments.tagger, engine::FileTags::read});
    if (models) {
        models->genres = std::move(measured);
    }
    return models;
}

// The files that are measured. Errors: those of list_music.
Expected<std::vector<audio::MusicFile>> files_of(const EvalGenreArguments& arguments,
                                                 const DanceList& dances) {
    auto files = arguments.groups.empty()
                     ? audio::list_music(arguments.folder, dances)
                     : audio::list_music(arguments.folder, arguments.groups, dances);
    // Labels are single letters.
    if (files && !arguments.labels.empty()) {
        std::erase_if(*files, [&](const audio::MusicFile& file) {
            return arguments.labels.find(file.label) == std::string::npos;
        });
    }
    return files;
}

// All files after one kind of damage, each at its place, whichever thread takes it.
std::vector<Expected<AnalyzedFile>> analyze_files(const std::vector<audio::MusicFile>& files,
                                                  audio::Damage damage,
                                                  const engine::AnalyzerModels& models,
                                                  int threads) {
    std::vector<Expected<AnalyzedFile>> analyzed(files.size(), fail("not analysed"));
    run_parallel(files.size(), threads, [&](std::size_t i) {
        analyzed[i] = analyze_file(files[i], damage, models);
    });
    return analyzed;
}

// What is shown of undamaged files, and their pictures. A file that cannot be read is reported.
// Errors: a picture cannot be written.
Expected<void> take_shown(const std::vector<audio::MusicFile>& files,
                          const std::vector<Expected<AnalyzedFile>>& analyzed,
                          const std::filesystem::path& plots,
                          GenreEvaluation& evaluation) {
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (!analyzed[i]) {
            evaluation.skipped.push_back(analyzed[i].error().message);
            continue;
        }
        evaluation.shown.push_back(analyzed[i]->shown);
        if (auto plotted = plot_file(plots, files[i], analyzed[i]->track); !plotted) {
            return plotted;
        }
    }
    return {};
}

// Scores of all windows of the files that could be read.
std::vector<audio::WindowScore> score_files(const std::vector<Expected<AnalyzedFile>>& analyzed,
                                            const audio::GenreModel& model) {
    std::vector<audio::WindowScore> scores;
    for (std::size_t i = 0; i < analyzed.size(); ++i) {
        if (analyzed[i]) {
            auto part = audio::score_piece(model, analyzed[i]->piece, i);
            std::move(part.begin(), part.end(), std::back_inserter(scores));
        }
    }
    return scores;
}

// Scores all files, once for each kind of damage; damage 0 is none. Errors: as take_shown().
Expected<void> evaluate_files(const EvalGenreArguments& arguments,
                              const std::vector<audio::MusicFile>& files,
                              const engine::AnalyzerModels& models,
                              GenreEvaluation& evaluation) {
    const std::size_t damages = arguments.with_damage ? std::size(audio::kDamageNames) : 1;
    for (std::size_t damage = 0; damage < damages; ++damage) {
        const auto analyzed =
            analyze_files(files, static_cast<audio::Damage>(damage), models, arguments.threads);
        const auto scores = score_files(analyzed, *models.genres);
        if (damage == 0) {
            if (auto taken = take_shown(files, analyzed, arguments.plots, evaluation); !taken) {
                return taken;
            }
        } else if (scores.empty() && !analyzed.empty() && !analyzed.front()) {
            // A damage that fails for all files is reported once.
            evaluation.skipped.push_back(analyzed.front().error().message);
        }
        add_rows(*models.genres, scores, std::string(audio::kDamageNames[damage]), evaluation);
    }
    return {};
}

Expected<GenreEvaluation> evaluate(const EvalGenreArguments& arguments) {
    auto model = engine::load_genre_model(arguments.model);
    const auto catalogue = engine::DanceCatalogue::load();
    if (!catalogue) {
        return fail(catalogue.error());
    }
    auto files = files_of(arguments, *catalogue->list());
    if (!model || !files) {
        return fail(!model ? model.error() : files.error());
    }
    auto models = models_of(arguments, *catalogue, *model);
    if (!models) {
        return fail(std::move(models.error()));
    }
    GenreEvaluation evaluation;
    evaluation.genres = (*model)->genres;
    evaluation.pair = catalogue->pair();
    evaluation.files = files->size();
    // Fewer files of a genre say little about its recall.
    constexpr std::ptrdiff_t kEnoughFiles = 5;
    evaluation.asked = asked_genres(*files, evaluation.genres, kEnoughFiles);
    auto done = arguments.plots.empty() ? Expected<void>() : make_folders(arguments.plots);
    if (done) {
        done = evaluate_files(arguments, *files, *models, evaluation);
    }
    return done ? Expected<GenreEvaluation>(std::move(evaluation)) : fail(std::move(done.error()));
}

}  // namespace

ExitCode eval_genre(const EvalGenreArguments& arguments) {
    const auto evaluation = evaluate(arguments);
    if (!evaluation) {
        return fail(evaluation.error());
    }
    for (const std::string& reason : evaluation->skipped) {
        say("skipped " + reason);
    }
    if (evaluation->rows.empty()) {
        return fail({arguments.folder.string() + ": no file could be judged"});
    }
    if (arguments.as_json) {
        print_json(genre_evaluation_json(*evaluation));
    } else {
        print_text(genre_evaluation_text(*evaluation));
    }
    return kExitDone;
}

}  // namespace raks::apps
