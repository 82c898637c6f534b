// The help and the lists that lie over a picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "render/overlay/overlay.hpp"
#include "tests/render/overlay/overlay_fixture.hpp"

namespace raks::render {
namespace {

using test::locked_state;
using test::many_keys;
using test::Pixels;

class OverlayPanels : public test::OverlayFixture {};

TEST_F(OverlayPanels, help_lists_keys_in_the_middle) {
    for (const auto& [width, height] : {std::pair{640, 360}, std::pair{1280, 720}}) {
        const std::vector<HelpRow> rows = many_keys();
        OverlayState state = locked_state();
        state.help = rows;
        const Pixels pixels = draw(state, OverlayView::hidden, width, height);
        EXPECT_GT(pixels.drawn(0.28, 0.25, 0.72, 0.75), 0.99) << width;
        EXPECT_EQ(pixels.drawn(0.0, 0.0, 1.0, 0.01), 0.0) << width << ": it fits";
        EXPECT_EQ(pixels.drawn(0.0, 0.99, 1.0, 1.0), 0.0) << width << ": it fits";
    }
}

TEST_F(OverlayPanels, help_fits_into_narrow_and_small_pictures) {
    const std::vector<HelpRow> rows = many_keys();
    for (const auto& [width, height] :
         {std::pair{480, 854}, std::pair{320, 180}, std::pair{854, 300}, std::pair{340, 600}}) {
        OverlayState state;
        state.help = rows;
        const Pixels pixels = draw(state, OverlayView::hidden, width, height);
        // A pixel or two at each edge are free.
        const double right = 1.5 / width;
        const double down = 1.5 / height;
        EXPECT_GT(pixels.drawn(0.3, 0.3, 0.7, 0.7), 0.99) << width;
        EXPECT_EQ(pixels.drawn(0.0, 0.0, 1.0, down), 0.0) << width;
        EXPECT_EQ(pixels.drawn(0.0, 1.0 - down, 1.0, 1.0), 0.0) << width;
        EXPECT_EQ(pixels.drawn(0.0, 0.0, right, 1.0), 0.0) << width;
        EXPECT_EQ(pixels.drawn(1.0 - right, 0.0, 1.0, 1.0), 0.0) << width;
    }
}

/// What of a row of the keys can be clicked in the controls, by the rows' numbers.
std::set<std::size_t> key_rows(const OverlayControls& controls) {
    std::set<std::size_t> rows;
    for (const auto& [area, spot] : controls.spots) {
        if (spot.part == PanelPart::key) {
            rows.insert(spot.row);
        }
    }
    return rows;
}

TEST_F(OverlayPanels, every_key_is_on_one_page_of_the_help_inside_the_picture) {
    const std::vector<HelpRow> rows = many_keys();
    for (const auto& [width, height] :
         {std::pair{1280, 720}, std::pair{640, 360}, std::pair{480, 854}, std::pair{320, 240}}) {
        OverlayState state;
        state.help = rows;
        std::size_t pages = 1;
        std::set<std::size_t> seen;
        for (state.help_page = 0; state.help_page < pages; ++state.help_page) {
            const OverlayControls controls = controls_of(state, width, height);
            pages = controls.help_pages;
            for (const std::size_t row : key_rows(controls)) {
                EXPECT_TRUE(seen.insert(row).second) << row << " is on two pages, " << width;
            }
            for (const auto& [area, spot] : controls.spots) {
                EXPECT_GE(area.top, 0.0F) << width;
                EXPECT_LE(area.bottom, static_cast<float>(height)) << width;
            }
        }
        EXPECT_EQ(seen.size(), rows.size()) << width;
        EXPECT_EQ(pages > 1, height < 300) << width << " x " << height;
    }
}

TEST_F(OverlayPanels, a_key_of_the_help_lies_where_it_is_drawn) {
    const std::vector<HelpRow> rows = {{"VIEW", {"S", "T"}, "stick figure"}};
    OverlayState state;
    state.help = rows;
    const OverlayControls controls = controls_of(state, 1280, 720);
    std::map<std::size_t, OverlayControls::Area> caps;
    for (const auto& [area, spot] : controls.spots) {
        if (spot.part == PanelPart::key) {
            caps[spot.item] = area;
        }
    }
    ASSERT_EQ(caps.size(), 2U);
    EXPECT_LT(caps[0].right, caps[1].left);
    for (const auto& [item, area] : caps) {
        const auto spot =
            controls.spot_at((area.left + area.right) / 2.0F, (area.top + area.bottom) / 2.0F);
        ASSERT_TRUE(spot);
        EXPECT_EQ(spot->part, PanelPart::key);
        EXPECT_EQ(spot->item, item);
    }
    EXPECT_FALSE(controls.spot_at(1.0F, 1.0F)) << "beside the panel";
}

TEST_F(OverlayPanels, a_list_shows_its_chosen_row_at_any_size) {
    std::vector<ListRow> rows(1000);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i] = {.text = "row " + std::to_string(i), .is_checked = i % 2 == 0};
    }
    rows[3].level_dbfs = std::nanf("");
    const std::vector<std::string> pages = {"one", "two"};
    for (const auto& [width, height] :
         {std::pair{1280, 720}, std::pair{320, 240}, std::pair{64, 64}, std::pair{1, 1}}) {
        for (const std::size_t chosen : {std::size_t{0}, std::size_t{500}, std::size_t{5000}}) {
            OverlayState state;
            state.list = OverlayList{.pages = pages, .rows = rows, .chosen = chosen};
            const OverlayControls controls = controls_of(state, width, height);
            const bool is_seen =
                std::any_of(controls.spots.begin(), controls.spots.end(), [&](const auto& spot) {
                    return spot.second.part == PanelPart::list_row &&
                           spot.second.row == std::min(chosen, rows.size() - 1);
                });
            EXPECT_TRUE(is_seen) << chosen << " at " << width;
        }
    }
    OverlayState empty;
    empty.list = OverlayList{.pages = pages};
    EXPECT_EQ(controls_of(empty, 640, 360).spots.size(), 3U) << "the panel and two pages";
}

TEST_F(OverlayPanels, every_part_of_a_line_of_help_is_seen) {
    const auto picture_of = [&](const HelpRow& row) {
        const std::vector<HelpRow> rows = {row};
        OverlayState state;
        state.help = rows;
        return draw(state, OverlayView::hidden);
    };
    const Pixels usual = picture_of({"VIEW", {"S"}, "stick figure"});
    EXPECT_NE(picture_of({"TEMPO", {"S"}, "stick figure"}), usual);
    EXPECT_NE(picture_of({"VIEW", {"S", "T"}, "stick figure"}), usual);
    EXPECT_NE(picture_of({"VIEW", {"S"}, "avatar"}), usual);
}

}  // namespace
}  // namespace raks::render
