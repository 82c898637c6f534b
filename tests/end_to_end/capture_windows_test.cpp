// `raks capture label` and `raks capture correct` in their windows, used by mouse and keyboard.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/raks_capture/correct_pane.hpp"
#include "apps/raks_capture/label_pane.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/capture/camera/rig_file.hpp"
#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/markers/tracks.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/xvfb.hpp"

#include <glm/geometric.hpp>

namespace raks::test {
namespace {

namespace fs = std::filesystem;
using apps::CorrectLayout;
using apps::LabelLayout;
using render::Box;

constexpr Box kArea{0.0F, 0.0F, 1280.0F, 720.0F};

/// A take of points in the test studio, and a display as large as the windows.
class CaptureWindows : public ProgramTest {
 protected:
    CaptureWindows() : display_(1280, 720) {
        const auto made =
            run({"simulate",
                 (fs::path(RAKS_SOURCE_DIR) / "tests/data/bvh/dance/own_dance.bvh").string(),
                 "--points",
                 "-o",
                 path("take")});
        EXPECT_EQ(made.exit_code, 0) << made.err;
        seen_ = capture::read_observations(text("detections.csv"), "detections").value();
        rig_ = capture::parse_rig(text("rig.toml"), "rig").value().rig;
        markers_ = capture::read_marker_set(text("markers.toml"), "markers").value();
    }

    [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / "take" / name; }
    [[nodiscard]] std::string text(const std::string& name) const {
        return read_file(file(name)).value_or("");
    }

    void open(const char* command) {
        ProcessPlan in_window = plan({command, path("take")});
        std::erase(in_window.unset, "DISPLAY");
        program_.emplace(in_window);
        const std::string found = run_program({"xdotool",
                                               "search",
                                               "--sync",
                                               "--onlyvisible",
                                               "--name",
                                               std::string("Raks: ") + command});
        window_ = found.substr(0, found.find('\n'));
    }
    /// Presses a key so many times.
    void press(const std::string& key, int times = 1) const {
        // There is no window manager to give it the keyboard.
        std::vector<std::string> words = {"xdotool", "windowfocus", "--sync", window_};
        for (int i = 0; i < times; ++i) {
            words.insert(words.end(), {"key", key});
        }
        run_program(words);
    }
    void click(const glm::ivec2& at) const { drag(at, at); }
    void click(const Box& box) const {
        click(glm::ivec2(static_cast<int>(box.x + box.width / 2.0F),
                         static_cast<int>(box.y + box.height / 2.0F)));
    }
    void drag(const glm::ivec2& from, const glm::ivec2& to) const {
        std::vector<std::string> words = {"xdotool"};
        const auto move = [&](const glm::ivec2& at) {
            words.insert(
                words.end(),
                {"mousemove", "--window", window_, std::to_string(at.x), std::to_string(at.y)});
        };
        move(from);
        words.insert(words.end(), {"mousedown", "1"});
        if (from != to) {
            move((from + to) / 2);
            move(to);
        }
        words.insert(words.end(), {"mouseup", "1"});
        run_program(words);
    }
    /// Waits until a file has this text; false: it does not come to that.
    bool comes_to_be(const std::string& name, const std::string& expected) {
        return program_->wait_until([&](const ProcessResult&) { return text(name) == expected; });
    }
    /// Closes the window by its key.
    void close() {
        press("q");
        const ProcessResult ended = program_->wait();
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
    }

    Xvfb display_;
    capture::Observations seen_;
    capture::Rig rig_;
    capture::MarkerSet markers_;
    std::optional<CapturedProcess> program_;
    std::string window_;
};

glm::ivec2 whole(const glm::vec2& at) {
    return {static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y))};
}

glm::dvec2 hundredths(const glm::dvec2& pixel) {
    return {std::round(pixel.x * 100.0) / 100.0, std::round(pixel.y * 100.0) / 100.0};
}

/// Spots of the first picture that no other is near, so that a click is for them alone.
std::vector<glm::dvec2> lone_spots(const capture::Observations& seen, double apart) {
    std::vector<glm::dvec2> lone;
    const auto& spots = seen.films[0].pictures[0].detections;
    for (std::size_t i = 0; i < spots.size(); ++i) {
        bool is_lone = true;
        for (std::size_t j = 0; j < spots.size(); ++j) {
            is_lone = is_lone && (i == j || glm::distance(spots[i].pixel, spots[j].pixel) > apart);
        }
        if (is_lone) {
            lone.push_back(spots[i].pixel);
        }
    }
    return lone;
}

