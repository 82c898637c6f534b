#include "apps/reports/genre_page.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <map>
#include <utility>

#include "apps/reports/chart.hpp"
#include "apps/reports/web_page.hpp"
#include "base/parallel.hpp"
#include "training/genre/genre_trainer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {

// One colour a kind of evidence, in the order of the rows.
constexpr std::array kColours = {
    "#dc2626", "#2563eb", "#7c3aed", "#ca8a04", "#64748b", "#16a34a", "#0891b2"};

// An empty chart: x from 0 to `most_x`, y from 0 to 1.
Chart empty_chart(double most_x, std::string_view x_label) {
    Chart chart({.width = 560.0, .height = 280.0, .x = {0.0, most_x}, .y = {}, .x_label = x_label});
    chart.grid_y(5);
    for (int fifth = 0; fifth <= 5; ++fifth) {
        chart.tick_x(0.2 * fifth * most_x, fmt::format("{:g}", 0.2 * fifth * most_x));
    }
    return chart;
}

// A line with a dot at each point.
void draw_curve(Chart& chart, std::span<const Chart::Point> points, std::string_view colour) {
    chart.line(points, fmt::format("stroke=\"{}\" stroke-width=\"2\"", colour));
    for (const Chart::Point& point : points) {
        chart.dot(point, 3.0, fmt::format("fill=\"{}\"", colour));
    }
}

// Mean recall over the genres against the window's length, one line a kind of evidence, with a
// legend.
std::string recall_chart(const GenrePage& page) {
    // The rows come evidence by evidence: a new name begins a new line.
    // The longest window that genre models use.
    constexpr double kMostSeconds = 10.0;
    std::vector<std::pair<std::string, std::vector<Chart::Point>>> lines;
    for (const GenrePage::Row& row : page.rows) {
        if (lines.empty() || lines.back().first != row.evidence) {
            lines.emplace_back(row.evidence, std::vector<Chart::Point>());
        }
        lines.back().second.emplace_back(row.seconds, row.tally.macro_recall);
    }
    Chart chart = empty_chart(kMostSeconds, "window, s");
    std::string legend = "<p>";
    for (std::size_t i = 0; i < lines.size(); ++i) {
        // at() and %: more kinds than colours would begin again.
        const char* const colour = kColours.at(i % kColours.size());
        draw_curve(chart, lines[i].second, colour);
        legend +=
            fmt::format("<b style=\"color:{}\">{}</b> &nbsp; ", colour, xml_text(lines[i].first));
    }
    return legend + "</p>\n" + chart.svg();
}

// Share of right decisions against the posterior that was given to them, by bins of the posterior.
// Calibrated posteriors lie on the dashed diagonal.
std::string reliability_chart(const audio::GenreTally& tally) {
    std::vector<Chart::Point> points;
    // Sums of a bin become means; empty bins have no point.
    for (const audio::GenreTally::Bin& bin : tally.reliability) {
        if (bin.weight > 0.0) {
            points.emplace_back(bin.chance / bin.weight, bin.right / bin.weight);
        }
    }
    Chart chart = empty_chart(1.0, "chance that was said");
    chart.line(std::array{Chart::Point{0.0, 0.0}, Chart::Point{1.0, 1.0}},
               "stroke=\"#94a3b8\" stroke-dasharray=\"4 4\"");
    draw_curve(chart, points, kColours[1]);
    return chart.svg();
}

// Confusion matrix in shares of each true genre. Genres that were not judged have no row.
std::string confusion_table(const GenrePage& page, const audio::GenreTally& tally) {
    std::string html = "<table><thead><tr><th>truth</th>";
    for (const std::string& genre : page.genres) {
        html += fmt::format("<th>{}</th>", genre);
    }
    html += "<th>pieces</th></tr></thead><tbody>\n";
    for (std::size_t truth = 0; truth < page.genres.size(); ++truth) {
        const std::vector<double>& shares = tally.confusion[truth];
        if (std::all_of(shares.begin(), shares.end(), [](double share) { return share == 0.0; })) {
            continue;
        }
        html += fmt::format("<tr><td>{}</td>", page.genres[truth]);
        for (std::size_t c = 0; c < page.genres.size(); ++c) {
            html += fmt::format("<td class=\"{}\">{:.2f}</td>",
                                // Below half a per cent a cell is pale.
                                shares[c] < 0.005 ? "none"
                                : c == truth      ? "own"
                                                  : "wrong",
                                shares[c]);
        }
        html += fmt::format("<td>{}</td></tr>\n", tally.pieces[truth]);
    }
    return html + "</tbody></table>\n";
}

