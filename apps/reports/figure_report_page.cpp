#include "apps/reports/figure_report_page.hpp"

#include <algorithm>
#include <span>
#include <string_view>

#include "apps/reports/figure_report_charts.hpp"
#include "apps/reports/web_page.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using motion::ClassifierEvaluation;
using motion::DancerEvaluation;
using motion::Decisions;
using motion::FigureReport;
using motion::Part;

// "cross_body_lead" as "cross body lead", escaped for HTML.
std::string words_of(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return xml_text(name);
}

std::string_view name_of(motion::DanceRole role) {
    return motion::kRoleNames[static_cast<std::size_t>(role)];
}

std::string_view name_of(Part part) { return motion::kPartNames[static_cast<std::size_t>(part)]; }

using Parts = std::span<const Part>;

// A grid with one cell a part, headed by the part's name in its colour; `draw(part)` gives the
// cell's content.
template <typename Draw>
std::string side_by_side(const FigureReport& figure, const Draw& draw) {
    std::string grid = "<div class=\"three\">\n";
    for (const Part part : parts_of(figure.features)) {
        grid += fmt::format("<div><h4 style=\"color:{}\">{}</h4>\n{}</div>\n",
                            colour_of(part),
                            name_of(part),
                            draw(part));
    }
    return grid + "</div>\n";
}

// One row a figure: repeats, takes, and for each part the chosen number of states with its held-out
// log-likelihood.
std::string overview(const ReportData& data) {
    std::string table =
        "<table><thead><tr><th>figure</th><th>dancer</th><th>repeats</th><th>takes</th>";
    const Parts parts = parts_of(data.figures.front().features);
    for (const Part part : parts) {
        table += fmt::format("<th>states, {}</th><th>held out</th>", name_of(part));
    }
    table += "</tr></thead><tbody>\n";
    for (const FigureReport& figure : data.figures) {
        // The folds divide the takes among them.
        std::size_t takes = 0;
        for (const auto& fold : figure.folds) {
            takes += fold.size();
        }
        // The list of takes has one entry a repeat.
        table += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td>",
                             words_of(figure.figure),
                             name_of(figure.role),
                             figure.takes.size(),
                             takes);
        for (const Part part : parts) {
            const motion::PartSelection& selection =
                figure.parts[static_cast<std::size_t>(part)].selection;
            const auto& tried = selection.tried;
            // The chosen number is always among those that were tried.
            const auto chosen = std::find_if(tried.begin(), tried.end(), [&](const auto& one) {
                return one.states == selection.chosen;
            });
            table += fmt::format("<td>{} <span class=\"sub\">(peak {})</span></td><td>{:.2f}</td>",
                                 selection.chosen,
                                 selection.peak,
                                 chosen->held_out);
        }
        table += "</tr>\n";
    }
    return table + "</tbody></table>\n";
}

// Fig. 11 of each part.
std::string selection_section(const FigureReport& figure) {
    return fmt::format(
               "<h3>How many states</h3>\n<p>Mean log-likelihood of repeats whose take was left "
               "out, in {} folds. Ring: chosen, the fewest states within {:.0f} % of what is "
               "gained up to the peak; dashed ring: the peak, where it is another. Training alone "
               "never says stop.</p>\n",
               figure.folds.size(),
               100.0 * motion::StateSelectionOptions{}.saturation) +
           side_by_side(figure, [&](Part part) {
               return draw_selection(part, figure.parts[static_cast<std::size_t>(part)].selection);
           });
}

