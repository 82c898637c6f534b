#include "audio/genre/training/genre_page.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace raks::audio {
namespace {

constexpr double kWidth = 560.0;  // of a chart
constexpr double kHeight = 300.0;
constexpr double kMargin = 44.0;
// One for each kind of evidence.
constexpr std::array kColours = {"#c0392b", "#2471a3", "#1e8449", "#b7950b", "#6c3483", "#566573"};

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    }
    return safe;
}

/// A point of a chart over [0, 1] x [0, 1].
std::string point(double x, double y) {
    return fmt::format("{:.1f},{:.1f}",
                       kMargin + x * (kWidth - 2.0 * kMargin),
                       kHeight - kMargin - y * (kHeight - 2.0 * kMargin));
}

/// A curve through `points`, a dot at each.
std::string curve(const std::vector<std::pair<double, double>>& points, const char* colour) {
    std::string places;
    std::string dots;
    for (const auto& [x, y] : points) {
        places += point(x, y) + " ";
        dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3' fill='{}'/>",
                            kMargin + x * (kWidth - 2.0 * kMargin),
                            kHeight - kMargin - y * (kHeight - 2.0 * kMargin),
                            colour);
    }
    return fmt::format(
        "<polyline points='{}' stroke='{}' stroke-width='2' fill='none'/>{}", places, colour, dots);
}

/// An axis and its name; x ends at `most_x`, y at 1.
std::string frame_with(const std::string& inside,
                       const std::string& x,
                       double most_x,
                       const std::string& y) {
    std::string svg = fmt::format("<svg viewBox='0 0 {} {}' width='{}'>", kWidth, kHeight, kWidth);
    for (int tenth = 0; tenth <= 10; tenth += 2) {
        const double share = 0.1 * tenth;
        svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{:g}</text>",
                           kMargin + share * (kWidth - 2.0 * kMargin),
                           kHeight - kMargin + 18.0,
                           share * most_x);
        svg += fmt::format("<polyline points='{} {}' stroke='#ddd' fill='none'/>",
                           point(0.0, share),
                           point(1.0, share));
        svg += fmt::format("<text x='8' y='{:.1f}'>{:.1f}</text>",
                           kHeight - kMargin - share * (kHeight - 2.0 * kMargin) + 4.0,
                           share);
    }
    return svg + inside +
           fmt::format("<text x='{}' y='{}'>{}</text><text x='8' y='20'>{}</text></svg>",
                       kMargin,
                       kHeight - 8.0,
                       x,
                       y);
}

/// Macro recall against the window's length, one line a kind of evidence.
std::string recall_chart(const GenrePage& page) {
    constexpr double kMostSeconds = 10.0;
    std::map<std::string, std::vector<std::pair<double, double>>> lines;
    for (const GenrePage::Row& row : page.rows) {
        lines[row.evidence].emplace_back(row.seconds / kMostSeconds, row.tally.macro_recall);
    }
    std::string inside;
    std::size_t colour = 0;
    for (const auto& [evidence, points] : lines) {
        const char* const stroke = kColours[colour % kColours.size()];
        inside += curve(points, stroke);
        inside += fmt::format("<text x='{}' y='{}' fill='{}'>{}</text>",
                              kMargin + 80.0 * static_cast<double>(colour),
                              kMargin - 8.0,  // above the curves
                              stroke,
                              escaped(evidence));
        ++colour;
    }
    return frame_with(inside, "window, s", kMostSeconds, "mean recall of the genres");
}

/// How often what is said with some chance is right.
std::string reliability_chart(const GenreTally& tally) {
    std::string inside = fmt::format(
        "<polyline points='{} {}' stroke='#999' fill='none'/>", point(0.0, 0.0), point(1.0, 1.0));
    std::vector<std::pair<double, double>> points;
    for (const GenreTally::Bin& bin : tally.reliability) {
        if (bin.weight > 0.0) {
            points.emplace_back(bin.chance / bin.weight, bin.right / bin.weight);
        }
    }
    inside += curve(points, kColours[0]);
    return frame_with(inside, "chance that was said", 1.0, "share that was right");
}

