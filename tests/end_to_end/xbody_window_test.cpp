// `raks xbody` in its window, used by mouse and keyboard.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/xbody/xbody_pane.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/render/import/tiny_tds.hpp"
#include "tests/support/file_drop.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/xvfb.hpp"

namespace raks::test {
namespace {

using motion::Bone;
using render::Box;

constexpr Box kArea{0.0F, 0.0F, 1280.0F, 720.0F};

/// A figure of rigid parts, and a display as large as the window.
class XbodyWindow : public ProgramTest {
 protected:
    XbodyWindow() : display_(1280, 720), model_(tds::read(tds::figure()).value()) {
        EXPECT_TRUE(write_file(folder_ / "me.3ds", tds::figure()));
    }

    void open() {
        ProcessPlan in_window = plan({"xbody", path("me.3ds")});
        std::erase(in_window.unset, "DISPLAY");
        program_.emplace(in_window);
        const std::string found =
            run_program({"xdotool", "search", "--sync", "--onlyvisible", "--name", "Raks: xbody"});
        window_ = found.substr(0, found.find('\n'));
    }
    void press(const std::string& key) const {
        // There is no window manager to give it the keyboard.
        run_program({"xdotool", "windowfocus", "--sync", window_, "key", key});
    }
    void click(const Box& box) const {
        run_program({"xdotool",
                     "mousemove",
                     "--window",
                     window_,
                     std::to_string(static_cast<int>(box.x + box.width / 2.0F)),
                     std::to_string(static_cast<int>(box.y + box.height / 2.0F)),
                     "mousedown",
                     "1",
                     "mouseup",
                     "1"});
    }
    [[nodiscard]] Box row_of(const std::string& name) const {
        const auto rows = apps::tree_rows(model_, apps::tree_view(model_));
        const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& row) {
            return model_.nodes[static_cast<std::size_t>(row.node)].name == name;
        });
        return layout_.rows[static_cast<std::size_t>(found - rows.begin())];
    }
    [[nodiscard]] Box line_of(Bone bone) const {
        render::HumanoidMap parts;
        parts.is_of_parts = true;
        const auto bones = apps::listed_bones(parts);
        return layout_.lines[static_cast<std::size_t>(std::find(bones.begin(), bones.end(), bone) -
                                                      bones.begin())];
    }
    void label(const std::string& name, Bone bone) const {
        click(row_of(name));
        click(line_of(bone));
        click(layout_.label);
    }

    Xvfb display_;
    render::Model model_;
    apps::XbodyLayout layout_ = apps::xbody_layout(kArea);
    std::optional<CapturedProcess> program_;
    std::string window_;
};

TEST_F(XbodyWindow, labels_are_given_taken_back_done_again_and_saved) {
    open();
    label("HandL", Bone::left_upper_arm);
    label("HandR", Bone::right_upper_arm);
    label("FootL", Bone::left_upper_leg);
    press("u");
    press("u");
    press("y");
    press("s");

    const std::vector<render::BoneLabel> made = {{.bone = Bone::left_upper_arm, .node = "HandL"},
                                                 {.bone = Bone::right_upper_arm, .node = "HandR"}};
    const std::string expected = render::bone_labels_text(made);
    const auto text = [&] { return read_file(folder_ / "me.labels.toml").value_or(""); };
    EXPECT_TRUE(program_->wait_until([&](const ProcessResult&) { return text() == expected; }))
        << text() << "not\n"
        << expected;
    press("q");
    const ProcessResult ended = program_->wait();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

TEST_F(XbodyWindow, a_model_that_is_dropped_takes_the_place_of_the_first) {
    ASSERT_TRUE(write_file(folder_ / "other.3ds", tds::figure()));
    open();
    drop_files(window_, {path("other.3ds")});
    EXPECT_EQ(run_program({"xdotool", "search", "--sync", "--name", "^Raks: xbody other.3ds$"}),
              window_ + "\n");
    label("HandL", Bone::left_upper_arm);
    press("s");
    EXPECT_TRUE(program_->wait_until([&](const ProcessResult&) {
        return std::filesystem::exists(folder_ / "other.labels.toml");
    }));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "me.labels.toml"));
    press("q");
    const ProcessResult ended = program_->wait();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

TEST_F(XbodyWindow, a_model_without_a_clip_is_filmed_in_one_picture) {
    for (const char* const name : {"me.avi", "me.png", "me"}) {
        const ProcessResult ended =
            run({"xbody", path("me.3ds"), "--size", "320x240", "-o", path(name)});
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
    }
    EXPECT_TRUE(std::filesystem::exists(folder_ / "me" / "000001.png"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "me" / "000002.png"));
    EXPECT_EQ(run({"xbody", path("me.3ds"), "-o", path("me.gif")}).exit_code, 1);
}

TEST_F(XbodyWindow, without_a_display_a_line_says_what_else_to_do) {
    const ProcessResult ended = run({"xbody", path("me.3ds")});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_NE(ended.err.find("-o X.png"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace raks::test
