// `raks stick --edit`: the beats of a take set right in a window, by mouse and keyboard.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/grid/grid_pane.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/figures/label_tables.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/xvfb.hpp"
#include "training/cells/take_grid.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;
using render::Box;

constexpr Box kGridArea{0.0F, 0.0F, 1280.0F, 720.0F};

/// A take of twenty seconds and a display as large as the window.
class GridWindow : public ProgramTest {
 protected:
    GridWindow() : display_(1280, 720) {
        std::string text = *read_text_file(
            fs::path(RAKS_SOURCE_DIR) / "tests/data/bvh/dance/own_dance.bvh", 1'000'000);
        const std::string frames = text.substr(text.find('\n', text.find("Frame Time:")) + 1);
        for (int i = 1; i < 10; ++i) {
            text += frames;
        }
        text.replace(text.find("Frames: 60"), 10, "Frames: 600");
        EXPECT_TRUE(write_file(folder_ / "mine.bvh", text));
    }

    void write_table() {
        std::string table = "# by hand\ntake\ttime\thalf\tused\nother\t1\t1\t1\n";
        for (int beat = 0; beat < 12; ++beat) {
            table += fmt::format("mine\t{}\t{}\t1\n", 1.0 + 0.5 * beat, 1 + beat % 2);
        }
        ASSERT_TRUE(write_file(folder_ / "beats.tsv", table));
    }
    void open() {
        ProcessPlan in_window = plan({"stick",
                                      path("mine.bvh"),
                                      "--counts",
                                      path("beats.tsv"),
                                      "--edit",
                                      "--size",
                                      "1280x720"});
        std::erase(in_window.unset, "DISPLAY");
        program_.emplace(in_window);
        const std::string found = run_program(
            {"xdotool", "search", "--sync", "--onlyvisible", "--name", "Raks: beats of mine"});
        window_ = found.substr(0, found.find('\n'));
    }
    void press(const std::string& key) const {
        // There is no window manager to give it the keyboard.
        run_program({"xdotool", "windowfocus", "--sync", window_, "key", key});
    }
    void drag(double from, double to) const {
        const auto place = [&](double time) {
            return static_cast<int>(apps::place_of(layout_.lanes, view_, time));
        };
        const std::string y = std::to_string(static_cast<int>(layout_.beats.y + 20.0F));
        std::vector<std::string> words = {"xdotool"};
        const auto move = [&](int x) {
            words.insert(words.end(), {"mousemove", "--window", window_, std::to_string(x), y});
        };
        move(place(from));
        words.insert(words.end(), {"mousedown", "1"});
        if (from != to) {
            move(place(0.5 * (from + to)));
            move(place(to));
        }
        words.insert(words.end(), {"mouseup", "1"});
        run_program(words);
    }
    [[nodiscard]] std::vector<motion::TakeGrid> saved() const {
        const auto beats = motion::load_take_beats(folder_ / "beats.tsv");
        return beats ? motion::grids_of(*beats) : std::vector<motion::TakeGrid>{};
    }
    bool comes_to_be(const std::function<bool()>& is_so) {
        return program_->wait_until([&](const ProcessResult&) { return is_so(); });
    }
    void close() {
        press("q");
        const ProcessResult ended = program_->wait();
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
    }

    Xvfb display_;
    apps::GridLayout layout_ = apps::grid_layout(kGridArea, false);
    apps::GridView view_;  // as the window begins: the first ten seconds
    std::optional<CapturedProcess> program_;
    std::string window_;
};

TEST_F(GridWindow, beats_are_dragged_marked_taken_back_and_saved) {
    write_table();
    open();
    drag(2.5, 2.7);
    drag(4.0, 4.2);
    press("u");
    press("l");
    press("s");
    const auto is_right = [&] {
        const auto grids = saved();
        return grids.size() == 2 && grids[1].beats.size() == 12 &&
               std::abs(grids[1].beats[3].time - 2.7) < 0.02 && grids[1].beats[6].time == 4.0 &&
               !grids[1].beats[6].is_used;
    };
    EXPECT_TRUE(comes_to_be(is_right)) << read_file(folder_ / "beats.tsv").value_or("");
    close();
    EXPECT_EQ(saved()[0].take, "other") << "what else is in the table stays";
    EXPECT_EQ(read_file(folder_ / "beats.tsv")->substr(0, 10), "# by hand\n");
}

TEST_F(GridWindow, a_table_that_is_not_there_begins_with_a_proposal) {
    open();
    press("s");
    EXPECT_TRUE(comes_to_be([&] { return !saved().empty(); }));
    close();
    EXPECT_EQ(saved()[0].take, "mine");
    EXPECT_GT(saved()[0].beats.size(), 20U);
}

TEST_F(GridWindow, what_is_not_saved_is_asked_about_once) {
    write_table();
    const std::string before = *read_file(folder_ / "beats.tsv");
    open();
    press("d");
    press("q");
    press("q");
    const ProcessResult ended = program_->wait();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(*read_file(folder_ / "beats.tsv"), before);
}

TEST_F(GridWindow, what_cannot_be_set_right_is_said_in_one_line) {
    const std::vector<std::string> words = {
        "stick", path("mine.bvh"), "--unit", "cm", "--counts", path("beats.tsv"), "--edit"};
    expect_one_line(words, 1, "--strips FOLDER");
    ASSERT_TRUE(write_file(folder_ / "beats.tsv", "take\ttime\thalf\tused\nmine\t99\t1\t1\n"));
    expect_one_line(words, 1, "beat 1 lies at 99.000 s, the clip ends at");
    ASSERT_TRUE(write_file(folder_ / "beats.tsv", "take\ttime\thalf\tused\n"));
    expect_one_line(words, 1, "holds no beats");
    expect_one_line({"stick", path("mine.bvh"), "--edit"}, 2, "--counts");
    expect_one_line({"stick", path("mine.bvh"), "--counts", path("beats.tsv")}, 2, "--strips");
}

}  // namespace
}  // namespace raks::test
