// A window on a display of our own; keys through xdotool.
#include "engine/show/window_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/pending_file.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/themes.hpp"
#include "tests/support/file_drop.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/xvfb.hpp"

namespace raks::engine {
namespace {

using test::run_program;

constexpr int kMostPictures = 300;  // 5 s

/// Keeps what it gets and ends when `is_enough`; "x" is a key of its own.
class Watched final : public WindowContent {
 public:
    explicit Watched(std::function<bool(const Watched&)> is_enough)
        : is_enough_(std::move(is_enough)) {}

    bool handle(const KeyEvent& key) override {
        own_presses += key.key == key_of(U'x') ? 1 : 0;
        return key.key == key_of(U'x');
    }
    [[nodiscard]] std::vector<render::HelpRow> own_keys() const override {
        return {{"OWN", {"X", "Home"}, "something of its own"}};
    }
    void advance(double seconds) override { shown_for += seconds; }
    void draw(const WindowPicture& picture, render::OverlayState& overlay) override {
        const double now = cpu_ms();
        slowest = pictures > kSettled ? std::max(slowest, now - last_cpu_) : 0.0;
        last_cpu_ = now;
        motion::Pose pose;
        pose.hips_position.y = 0.9F;
        const render::Dancer dancer = picture.bodies.still(pose);
        picture.renderer.draw(picture.scene, std::span(&dancer, 1), picture.target);
        worn = picture.bodies.avatar().name;
        const std::vector<motion::PoseTrack> tracks(kDancers);
        worn_in_turn.clear();
        for (const render::Dancer& one : picture.bodies.at({.tracks = tracks}, {}, {})) {
            worn_in_turn.insert(one.avatar.number);
        }
        scene = picture.scene;
        target = picture.target;
        overlay.message = "its line";
        ++pictures;
    }
    [[nodiscard]] bool is_finished() const override {
        return is_enough_(*this) || pictures >= kMostPictures;
    }
    [[nodiscard]] render::Camera framed(render::Camera preset) const override {
        preset.distance = 3.0F;
        return preset;
    }

    static constexpr std::size_t kDancers = 3;
    static constexpr int kSettled = 10;  // pictures in which the driver does things once

    int own_presses = 0;
    int pictures = 0;
    double slowest = 0.0;        // CPU time of this thread in one picture, ms
    std::string worn;            // by the first dancer
    std::set<int> worn_in_turn;  // handles of kDancers
    double shown_for = 0.0;
    render::Scene scene;
    render::FrameTarget target;