// Fig. 12: a heading with the takes, then one row a feature.
std::string curves_section(const FigureReport& figure) {
    std::string section = fmt::format(
        "<h3>What the states mean</h3>\n<p>{} repeats (grey) over the counts and, in colour, the "
        "means of the states that they pass through. Of each part the two features that move most "
        "from state to state.</p>\n<div class=\"row\">",
        figure.shown.size());
    // Columns of this row and of the curves below have the same width.
    for (const std::size_t r : figure.shown) {
        section += fmt::format("<div class=\"take\">take {}</div>", xml_text(figure.takes[r]));
    }
    section += "</div>\n";
    for (const Part part : parts_of(figure.features)) {
        for (const auto& curve : figure.parts[static_cast<std::size_t>(part)].curves) {
            section += fmt::format(
                "<div class=\"feature\"><b style=\"color:{}\">{}</b> &nbsp;{}, {} "
                "<span class=\"sub\">&nbsp;{:.0f} % of its variance lies between states</span>"
                "</div>\n<div class=\"row\">{}</div>\n",
                colour_of(part),
                name_of(part),
                xml_text(curve.name),
                curve.unit,
                100.0 * curve.explained,
                draw_curve(part, curve, figure));
        }
    }
    return section;
}

// Figs. 13 and 14 of each part.
std::string tables_section(const FigureReport& figure) {
    return "<h3>Counts against states</h3>\n<p>Which share of each count (rows, %) is spent in "
           "which state: the most likely path of every repeat. A sharp diagonal says that the "
           "states follow the beat.</p>\n" +
           side_by_side(figure, [&](Part part) { return draw_occurrence(part, figure); }) +
           "<h3>How long states last</h3>\n<p>In beats: every repeat (dots), mean and standard "
           "deviation. Dashed: all states of the same length.</p>\n" +
           side_by_side(figure, [&](Part part) { return draw_stays(part, figure); });
}

// A confusion matrix: rows are danced, columns decided; right cells green, wrong ones red.
std::string decisions_table(const std::string& caption,
                            const std::vector<std::string>& figures,
                            const Decisions& decisions) {
    std::string table = fmt::format(
        "<table><caption>{} <span class=\"sub\">&nbsp;{} of {} right"
        "</span></caption><thead><tr><th>danced</th>",
        caption,
        decisions.right(),
        decisions.total());
    for (const std::string& figure : figures) {
        table += fmt::format("<th>{}</th>", words_of(figure));
    }
    table += "</tr></thead><tbody>\n";
    for (std::size_t f = 0; f < figures.size(); ++f) {
        table += fmt::format("<tr><td>{}</td>", words_of(figures[f]));
        for (std::size_t taken = 0; taken < figures.size(); ++taken) {
            const int count = decisions.confusion[f][taken];
            table += fmt::format("<td class=\"{}\">{}</td>",
                                 count == 0   ? "none"
                                 : taken == f ? "own"
                                              : "wrong",
                                 count);
        }
        table += "</tr>\n";
    }
    return table + "</tbody></table>\n";
}

// "12 of 15 (80 %)".
std::string percent(int right, int total) {
    return total == 0 ? "-"
                      : fmt::format("{} of {} ({:.0f} %)", right, total, 100.0 * right / total);
}

// Decisions between every two figures, as if there were no others; only of unseen takes.
std::string pairs_table(const ClassifierEvaluation& classifier) {
    std::string table =
        "<table><caption>Two at a time, unseen takes</caption><thead><tr><th>between</th>";
    for (const DancerEvaluation& dancer : classifier.dancers) {
        table += fmt::format("<th>{}</th>", name_of(dancer.role));
    }
    // Both dancers' decisions exist only where both were reported.
    const bool has_couple = !classifier.couple.confusion.empty();
    table += has_couple ? "<th>both</th>" : "";
    table += "</tr></thead><tbody>\n";
    for (std::size_t a = 0; a < classifier.figures.size(); ++a) {
        for (std::size_t b = a + 1; b < classifier.figures.size(); ++b) {
            table += fmt::format("<tr><td>{}, {}</td>",
                                 words_of(classifier.figures[a]),
                                 words_of(classifier.figures[b]));
            const auto cell = [&](const Decisions& decisions) {
                table +=
                    fmt::format("<td>{}</td>",
                                percent(decisions.right_between(a, b), decisions.total_of(a, b)));
            };
            for (const DancerEvaluation& dancer : classifier.dancers) {
                cell(dancer.unseen);
            }
            if (has_couple) {
                cell(classifier.couple);
            }
            table += "</tr>\n";
        }
    }
    return table + "</tbody></table>\n";
}

