#include "apps/raks/genre_evaluation.hpp"

#include <algorithm>
#include <cmath>

#include "apps/reports/reliability_table.hpp"
#include "audio/evaluate/piece_features.hpp"
#include "base/json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {

constexpr std::size_t kHeard = static_cast<std::size_t>(GenreVoice::heard);

// Four decimals in JSON.
double rounded(double value) { return std::round(value * 1e4) / 1e4; }

// What is shown of all files by one voice, or of those of one class.
struct Total {
    int files = 0;
    int right_at_end = 0;
    double wrong_share = 0.0;  // mean
    double seconds = 0.0;
    int switches = 0;
    // Over all files together, so that long files count for more.
    [[nodiscard]] double switches_a_minute() const {
        return seconds > 0.0 ? 60.0 * switches / seconds : 0.0;
    }
};

Total total_of(const GenreEvaluation& evaluation,
               std::size_t voice,
               std::optional<std::size_t> of = {}) {
    Total total;
    for (const GenreEvaluation::File& file : evaluation.shown) {
        const std::size_t truth = audio::class_of(file.genre, evaluation.genres);
        if (const auto& shown = file.shown[voice]; shown && (!of || truth == *of)) {
            ++total.files;
            total.right_at_end += shown->at_end == truth ? 1 : 0;
            total.wrong_share += shown->wrong_share;
            total.seconds += shown->seconds;
            total.switches += shown->switches;
        }
    }
    total.wrong_share /= std::max(1, total.files);
    return total;
}

// What was shown of all files by each voice that has something to say in any.
std::vector<ReliabilityColumn> claims_of(const GenreEvaluation& evaluation) {
    std::vector<ReliabilityColumn> columns;
    for (std::size_t voice = 0; voice < kGenreVoiceNames.size(); ++voice) {
        if (total_of(evaluation, voice).files == 0) {
            continue;
        }
        ReliabilityColumn& column = columns.emplace_back();
        column.name = kGenreVoiceNames[voice];
        for (const GenreEvaluation::File& file : evaluation.shown) {
            const std::vector<audio::Claim>& claims = file.claims[voice];
            column.claims.insert(column.claims.end(), claims.begin(), claims.end());
        }
    }
    return columns;
}

// "house", or "unknown" for none of the dances.
std::string class_name(const GenreEvaluation& evaluation, std::size_t of) {
    return of < evaluation.genres.size() ? evaluation.genres[of] : "unknown";
}

Json json_of_row(const GenreEvaluation::Row& row, const std::vector<std::string>& pair) {
    Json confusion = Json::array();
    for (const auto& line : row.tally.confusion) {
        Json shares = Json::array();
        for (const auto share : line) {
            shares.push_back(rounded(share));
        }
        confusion.push_back(shares);
    }
    return {{"damage", row.damage},
            {"evidence", row.evidence},
            {"seconds", row.seconds},
            {"windows", row.tally.windows},
            {"macro_recall", rounded(row.tally.macro_recall)},
            {fmt::format("{}", fmt::join(pair, "_or_")), rounded(row.tally.two_dances)},
            {"auroc_unknown", rounded(row.tally.auroc_unknown)},
            {"calibration_error", rounded(row.tally.calibration_error)},
            {"confusion", confusion}};
}

// By whom a dance would be shown, without those who have nothing to say in any file.
Json json_of_voices(const GenreEvaluation& evaluation) {
    Json voices = Json::array();
    for (std::size_t voice = 0; voice < kGenreVoiceNames.size(); ++voice) {
        if (const Total total = total_of(evaluation, voice); total.files > 0) {
            voices.push_back({{"evidence", std::string(kGenreVoiceNames[voice])},
                              {"files", total.files},
                              {"right_at_end", total.right_at_end},
                              {"wrong_share", rounded(total.wrong_share)},
                              {"switches_a_minute", rounded(total.switches_a_minute())}});
        }
    }
    return voices;
}

