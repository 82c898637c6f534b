#include "apps/reports/cell_report_page.hpp"

#include <gtest/gtest.h>

#include <string>

#include "motion/cells/cell_survey.hpp"
#include "tests/motion/dance/small_cells.hpp"

namespace raks::apps {
namespace {

std::string page_of(const motion::CellDance& dance) {
    return draw_cell_report(dance, motion::survey(dance.graph));
}

TEST(CellReportPage, shows_takes_arcs_and_kinds_and_nothing_from_outside) {
    motion::CellDance dance;
    dance.dance = "mine";
    dance.licence = "by <me>";
    dance.graph = motion::test::small_graph(3, 5, 2);
    dance.graph.takes[1].name = "a_<take>";
    dance.graph.cells[4].stands_at_end = true;
    const std::string page = page_of(dance);
    for (const char* part : {"How mine hangs together",
                             "15 of 21 labelled beats",
                             "168: 8 a beat",
                             "30: 2.0 a cell, at most 2; 0 cells have none",
                             "Arcs from take to take",
                             "by &lt;me&gt;",
                             "a_&lt;take&gt;",
                             ">hold<"}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    for (const char* part : {"http://", "https://", "<script"}) {
        EXPECT_EQ(page.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(page, page_of(dance));
}

}  // namespace
}  // namespace raks::apps