// The weights of the parts, as shares of their sum, and the decisions by each part alone.
std::string weights_table(const ClassifierEvaluation& classifier, Parts parts) {
    std::string table =
        "<table><caption>Weights of the parts, and each part alone</caption><thead><tr>"
        "<th>dancer</th>";
    for (const Part part : parts) {
        table += fmt::format("<th>{}</th><th>alone</th>", name_of(part));
    }
    table += "</tr></thead><tbody>\n";
    for (const DancerEvaluation& dancer : classifier.dancers) {
        table += fmt::format("<tr><td>{}</td>", name_of(dancer.role));
        // Only the proportions of the weights matter.
        double sum = 0.0;
        for (const Part part : parts) {
            sum += dancer.weights[static_cast<std::size_t>(part)];
        }
        for (const Part part : parts) {
            const auto p = static_cast<std::size_t>(part);
            const Decisions& alone = dancer.unseen_by_part[p];
            table += fmt::format("<td>{:.2f}</td><td>{}</td>",
                                 dancer.weights[p] / sum,
                                 percent(alone.right(), alone.total()));
        }
        table += "</tr>\n";
    }
    return table + "</tbody></table>\n";
}

// The classifier: confusion on left-out takes and, with a test split, on unseen takes.
std::string classifier_section(const ClassifierEvaluation& classifier, Parts parts) {
    std::string section =
        "<h2 id=\"apart\">Tells figures apart</h2>\n<p>A model of every part of every figure says "
        "how likely a repeat is; the parts' log-likelihoods are weighted and summed, and the "
        "figure with the most wins. The weights come from the training takes, each scored by "
        "models that have not seen it. Rows: danced; columns: taken for.</p>\n"
        "<h3>Takes left out of training, one at a time</h3>\n<div class=\"tables\">\n";
    for (const DancerEvaluation& dancer : classifier.dancers) {
        section += decisions_table(
            std::string(name_of(dancer.role)) + " alone", classifier.figures, dancer.left_out);
    }
    section += "</div>\n";
    // Without a test split there are no unseen takes.
    if (classifier.dancers.front().unseen.total() == 0) {
        return section;
    }
    section += "<h3>Unseen takes</h3>\n<div class=\"tables\">\n";
    for (const DancerEvaluation& dancer : classifier.dancers) {
        section += decisions_table(
            std::string(name_of(dancer.role)) + " alone", classifier.figures, dancer.unseen);
    }
    if (!classifier.couple.confusion.empty()) {
        section += decisions_table("both together", classifier.figures, classifier.couple);
    }
    return section + pairs_table(classifier) + weights_table(classifier, parts) + "</div>\n";
}

}  // namespace

std::string draw_report(const ReportData& data) {
    std::string page = fmt::format(
        "<p class=\"sub\">Left-to-right hidden Markov models of {} with free durations. "
        "Log-likelihoods in nats a sample.</p>\n",
        data.figures.front().features == motion::FigureFeatures::positions
            ? "where the joints of the upper and the lower body are"
            : "the joints' angles of torso, arms and legs");
    // The overview first, then each figure, then all of them against one another.
    page += overview(data);
    for (const FigureReport& figure : data.figures) {
        page += fmt::format("<h2>{} <span class=\"sub\">of the {}, {} repeats</span></h2>\n",
                            words_of(figure.figure),
                            name_of(figure.role),
                            figure.takes.size());
        page += selection_section(figure) + curves_section(figure) + tables_section(figure);
    }
    if (data.classifier) {
        page += classifier_section(*data.classifier, parts_of(data.figures.front().features));
    }
    return web_page("How " + data.dance + " was learnt", page);
}

}  // namespace raks::apps