Json json_of_file(const GenreEvaluation& evaluation, const GenreEvaluation::File& file) {
    Json by = Json::object();
    for (std::size_t voice = 0; voice < kGenreVoiceNames.size(); ++voice) {
        if (const auto& shown = file.shown[voice]) {
            by[std::string(kGenreVoiceNames[voice])] = class_name(evaluation, shown->at_end);
        }
    }
    const ShownDance heard = file.shown[kHeard].value_or(ShownDance());
    return {{"file", file.name},
            {"genre", audio::shown_genre(file.genre)},
            {"switches", heard.switches},
            {"right", rounded(heard.right_share)},
            {"at_end", class_name(evaluation, heard.at_end)},
            {"wrong", rounded(heard.wrong_share)},
            {"at_end_by", by}};
}

}  // namespace

std::string genre_evaluation_json(const GenreEvaluation& evaluation) {
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
    for (const GenreEvaluation::Row& row : evaluation.rows) {
        json["rows"].push_back(json_of_row(row, evaluation.pair));
    }
    const Total heard = total_of(evaluation, kHeard);
    json["switches_a_minute"] = rounded(heard.switches_a_minute());
    json["right_at_end"] = heard.right_at_end;
    json["wrong_share"] = rounded(heard.wrong_share);
    json["shown_by"] = json_of_voices(evaluation);
    json["reliability"] = Json::object();
    for (const ReliabilityColumn& column : claims_of(evaluation)) {
        json["reliability"][column.name] = reliability_json(column.claims);
    }
    json["shown"] = Json::array();
    for (const GenreEvaluation::File& file : evaluation.shown) {
        json["shown"].push_back(json_of_file(evaluation, file));
    }
    return json.text(1) + "\n";
}

std::string genre_evaluation_text(const GenreEvaluation& evaluation) {
    std::string text = fmt::format("{:16} {:9} {:>6} {:>7} {:>7} {:>8} {:>7}\n",
                                   "sound",
                                   "evidence",
                                   "window",
                                   "macro",
                                   "2 dance",
                                   "unknown",
                                   "ECE");
    for (const GenreEvaluation::Row& row : evaluation.rows) {
        text += fmt::format("{:16} {:9} {:4.1f} s {:7.3f} {:7.3f} {:8.3f} {:7.3f}\n",
                            row.damage,
                            row.evidence,
                            row.seconds,
                            row.tally.macro_recall,
                            row.tally.two_dances,
                            row.tally.auroc_unknown,
                            row.tally.calibration_error);
    }
    const Total heard = total_of(evaluation, kHeard);
    text += fmt::format(
        "decision: {} of {} right at the end, a wrong dance {:.0f} % of the time, {:.2f} switches "
        "a minute\n",
        heard.right_at_end,
        heard.files,
        100.0 * heard.wrong_share,
        heard.switches_a_minute());
    for (std::size_t c = 0; c <= evaluation.genres.size(); ++c) {
        if (const Total own = total_of(evaluation, kHeard, c); own.files > 0) {
            text += fmt::format(
                "  {:10} {} of {}\n", class_name(evaluation, c), own.right_at_end, own.files);
        }
    }
    text += fmt::format(
        "{:12} {:>12} {:>7} {:>13}\n", "shown by", "right at end", "wrong", "changes / min");
    for (std::size_t voice = 0; voice < kGenreVoiceNames.size(); ++voice) {
        if (const Total total = total_of(evaluation, voice); total.files > 0) {
            text += fmt::format("{:12} {:>12} {:5.0f} % {:13.2f}\n",
                                kGenreVoiceNames[voice],
                                fmt::format("{} of {}", total.right_at_end, total.files),
                                100.0 * total.wrong_share,
                                total.switches_a_minute());
        }
    }
    return text + "\n" + reliability_table("confidence", claims_of(evaluation));
}

}  // namespace raks::apps