TEST_F(CaptureWindows, four_labels_are_clicked_exchanged_dragged_undone_and_saved) {
    fs::remove(file("labels.tsv"));
    const capture::Lens& lens = rig_.cameras[0].lens;
    const LabelLayout layout =
        apps::label_layout(kArea, rig_.cameras.size(), markers_.markers.size());
    const render::PicturePlace place(layout.picture, lens.width, lens.height, {});
    const auto spots = lone_spots(seen_, 24.0 / place.unit());
    ASSERT_GE(spots.size(), 4U);

    open("label");
    for (std::size_t i = 0; i < 4; ++i) {
        click(whole(place.in_box(spots[i])));
        click(layout.markers[i]);
    }
    // The second's place gets the third's name, and the other way round.
    click(whole(place.in_box(spots[1])));
    click(layout.markers[2]);
    // The fourth is pulled aside, and that taken back; then the first.
    const glm::ivec2 aside = whole(place.in_box(spots[3])) + glm::ivec2(60, 90);
    drag(whole(place.in_box(spots[3])), aside);
    press("u");
    const glm::ivec2 corner = whole(place.in_box({20.0, 30.0}));
    drag(whole(place.in_box(spots[0])), corner);
    press("s");

    const auto label = [&](std::size_t marker, const glm::dvec2& pixel) {
        return capture::MarkerLabel{
            rig_.cameras[0].name, 0, markers_.markers[marker].name, hundredths(pixel)};
    };
    const std::string expected = capture::labels_text({label(0, place.pixel_at(glm::vec2(corner))),
                                                       label(1, spots[2]),
                                                       label(2, spots[1]),
                                                       label(3, spots[3])});
    EXPECT_TRUE(comes_to_be("labels.tsv", expected)) << text("labels.tsv") << "not\n" << expected;
    close();
    EXPECT_EQ(text("labels.tsv"), expected);
}

TEST_F(CaptureWindows, edits_are_made_taken_back_tracked_and_saved) {
    ASSERT_EQ(run({"track", path("take")}).exit_code, 0);
    const capture::Tracks tracks = capture::read_tracks(text("tracks.csv"), "tracks").value();
    std::vector<double> shapes;
    for (const capture::Camera& camera : rig_.cameras) {
        shapes.push_back(static_cast<double>(camera.lens.width) / camera.lens.height);
    }
    const CorrectLayout layout =
        apps::correct_layout(kArea, shapes, markers_.markers.size(), std::nullopt);
    constexpr std::size_t kFrame = 4;
    const capture::Lens& lens = rig_.cameras[1].lens;
    const render::PicturePlace place(layout.views[1], lens.width, lens.height, {});
    const auto head = capture::project(rig_.cameras[1], tracks.at(kFrame, 0).place);
    ASSERT_TRUE(head);
    // Into a corner, where no spot is near.
    const glm::ivec2 corner = whole(place.in_box({30.0, 40.0}));

    open("correct");
    press("Right", static_cast<int>(kFrame));
    drag(whole(place.in_box(*head)), corner);
    press("e");
    click(layout.markers[5]);
    click(layout.markers[7]);
    press("bracketleft");
    press("Right", 2);
    press("bracketright");
    press("h");
    press("i");
    press("u");
    press("t");
    press("s");

    const auto& names = tracks.markers;
    using capture::EditKind;
    const std::vector<capture::Edit> made = {
        {EditKind::set,
         names[0],
         "",
         rig_.cameras[1].name,
         kFrame,
         kFrame,
         hundredths(place.pixel_at(glm::vec2(corner)))},
        {EditKind::swap, names[0], names[5], "", kFrame, kFrame, {}},
        {EditKind::hide, names[7], "", "", kFrame, kFrame + 2, {}}};
    const std::string expected = capture::edits_text(made);
    EXPECT_TRUE(comes_to_be("edits.jsonl", expected)) << text("edits.jsonl") << "not\n" << expected;
    close();
    EXPECT_EQ(run({"track", path("take")}).exit_code, 0);
    EXPECT_NE(capture::read_tracks(text("tracks.csv"), "tracks").value().at(kFrame, 5).place,
              tracks.at(kFrame, 5).place);
}

