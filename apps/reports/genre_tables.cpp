#include "apps/reports/genre_tables.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <map>
#include <utility>

#include "base/parallel.hpp"
#include "training/genre/genre_trainer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {

// Indexed by GenreEvidence.
constexpr const char* kEvidenceNames[] = {
    "fused", "MFCC", "MFCC+IGS", "rhythm", "sound", "network"};

// Log posteriors of all windows by this kind of evidence, one value a class.
std::vector<audio::GenreScores::Values> fused_scores(const JudgedScores& judged,
                                                     std::size_t window,
                                                     std::size_t classes,
                                                     audio::GenreEvidence evidence) {
    // The calibrated model fuses all evidence; single kinds have only the folds' fusions.
    const bool is_ready = judged.calibrated != nullptr && evidence == audio::GenreEvidence::fused;
    std::vector<audio::GenreScores::Values> logs;
    logs.reserve(judged.scores.size());
    for (const audio::WindowScore& score : judged.scores) {
        const audio::GenreFusion& fusion = is_ready
                                               ? judged.calibrated->fusion[window]
                                               : judged.fusions.of(score.fold, evidence, window);
        logs.push_back(audio::fuse(score, fusion, evidence, classes));
    }
    return logs;
}

// Index of the 5 s window in kGenreWindows, which count segments of half a second.
constexpr std::size_t kFiveSeconds = 3;
static_assert(audio::kGenreWindows[kFiveSeconds] == 10);

// Index of a fusion in its fold's list.
std::size_t place_of(audio::GenreEvidence evidence, std::size_t window) {
    return static_cast<std::size_t>(evidence) * audio::kGenreWindows.size() + window;
}

}  // namespace

FoldFusions::FoldFusions(std::span<const audio::WindowScore> scores,
                         std::size_t classes,
                         int threads) {
    constexpr std::size_t kPlaces = std::size(kEvidenceNames) * audio::kGenreWindows.size();
    // An entry for every fold that occurs.
    for (const audio::WindowScore& score : scores) {
        fusions_.try_emplace(score.fold, kPlaces);
    }
    for (auto& entry : fusions_) {
        std::vector<audio::WindowScore> others;
        // A fold's own scores would make its fusion look better than it is; with one fold there are
        // no others.
        std::copy_if(scores.begin(), scores.end(), std::back_inserter(others), [&](const auto& s) {
            return s.fold != entry.first || fusions_.size() == 1;
        });
        // Each place is fitted independently: kinds of evidence times window lengths.
        run_parallel(kPlaces, threads, [&](std::size_t place) {
            const std::size_t windows = audio::kGenreWindows.size();
            entry.second[place] =
                audio::fit_fusion(others,
                                  place % windows,
                                  classes,
                                  static_cast<audio::GenreEvidence>(place / windows));
        });
    }
}

const audio::GenreFusion& FoldFusions::of(int fold,
                                          audio::GenreEvidence evidence,
                                          std::size_t window) const {
    return fusions_.at(fold)[place_of(evidence, window)];
}

GenrePage page_of(const std::string& title,
                  const JudgedScores& judged,
                  std::span<const std::string> genres,
                  std::span<const std::size_t> asked) {
    using audio::GenreEvidence;
    GenrePage page;
    page.title = title;
    page.genres.assign(genres.begin(), genres.end());
    page.pair = judged.pair;
    // MFCC+IGS is optional evidence: its scores are all zero where it was left out.
    const bool has_similarity =
        std::any_of(judged.scores.begin(), judged.scores.end(), [](const auto& score) {
            return score.similarity[0] != 0.0F;
        });
    for (const GenreEvidence evidence : {GenreEvidence::mfcc,
                                         GenreEvidence::mfcc_similarity,
                                         GenreEvidence::rhythm,
                                         GenreEvidence::sound,
                                         GenreEvidence::network,
                                         GenreEvidence::fused}) {
        if (evidence == GenreEvidence::mfcc_similarity && !has_similarity) {
            continue;
        }
        for (std::size_t window = 0; window < audio::kGenreWindows.size(); ++window) {
            // One class more than genres: "unknown".
            const auto logs = fused_scores(judged, window, genres.size() + 1, evidence);
            GenrePage::Row row{
                kEvidenceNames[static_cast<std::size_t>(evidence)],
                audio::kGenreWindows[window] * audio::kSegmentSeconds,
                audio::tally(judged.scores, logs, window, genres, asked, judged.pair)};
            // A window length that no piece fills has no row.
            if (row.tally.windows > 0) {
                page.rows.push_back(std::move(row));
            }
        }
    }
    return page;
}