 private:
    static double cpu_ms() {
        timespec now{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
    }

    std::function<bool(const Watched&)> is_enough_;
    double last_cpu_ = 0.0;
};

/// Sets $XDG_DATA_HOME; returns what it was.
std::string own_data_folder(const std::filesystem::path& folder) {
    const char* const before = std::getenv("XDG_DATA_HOME");  // NOLINT(concurrency-mt-unsafe)
    std::string old = before == nullptr ? "" : before;
    setenv("XDG_DATA_HOME", folder.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
    return old;
}

class WindowLoopOnXvfb : public ::testing::Test {
 protected:
    void SetUp() override {
        Settings settings;
        settings.size = "320x180";
        const auto look = read_look(settings);
        ASSERT_TRUE(look) << look.error().message;
        auto window = render::Window::create({.title = "raks loop", .width = 320, .height = 180});
        ASSERT_TRUE(window) << window.error().message;
        auto loop =
            WindowLoop::create(std::move(*window),
                               *look,
                               {.cards = Cards::shown,
                                .say = [this](const std::string& line) { said_.push_back(line); },
                                .is_stop_requested = [this] { return is_stopped_; }});
        ASSERT_TRUE(loop) << loop.error().message;
        loop_.emplace(std::move(*loop));
        const std::string found =
            run_program({"xdotool", "search", "--sync", "--name", "raks loop"});
        id_ = found.substr(0, found.find('\n'));
        run_program({"xdotool", "windowfocus", "--sync", id_});
    }

    /// Presses the keys, and shows a content until `is_enough`.
    Watched shown(const std::vector<std::string>& keys,
                  std::function<bool(const Watched&)> is_enough) {
        for (const std::string& key : keys) {
            run_program({"xdotool", "key", key});
        }
        Watched content(std::move(is_enough));
        end_ = loop_->run(content, actions_);
        return content;
    }
    /// The same while files are dropped on the window.
    Watched shown_with(const std::vector<std::string>& dropped,
                       std::function<bool(const Watched&)> is_enough) {
        const std::jthread dropping([&] { test::drop_files(id_, dropped); });
        return shown({}, std::move(is_enough));
    }
    [[nodiscard]] bool was_said(const std::string& start) const {
        return std::any_of(said_.begin(), said_.end(), [&](const std::string& line) {
            return line.rfind(start, 0) == 0;
        });
    }

    test::Xvfb xvfb_{640, 480};
    std::vector<std::string> said_;
    bool is_stopped_ = false;
    ActionDispatcher actions_{[this](const std::string& line) { said_.push_back(line); }};
    std::optional<WindowLoop> loop_;
    std::string id_;
    WindowEnd end_ = WindowEnd::finished;
};

TEST_F(WindowLoopOnXvfb, shows_content_after_content_and_tells_why_it_ended) {
    const Watched first = shown({}, [](const Watched& now) { return now.pictures >= 3; });
    EXPECT_EQ(end_, WindowEnd::finished);
    EXPECT_EQ(first.pictures, 3);
    EXPECT_EQ(first.target.width, 320);
    EXPECT_GT(first.shown_for, 0.0);
    is_stopped_ = true;
    const Watched second = shown({}, [](const Watched&) { return false; });
    EXPECT_EQ(end_, WindowEnd::quit);
    EXPECT_EQ(second.pictures, 1);
}

TEST_F(WindowLoopOnXvfb, a_key_quits) {
    const Watched content = shown({"q"}, [](const Watched&) { return false; });
    EXPECT_EQ(end_, WindowEnd::quit);
    EXPECT_LT(content.pictures, kMostPictures);
}

TEST_F(WindowLoopOnXvfb, a_key_is_the_contents_own_or_asks_for_an_action_or_means_nothing) {
    std::vector<double> seeks;
    actions_.on(Action::seek, [&](double seconds) { seeks.push_back(seconds); });
    const Watched content = shown({"x", "n", "z", "shift+Left", "Right"},
                                  [&](const Watched&) { return seeks.size() >= 2; });
    EXPECT_EQ(content.own_presses, 1);
    EXPECT_EQ(seeks, (std::vector{-30.0, 5.0}));
    EXPECT_TRUE(said_.empty()) << "N and Z mean nothing here: " << said_.front();
}

TEST_F(WindowLoopOnXvfb, l_and_v_go_through_themes_and_cameras_and_c_puts_the_camera_back) {
    const Watched first = shown({}, [](const Watched& now) { return now.pictures >= 1; });
    EXPECT_EQ(first.scene.theme->name, "stage");
    const Watched second = shown({"l", "v"}, [&](const Watched& now) {
        return now.pictures > 0 && now.scene.theme != first.scene.theme &&
               !(now.scene.camera == first.scene.camera);
    });
    EXPECT_EQ(second.scene.theme->name, theme_names()[1]);
    EXPECT_EQ(second.scene.camera.distance, 3.0F) << "as the content frames it";
    EXPECT_TRUE(was_said("theme "));
    EXPECT_TRUE(was_said("camera portrait"));
    run_program({"xdotool",
                 "mousemove",
                 "--window",
                 id_,
                 "100",
                 "100",
                 "mousedown",
                 "1",
                 "mousemove",
                 "--window",
                 id_,
                 "160",
                 "100",
                 "mouseup",
                 "1"});
    const Watched turned = shown({}, [&](const Watched& now) {
        return now.pictures > 0 && !(now.scene.camera == second.scene.camera);
    });
    EXPECT_NE(turned.scene.camera.yaw, second.scene.camera.yaw);
    const Watched back = shown({"c"}, [&](const Watched& now) {
        return now.pictures > 0 && now.scene.camera == second.scene.camera;
    });
    EXPECT_TRUE(back.scene.camera == second.scene.camera);
}

TEST_F(WindowLoopOnXvfb, p_saves_what_was_drawn_where_the_program_was_started) {
    const test::TemporaryFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    (void)shown({"p"}, [&](const Watched&) { return !said_.empty(); });
    std::filesystem::current_path(before);
    ASSERT_TRUE(was_said("screenshot saved: raks-"));
    const std::string name = said_.front().substr(std::string("screenshot saved: ").size());
    EXPECT_EQ(run_program({"identify", "-format", "%m %wx%h", (folder / name).string()}),
              "PNG 320x180");
}

std::string model(const std::string& name) {
    return std::string(RAKS_SOURCE_DIR) + "/tests/data/avatars/" + name;
}

TEST_F(WindowLoopOnXvfb, a_model_that_is_dropped_is_worn_when_it_is_there) {
    const Watched before = shown({}, [](const Watched& now) { return now.pictures >= 60; });
    EXPECT_EQ(before.worn, "Raks mannequin");
    const Watched after = shown_with({model("Godette_vrm_v4.vrm")}, [&](const Watched& now) {
        return now.worn != before.worn && now.pictures > Watched::kSettled;
    });
    EXPECT_NE(after.worn, before.worn);
    EXPECT_TRUE(was_said("avatar: ")) << "whose work it is";
    EXPECT_LT(after.scene.camera.distance, 1.5F * before.scene.camera.distance);
    // Figures, not bounds: machines differ.
    std::cout << "slowest picture before " << before.slowest << " CPU-ms, while it loads "
              << after.slowest << "\n";
}

TEST_F(WindowLoopOnXvfb, models_that_are_dropped_together_are_worn_in_turn) {
    const Watched after =
        shown_with({model("RiggedFigure.glb"), model("smoke_spring.vrm")}, [&](const Watched& now) {
            return now.worn != "Raks mannequin" && now.pictures > Watched::kSettled;
        });
    EXPECT_EQ(after.worn_in_turn.size(), 2U);
    EXPECT_EQ(std::count_if(said_.begin(),
                            said_.end(),
                            [](const std::string& line) { return line.starts_with("avatar: "); }),
              2)
        << "whose work each is";
}

TEST_F(WindowLoopOnXvfb, of_what_is_dropped_only_good_models_are_taken) {
    const test::TemporaryFolder folder;
    const std::string bad = (folder.path() / "bad.vrm").string();
    ASSERT_TRUE(write_file(bad, "glTF no more"));
    const Watched content = shown_with({bad, "/music/song.mp3"}, [&](const Watched& now) {
        return now.pictures > 0 && said_.size() >= 2;
    });
    EXPECT_EQ(content.worn, "Raks mannequin");
    EXPECT_TRUE(was_said(bad)) << "what is wrong with it";
    EXPECT_TRUE(was_said("/music/song.mp3: only models are taken here"));
}

TEST_F(WindowLoopOnXvfb, a_goes_through_the_mannequin_and_the_persons_own_avatars) {
    const test::TemporaryFolder folder;
    const std::string old = own_data_folder(folder.path());
    std::filesystem::create_directories(user_avatars_path());
    for (const std::string name : {"RiggedFigure.glb", "smoke_spring.vrm"}) {
        std::filesystem::copy(model(name), user_avatars_path() / name);
    }
    std::vector<std::string> seen;
    for (int press = 0; press < 3; ++press) {
        const std::string before = seen.empty() ? "Raks mannequin" : seen.back();
        seen.push_back(shown({"a"}, [&](const Watched& now) {
                           return now.pictures > 0 && now.worn != before;
                       }).worn);
    }
    own_data_folder(old);
    EXPECT_EQ(seen.back(), "Raks mannequin");
    EXPECT_NE(seen[0], seen[1]);
    EXPECT_TRUE(was_said("avatar: mannequin"));
}

TEST(WindowLoopHelp, lists_the_contents_own_keys_and_what_is_done_here_beside_them) {
    ActionDispatcher actions([](const std::string&) {});
    actions.on(Action::quit, [](double) {});
    actions.on(Action::reset_camera, [](double) {});
    const auto rows = help_rows({{"OWN", {"X", "Home"}, "something of its own"}}, actions);
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].text, "something of its own");
    EXPECT_EQ(rows[1].group, "VIEW");
    EXPECT_EQ(rows[1].keys, std::vector<std::string>{"C"}) << "Home is the content's";
    EXPECT_EQ(rows[2].text, "quit");
    EXPECT_EQ(rows[2].keys, (std::vector<std::string>{"Q", "Esc"}));
}

}  // namespace
}  // namespace raks::engine