std::string confusion_table(const GenrePage& page, const GenreTally& tally) {
    std::string html = "<table><tr><th>truth</th>";
    for (const Genre genre : page.genres) {
        html += fmt::format("<th>{}</th>", name_of(genre));
    }
    html += "<th>pieces</th></tr>";
    for (std::size_t truth = 0; truth < page.genres.size(); ++truth) {
        html += fmt::format("<tr><th>{}</th>", name_of(page.genres[truth]));
        const std::vector<double>& shares = tally.confusion[truth];
        const bool is_judged =
            std::any_of(shares.begin(), shares.end(), [](double share) { return share > 0.0; });
        for (std::size_t c = 0; c < page.genres.size(); ++c) {
            // The darker the more; green where it is right.
            html += is_judged ? fmt::format("<td style='background:rgba({},{:.2f})'>{:.2f}</td>",
                                            c == truth ? "30,132,73" : "192,57,43",
                                            0.6 * shares[c],
                                            shares[c])
                              : std::string("<td>-</td>");
        }
        html += fmt::format("<td>{}</td></tr>", tally.pieces[truth]);
    }
    return html + "</table>";
}

std::string rows_table(const GenrePage& page) {
    std::string html =
        "<table><tr><th>evidence</th><th>window</th><th>mean recall</th><th>salsa or "
        "belly</th><th>AUROC unknown</th><th>calibration error</th></tr>";
    for (const GenrePage::Row& row : page.rows) {
        html += fmt::format(
            "<tr><th>{}</th><td>{:.1f} "
            "s</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}"
            "</td></tr>",
            escaped(row.evidence),
            row.seconds,
            row.tally.macro_recall,
            row.tally.two_dances,
            row.tally.auroc_unknown,
            row.tally.calibration_error);
    }
    return html + "</table>";
}

std::string failing_table(const GenrePage& page) {
    std::vector<GenrePage::File> failing;
    std::copy_if(page.files.begin(),
                 page.files.end(),
                 std::back_inserter(failing),
                 [](const GenrePage::File& file) { return file.right < 0.5; });
    std::stable_sort(failing.begin(), failing.end(), [](const auto& a, const auto& b) {
        return a.right < b.right;
    });
    std::string html = "<table><tr><th>file</th><th>genre</th><th>right</th></tr>";
    for (const GenrePage::File& file : failing) {
        html += fmt::format("<tr><th>{}</th><td>{}</td><td>{:.2f}</td></tr>",
                            escaped(file.name),
                            name_of(file.truth),
                            file.right);
    }
    return html + "</table>";
}

}  // namespace

std::string genre_page(const GenrePage& page) {
    std::string html = fmt::format(
        "<!doctype html><html lang='en'><meta "
        "charset='utf-8'><title>{0}</title><style>body{{font:15px "
        "sans-serif;margin:2em;max-width:60em}}table{{border-collapse:collapse;margin:1em "
        "0}}th,td{{"
        "border:1px solid #ccc;padding:3px 9px;text-align:right}}th:first-child{{text-align:left}}"
        "svg text{{font:12px sans-serif}}</style><h1>{0}</h1>",
        escaped(page.title));
    html += "<p>Every piece was judged by a model that heard no piece of its artist.</p>";
    html += "<h2>Recall against the window's length</h2>" + recall_chart(page) + rows_table(page);
    const auto fused =
        std::find_if(page.rows.begin(), page.rows.end(), [](const GenrePage::Row& row) {
            return row.evidence == "fused" && row.seconds == 5.0;
        });
    if (fused != page.rows.end()) {
        html += "<h2>Fused, 5 s: what is taken for what</h2>" + confusion_table(page, fused->tally);
        html += "<h2>Reliability</h2>" + reliability_chart(fused->tally);
    }
    return html + "<h2>Files that are mostly wrong</h2>" + failing_table(page) + "</html>\n";
}

}  // namespace raks::audio