void print_page(const GenrePage& page, std::span<const std::size_t> asked) {
    fmt::print("{}\n{:10} {:>7} {:>9} {:>9} {:>9} {:>7}\n",
               page.title,
               "",
               "window",
               "macro",
               "2 dances",
               "unknown",
               "ECE");
    for (const GenrePage::Row& row : page.rows) {
        fmt::print("{:10} {:5.1f} s {:9.3f} {:9.3f} {:9.3f} {:7.3f}\n",
                   row.evidence,
                   row.seconds,
                   row.tally.macro_recall,
                   row.tally.two_dances,
                   row.tally.auroc_unknown,
                   row.tally.calibration_error);
        // The confusion of the decision that the program makes.
        if (row.evidence == "fused" && row.seconds == 5.0) {
            for (const std::size_t truth : asked) {
                fmt::print("    {:8} {:3} pieces  {:.2f}\n",
                           page.genres[truth],
                           row.tally.pieces[truth],
                           fmt::join(row.tally.confusion[truth], " "));
            }
        }
    }
    // The tables appear while the training goes on, also in a pipe.
    std::fflush(stdout);
}

std::vector<GenrePage::File> judged_files(std::span<const audio::PieceFeatures> pieces,
                                          const JudgedScores& judged,
                                          std::span<const std::string> genres,
                                          std::span<const std::size_t> asked) {
    const auto logs =
        fused_scores(judged, kFiveSeconds, genres.size() + 1, audio::GenreEvidence::fused);
    const std::span<const audio::WindowScore> scores = judged.scores;
    // Right windows and all windows of each piece.
    std::map<std::size_t, std::pair<int, int>> right_of_all;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const std::size_t truth = scores[i].truth;
        const bool is_asked = std::find(asked.begin(), asked.end(), truth) != asked.end();
        // Only windows of 5 s, and pieces whose genre is judged.
        if (scores[i].window != kFiveSeconds || !is_asked) {
            continue;
        }
        // The most probable of the asked genres: "unknown" cannot win here.
        const std::size_t best = *std::max_element(
            asked.begin(), asked.end(), [&](auto a, auto b) { return logs[i][a] < logs[i][b]; });
        auto& [right, all] = right_of_all[scores[i].piece];
        right += best == truth ? 1 : 0;
        ++all;
    }
    std::vector<GenrePage::File> files;
    files.reserve(right_of_all.size());
    for (const auto& [piece, counts] : right_of_all) {
        files.push_back({pieces[piece].name,
                         pieces[piece].genre,
                         static_cast<double>(counts.first) / counts.second});
    }
    return files;
}

std::vector<std::size_t> all_genres(std::size_t count) {
    std::vector<std::size_t> classes(count);
    for (std::size_t i = 0; i < count; ++i) {
        classes[i] = i;
    }
    return classes;
}

// With fewer recordings than five a share of right ones says little.
std::vector<std::size_t> enough_recordings(std::span<const audio::PieceFeatures> pieces,
                                           std::span<const std::string> genres) {
    std::vector<std::size_t> classes;
    for (std::size_t c = 0; c < genres.size(); ++c) {
        const auto count = std::count_if(pieces.begin(), pieces.end(), [&](const auto& piece) {
            return piece.genre == genres[c] && piece.kind == audio::PieceFeatures::Kind::recorded;
        });
        if (count >= 5) {
            classes.push_back(c);
        }
    }
    return classes;
}

}  // namespace raks::apps
