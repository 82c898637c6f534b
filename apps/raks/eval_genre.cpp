// `raks eval genre`: measures how well a model tells dances apart on a folder of music.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "apps/raks/commands.hpp"
#include "apps/terminal/say.hpp"
#include "audio/evaluate/genre_folder.hpp"
#include "audio/evaluate/genre_scores.hpp"
#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/genre_file.hpp"
#include "audio/io/audio_file.hpp"
#include "audio/music/damage/sound_damage.hpp"
#include "base/json.hpp"
#include "base/parallel.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dance_catalogue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {

using audio::GenreEvidence;

// One row of the tables: a kind of evidence at a window length, after a kind of damage.
struct PieceRow {
    std::string damage;
    std::string evidence;
    double seconds = 0.0;
    audio::GenreTally tally;
};

// What the program would show for one file: switches of the decision, and the share of time that it
// was right.
struct Shown {
    std::string file;
    std::string truth;
    double seconds = 0.0;
    int switches = 0;          ///< after the first genre
    double right_share = 0.0;  ///< of the hops from 10 s on
    std::size_t at_end = 0;    ///< class that is shown at last
    double wrong_share = 0.0;  ///< of the hops from 5 s on: another dance than that of the file
};

// Everything that is reported.
struct Evaluation {
    std::vector<std::string> genres;
    std::vector<std::string> pair;   ///< two that are compared
    std::vector<std::size_t> asked;  // classes that are judged
    std::vector<PieceRow> rows;
    std::vector<Shown> shown;
    std::vector<std::string> skipped;  // files that could not be used, with the reason
    std::size_t files = 0;
};

// Follows the decision of the streaming analyzer hop by hop.
class WatchDecision final : public audio::MusicAnalyzer::Sink {
 public:
    // `truth`: class of the file; `none`: the class of "unknown".
    WatchDecision(std::size_t truth, std::size_t none) : truth_(truth), none_(none), last_(none) {}
    void on_state(const MusicState& state) noexcept override {
        // The first decision is no switch, and neither is what follows "unknown".
        const bool is_switch = state.genre_class != last_ && last_ != none_;
        shown_.switches += is_switch ? 1 : 0;
        last_ = state.genre_class;
        shown_.seconds = to_seconds(state.time);
        // The first seconds have too little music for a decision.
        if (shown_.seconds >= kBegun) {
            ++danced_;
            wrong_ += last_ != truth_ && last_ != none_ ? 1 : 0;
        }
        if (shown_.seconds >= kSettled) {
            ++counted_;
            right_ += state.genre_class == truth_ ? 1 : 0;
        }
    }
    [[nodiscard]] Shown result(const audio::MusicFile& file) const {
        Shown result = shown_;
        result.file = file.name;
        result.truth = file.genre;
        result.right_share = counted_ > 0 ? static_cast<double>(right_) / counted_ : 0.0;
        result.at_end = last_;
        result.wrong_share = danced_ > 0 ? static_cast<double>(wrong_) / danced_ : 0.0;
        return result;
    }

 private:
    // Seconds until a wrong dance counts, and until the decision is judged.
    static constexpr double kBegun = 5.0;
    static constexpr double kSettled = 10.0;
    Shown shown_;
    std::size_t truth_;
    std::size_t none_;
    std::size_t last_;
    int counted_ = 0;
    int right_ = 0;
    int danced_ = 0;
    int wrong_ = 0;
};

