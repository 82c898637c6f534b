#include "apps/reports/figure_report_page.hpp"

#include <gtest/gtest.h>

#include "apps/reports/chart.hpp"

namespace raks::apps {
namespace {

/// Two states, two counts, one repeat: numbers that can be found again in the page.
motion::FigureReport small_report() {
    motion::FigureReport report;
    report.figure = "side_<step>";
    report.beats = 2;
    report.samples_per_beat = 4;
    report.takes = {"60_\"1\""};
    report.folds = {{"a"}, {"b"}};
    report.shown = {0};
    for (motion::PartReport& part : report.parts) {
        part.selection.tried = {{2, 20.0, 10.25}, {3, 21.0, 9.0}};
        part.selection.peak = 2;
        part.selection.chosen = 2;
        part.paths = {{0, 0, 0, 0, 0, 1, 1, 1}};
        part.occurrence = {{1.0, 0.0}, {0.25, 0.75}};
        part.stays = {{1.25}, {0.75}};
        part.curves = {{"left knee & foot", "rad", 0.5, {{0, 1, 2, 3, 4, 5, 6, 7}}, {2.0, 6.0}}};
    }
    return report;
}

motion::ClassifierEvaluation small_evaluation() {
    motion::ClassifierEvaluation evaluation;
    evaluation.figures = {"basic", "cross_body_lead"};
    motion::DancerEvaluation lead;
    lead.weights = {0.0, 1.0, 3.0};
    lead.left_out = motion::no_decisions(2);
    lead.unseen = motion::no_decisions(2);
    lead.unseen.add(0, std::vector<double>{1.0, 0.0});
    lead.unseen.add(1, std::vector<double>{1.0, 0.0});
    lead.unseen_by_part = {lead.unseen, lead.unseen, lead.unseen};
    evaluation.dancers = {lead};
    return evaluation;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

TEST(ReportPage, draws_every_figure_of_the_paper_and_nothing_from_outside) {
    const std::string page = draw_report({"salsa", {small_report()}, std::nullopt});
    for (const char* part : {"How salsa was learnt",
                             "How many states",
                             "What the states mean",
                             "Counts against states",
                             "How long states last",
                             "10.25"}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    // Of each part: two of the selection, one curve, one table, one of the stays.
    EXPECT_EQ(count(page, "<svg"), 15U);
    EXPECT_EQ(count(page, "<svg"), count(page, "</svg>"));
    EXPECT_EQ(page.find("http"), std::string::npos);
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_EQ(page.find("Tells figures apart"), std::string::npos);
}

TEST(ReportPage, texts_from_tables_are_escaped) {
    const std::string page = draw_report({"<b>", {small_report()}, std::nullopt});
    EXPECT_NE(page.find("side &lt;step&gt;"), std::string::npos);
    EXPECT_NE(page.find("60_&quot;1&quot;"), std::string::npos);
    EXPECT_NE(page.find("left knee &amp; foot"), std::string::npos);
    EXPECT_EQ(page.find("<step>"), std::string::npos);
}

TEST(ReportPage, shows_who_was_taken_for_what) {
    const std::string page = draw_report({"salsa", {small_report()}, small_evaluation()});
    EXPECT_NE(page.find("1 of 2 right"), std::string::npos);
    EXPECT_NE(page.find("basic, cross body lead</td><td>1 of 2 (50 %)"), std::string::npos);
    EXPECT_NE(page.find("<td>0.75</td>"), std::string::npos);  // the legs' share of the weights
    EXPECT_EQ(count(page, "class=\"wrong\""), 1U);
    EXPECT_EQ(page.find("both together"), std::string::npos);
}

TEST(ReportPage, is_the_same_bytes_again) {
    const ReportData data{"salsa", {small_report()}, small_evaluation()};
    EXPECT_EQ(draw_report(data), draw_report(data));
}

TEST(ReportPage, of_positions_has_two_parts) {
    ReportData data;
    data.dance = "salsa";
    data.figures = {small_report()};
    data.figures[0].features = motion::FigureFeatures::positions;
    data.figures[0].parts[static_cast<std::size_t>(motion::Part::torso)] = {};
    data.classifier = small_evaluation();
    const std::string page = draw_report(data);
    EXPECT_EQ(page.find("torso"), std::string::npos);
    EXPECT_NE(page.find("states, upper"), std::string::npos);
    EXPECT_NE(page.find("where the joints"), std::string::npos);
}

TEST(Chart, steps_are_round_and_places_linear) {
    const struct {
        double range;
        int wanted;
        double step;
    } table[] = {{10.0, 5, 2.0}, {1.0, 4, 0.2}, {7.0, 5, 1.0}, {0.05, 5, 0.01}, {900.0, 2, 500.0}};
    for (const auto& row : table) {
        EXPECT_NEAR(round_step(row.range, row.wanted), row.step, 1e-12) << row.range;
    }
    EXPECT_GT(round_step(0.0, 5), 0.0);
    const Chart chart({.width = 100.0,
                       .height = 50.0,
                       .x = {0.0, 10.0},
                       .y = {-1.0, 1.0},
                       .left = 20.0,
                       .bottom = 10.0,
                       .top = 0.0,
                       .right = 0.0});
    EXPECT_EQ(chart.x(5.0), 60.0);
    EXPECT_EQ(chart.y(0.0), 20.0);
    EXPECT_EQ(chart.y(1.0), 0.0);
}

}  // namespace
}  // namespace raks::apps