// Somebody who stands still and sways, as a network sees it in two cameras.
capture::KeypointFilm swaying(const capture::Camera& camera) {
    capture::KeypointFilm film{camera.name, camera.lens.width, camera.lens.height, "full", {}};
    for (std::size_t number = 0; number < 90; ++number) {
        capture::KeypointPicture& picture = film.pictures.emplace_back();
        picture.number = number;
        picture.time = static_cast<double>(number) / 30.0;
        picture.score = 1.0;
        for (std::size_t i = 0; i < capture::kBodyPoints; ++i) {
            const double down = static_cast<double>(i) / capture::kBodyPoints;
            const double side = i % 2 == 0 ? -0.2 : 0.2;
            const auto pixel = capture::project(
                camera, {side + 0.1 * std::sin(picture.time), 1.7 - 1.6 * down, 0.1 * down});
            picture.points[i] = {pixel.value(), 0.9};
        }
    }
    return film;
}

TEST_F(CaptureWindows, sides_are_exchanged_and_people_hidden_in_one_view) {
    std::string plan_text = "format = \"raks-capture\"\nversion = 1\nmethod = \"markerless\"\n";
    std::string clocks = "format = \"raks-clocks\"\nversion = 1\n";
    fs::create_directories(file("keypoints"));
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string& name = rig_.cameras[i].name;
        plan_text += "[[camera]]\nname = \"" + name + "\"\n";
        clocks += "[[clock]]\ncamera = \"" + name + "\"\noffset = 0.0\n";
        ASSERT_TRUE(write_file(file("keypoints/" + name + ".csv"),
                               capture::keypoints_text(swaying(rig_.cameras[i]))));
    }
    ASSERT_TRUE(write_file(file("capture.toml"), plan_text));
    ASSERT_TRUE(write_file(file("clocks.toml"), clocks));
    std::vector<double> shapes;
    for (std::size_t i = 0; i < 2; ++i) {
        const capture::Lens& lens = rig_.cameras[i].lens;
        shapes.push_back(static_cast<double>(lens.width) / lens.height);
    }
    const CorrectLayout layout =
        apps::correct_layout(kArea, shapes, 23, std::nullopt, apps::CorrectKind::joints);

    open("correct");
    const Box& view = layout.views[1];
    click(glm::ivec2(static_cast<int>(view.x) + 12, static_cast<int>(view.bottom()) - 12));
    press("Right", 4);
    press("e");
    press("bracketleft");
    press("Right", 2);
    press("bracketright");
    click(layout.hide_view);
    press("u");
    click(layout.redo);
    press("s");
    const std::string camera = rig_.cameras[1].name;
    using capture::EditKind;
    const std::string expected =
        capture::edits_text({{.kind = EditKind::exchange, .camera = camera, .first = 4, .last = 4},
                             {.kind = EditKind::hide, .camera = camera, .first = 4, .last = 6}});
    EXPECT_TRUE(comes_to_be("edits.jsonl", expected)) << text("edits.jsonl") << "not\n" << expected;
    close();
    const auto tracked = run({"track", path("take")});
    ASSERT_EQ(tracked.exit_code, 0) << tracked.err;
    const capture::Tracks tracks = capture::read_tracks(text("tracks.csv"), "tracks").value();
    EXPECT_EQ(tracks.at(5, 3).source, capture::PlaceSource::lost) << "one view is too few";
    EXPECT_EQ(tracks.at(7, 3).source, capture::PlaceSource::seen);
}

TEST_F(CaptureWindows, what_is_not_saved_is_asked_about_once) {
    const std::string before = text("labels.tsv");
    open("label");
    press("Down");
    press("BackSpace");
    press("q", 2);
    const ProcessResult ended = program_->wait();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(text("labels.tsv"), before);
}

TEST_F(CaptureWindows, without_a_display_a_line_says_what_else_to_do) {
    expect_one_line({"label", path("take")}, 1, "--labels");
    expect_one_line({"correct", path("take")}, 1, "edits.jsonl");
}

TEST_F(CaptureWindows, what_cannot_be_shown_is_said_in_one_line) {
    ASSERT_TRUE(write_file(file("edits.jsonl"),
                           R"({"edit": "hide", "marker": "haed", "first": 1, "last": 2})"
                           "\n"));
    expect_one_line({"correct", path("take")}, 1, "\"haed\" is unknown; did you mean \"head\"?");
    fs::remove(file("detections.csv"));
    expect_one_line({"correct", path("take")}, 1, "detections.csv: is not there");
    expect_one_line({"label", path("take")}, 1, "nothing to label");
    ASSERT_TRUE(
        write_file(file("labels.tsv"), "camera\tpicture\tmarker\tu\tv\ncam1\t0\thaed\t1\t1\n"));
    expect_one_line({"label", path("take")}, 1, "\"haed\" is unknown; did you mean \"head\"?");
    expect_one_line({"label"}, 2, "folder is required");
}

}  // namespace
}  // namespace raks::test