// One file: features for the scores, and what the program would show.
struct AnalyzedFile {
    audio::PieceFeatures piece;
    Shown shown;
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
    const std::vector<std::string>& genres = models.genres->genres;
    // The whole program's analyzer, on the same samples.
    WatchDecision watch(audio::class_of(file.genre, genres), genres.size());
    analyzer->process(music->samples, watch);
    analyzed.shown = watch.result(file);
    return analyzed;
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
              Evaluation& evaluation) {
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
            PieceRow row{
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
            // What `play` and `render` take: the sum of all of a song's windows.
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
    auto models = engine::load_analyzer_models(catalogue.list(),
                                               {arguments.tagger, engine::FileTags::ignored});
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

// Scores all files, once for each kind of damage; damage 0 is none.
Expected<Evaluation> evaluate(const EvalGenreArguments& arguments) {
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
    Evaluation evaluation;
    evaluation.genres = (*model)->genres;
    evaluation.pair = catalogue->pair();
    evaluation.files = files->size();
    // Fewer files of a genre say little about its recall.
    constexpr std::ptrdiff_t kEnoughFiles = 5;
    evaluation.asked = asked_genres(*files, evaluation.genres, kEnoughFiles);
    const std::size_t damages = arguments.with_damage ? std::size(audio::kDamageNames) : 1;
    for (std::size_t damage = 0; damage < damages; ++damage) {
        // Each file has its place, whichever thread takes it.
        std::vector<Expected<AnalyzedFile>> analyzed(files->size(), fail("not analysed"));
        run_parallel(files->size(), arguments.threads, [&](std::size_t i) {
            analyzed[i] = analyze_file((*files)[i], static_cast<audio::Damage>(damage), *models);
        });
        std::vector<audio::WindowScore> scores;
        for (std::size_t i = 0; i < analyzed.size(); ++i) {
            if (!analyzed[i]) {
                // A file that cannot be read is reported once, not for every damage.
                if (damage == 0) {
                    evaluation.skipped.push_back(analyzed[i].error().message);
                }
                continue;
            }
            auto part = audio::score_piece(**model, analyzed[i]->piece, i);
            std::move(part.begin(), part.end(), std::back_inserter(scores));
            // The decision is shown for undamaged files only.
            if (damage == 0) {
                evaluation.shown.push_back(std::move(analyzed[i]->shown));
            }
        }
        // A damage that fails for all files is reported once.
        if (damage > 0 && scores.empty() && !analyzed.empty() && !analyzed.front()) {
            evaluation.skipped.push_back(analyzed.front().error().message);
        }
        add_rows(**model, scores, std::string(audio::kDamageNames[damage]), evaluation);
    }
    return evaluation;
}

// Four decimals in JSON.
double rounded(double value) { return std::round(value * 1e4) / 1e4; }

// Over all files together, so that long files count for more.
double switches_a_minute(const Evaluation& evaluation) {
    double seconds = 0.0;
    int switches = 0;
    for (const Shown& shown : evaluation.shown) {
        seconds += shown.seconds;
        switches += shown.switches;
    }
    return seconds > 0.0 ? 60.0 * switches / seconds : 0.0;
}

// What the program shows of all files, and of those of one class.
struct ShownTally {
    int files = 0;
    int right_at_end = 0;
    double wrong_share = 0.0;
};
ShownTally tally_of(const Evaluation& evaluation, std::optional<std::size_t> of = {}) {
    ShownTally tally;
    for (const Shown& shown : evaluation.shown) {
        const std::size_t truth = audio::class_of(shown.truth, evaluation.genres);
        if (!of || truth == *of) {
            ++tally.files;
            tally.right_at_end += shown.at_end == truth ? 1 : 0;
            tally.wrong_share += shown.wrong_share;
        }
    }
    tally.wrong_share /= std::max(1, tally.files);
    return tally;
}

// "house", or "unknown" for none of the dances.
std::string class_name(const Evaluation& evaluation, std::size_t of) {
    return of < evaluation.genres.size() ? evaluation.genres[of] : "unknown";
}

// The document raks-eval-genre, version 1.
std::string json_of(const Evaluation& evaluation) {
    Json json = {{"format", "raks-eval-genre"}, {"version", 1}, {"files", evaluation.files}};
    json["skipped"] = evaluation.skipped;
    json["genres"] = Json::array();
    for (const std::string& genre : evaluation.genres) {
        json["genres"].push_back(genre);
    }
    json["asked"] = Json::array();
    for (const std::size_t c : evaluation.asked) {
        json["asked"].push_back(evaluation.genres[c]);
    }
    json["rows"] = Json::array();
    for (const PieceRow& row : evaluation.rows) {
        Json confusion = Json::array();
        for (const auto& line : row.tally.confusion) {
            Json shares = Json::array();
            for (const auto share : line) {
                shares.push_back(rounded(share));
            }
            confusion.push_back(shares);
        }
        json["rows"].push_back(
            {{"damage", row.damage},
             {"evidence", row.evidence},
             {"seconds", row.seconds},
             {"windows", row.tally.windows},
             {"macro_recall", rounded(row.tally.macro_recall)},
             {fmt::format("{}", fmt::join(evaluation.pair, "_or_")), rounded(row.tally.two_dances)},
             {"auroc_unknown", rounded(row.tally.auroc_unknown)},
             {"calibration_error", rounded(row.tally.calibration_error)},
             {"confusion", confusion}});
    }
    json["switches_a_minute"] = rounded(switches_a_minute(evaluation));
    const ShownTally all = tally_of(evaluation);
    json["right_at_end"] = all.right_at_end;
    json["wrong_share"] = rounded(all.wrong_share);
    json["shown"] = Json::array();
    for (const Shown& shown : evaluation.shown) {
        json["shown"].push_back({{"file", shown.file},
                                 {"genre", audio::shown_genre(shown.truth)},
                                 {"switches", shown.switches},
                                 {"right", rounded(shown.right_share)},
                                 {"at_end", class_name(evaluation, shown.at_end)},
                                 {"wrong", rounded(shown.wrong_share)}});
    }
    return json.text(1) + "\n";
}

// The table of all rows, and a line about the decision.
std::string text_of(const Evaluation& evaluation) {
    std::string text = fmt::format("{:16} {:9} {:>6} {:>7} {:>7} {:>8} {:>7}\n",
                                   "sound",
                                   "evidence",
                                   "window",
                                   "macro",
                                   "2 dance",
                                   "unknown",
                                   "ECE");
    for (const PieceRow& row : evaluation.rows) {
        text += fmt::format("{:16} {:9} {:4.1f} s {:7.3f} {:7.3f} {:8.3f} {:7.3f}\n",
                            row.damage,
                            row.evidence,
                            row.seconds,
                            row.tally.macro_recall,
                            row.tally.two_dances,
                            row.tally.auroc_unknown,
                            row.tally.calibration_error);
    }
    const ShownTally all = tally_of(evaluation);
    text += fmt::format(
        "decision: {} of {} right at the end, a wrong dance {:.0f} % of the time, {:.2f} switches "
        "a "
        "minute\n",
        all.right_at_end,
        all.files,
        100.0 * all.wrong_share,
        switches_a_minute(evaluation));
    for (std::size_t c = 0; c <= evaluation.genres.size(); ++c) {
        if (const ShownTally own = tally_of(evaluation, c); own.files > 0) {
            text += fmt::format(
                "  {:10} {} of {}\n", class_name(evaluation, c), own.right_at_end, own.files);
        }
    }
    return text;
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
        print_json(json_of(*evaluation));
    } else {
        print_text(text_of(*evaluation));
    }
    return kExitDone;
}

}  // namespace raks::apps