// All measures, one row for each kind of evidence and window length.
std::string rows_table(const GenrePage& page) {
    std::string html = fmt::format(
        "<table><thead><tr><th>evidence</th><th>window</th><th>mean recall</th><th>{}</th>"
        "<th>AUROC unknown</th><th>calibration error</th></tr></thead><tbody>\n",
        xml_text(fmt::format("{}", fmt::join(page.pair, " or "))));
    for (const GenrePage::Row& row : page.rows) {
        html += fmt::format(
            "<tr><td>{}</td><td>{:.1f} s</td><td>{:.3f}</td><td>{:.3f}</td>"
            "<td>{:.3f}</td><td>{:.3f}</td></tr>\n",
            xml_text(row.evidence),
            row.seconds,
            row.tally.macro_recall,
            row.tally.two_dances,
            row.tally.auroc_unknown,
            row.tally.calibration_error);
    }
    return html + "</tbody></table>\n";
}

// Recordings of which less than half of the windows are right, the worst first.
std::string failing_table(const GenrePage& page) {
    std::vector<GenrePage::File> failing;
    std::copy_if(page.files.begin(),
                 page.files.end(),
                 std::back_inserter(failing),
                 [](const GenrePage::File& file) { return file.right < 0.5; });
    std::stable_sort(failing.begin(), failing.end(), [](const auto& a, const auto& b) {
        return a.right < b.right;
    });
    std::string html =
        "<table><thead><tr><th>file</th><th>genre</th><th>right</th></tr></thead><tbody>\n";
    for (const GenrePage::File& file : failing) {
        html += fmt::format("<tr><td>{}</td><td>{}</td><td>{:.2f}</td></tr>\n",
                            xml_text(file.name),
                            audio::shown_genre(file.truth),
                            file.right);
    }
    return html + "</tbody></table>\n";
}

}  // namespace

std::string draw_genre_page(const GenrePage& page) {
    std::string body =
        "<p class=\"sub\">Every piece was judged by a model that heard no piece of its "
        "artist.</p>\n<h2>Recall against the window's length</h2>\n" +
        recall_chart(page) + rows_table(page);
    // The detailed charts are of the decision that the program makes: fused, at 5 s.
    const auto fused =
        std::find_if(page.rows.begin(), page.rows.end(), [](const GenrePage::Row& row) {
            return row.evidence == "fused" && row.seconds == 5.0;
        });
    if (fused != page.rows.end()) {
        body += "<h2>Fused, 5 s: what is taken for what</h2>\n" +
                confusion_table(page, fused->tally) +
                "<h2>Reliability</h2>\n<p>How often what was said with some chance was right; "
                "dashed: what it should be.</p>\n" +
                reliability_chart(fused->tally);
    }
    body += "<h2>Files that are mostly wrong</h2>\n" + failing_table(page);
    return web_page(page.title, body);
}

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
    std::vector<GenrePage::Row> songs;  // after all others
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
            const double seconds = audio::kGenreWindows[window] * audio::kSegmentSeconds;
            // One class more than genres: "unknown".
            const auto logs = fused_scores(judged, window, genres.size() + 1, evidence);
            GenrePage::Row row{
                kEvidenceNames[static_cast<std::size_t>(evidence)],
                seconds,
                audio::tally(judged.scores, logs, window, genres, asked, judged.pair)};
            // A window length that no piece fills has no row.
            if (row.tally.windows == 0) {
                continue;
            }
            page.rows.push_back(std::move(row));
            // What is danced to a song that is known: the sum of its windows.
            if (evidence == GenreEvidence::fused) {
                const auto all = audio::whole_pieces(judged.scores, logs, window);
                songs.push_back(
                    {"song",
                     seconds,
                     audio::tally(
                         all.scores, all.log_chances, window, genres, asked, judged.pair)});
            }
        }
    }
    page.rows.insert(page.rows.end(), songs.begin(), songs.end());
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
