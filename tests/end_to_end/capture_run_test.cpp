// `raks capture run` on a take of the test studio.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

#include <nlohmann/json.hpp>

namespace raks::test {
namespace {

namespace fs = std::filesystem;

const fs::path kDance = fs::path(RAKS_SOURCE_DIR) / "tests/data/bvh/dance/own_dance.bvh";

class CaptureRun : public ProgramTest {
 protected:
    CaptureRun() { make_take(kDance); }

    void make_take(const fs::path& dance) const {
        const auto made = run({"simulate", dance.string(), "--points", "-o", path("take")});
        EXPECT_EQ(made.exit_code, 0) << made.err;
    }
    /// The dance so many times in a row.
    void make_long_take(int times) const {
        std::string text = *read_text_file(kDance, 1'000'000);
        const std::size_t motion = text.find("Frame Time:");
        const std::string frames = text.substr(text.find('\n', motion) + 1);
        for (int i = 1; i < times; ++i) {
            text += frames;
        }
        const std::string count = "Frames: 60";
        text.replace(text.find(count), count.size(), "Frames: " + std::to_string(60 * times));
        ASSERT_TRUE(write_file(folder_ / "long.bvh", text));
        fs::remove_all(folder_ / "take");
        make_take(folder_ / "long.bvh");
    }

    [[nodiscard]] bool has(const std::string& file) const {
        return fs::exists(folder_ / "take" / file);
    }
    /// As if the file had been made an hour ago.
    void make_old(const std::string& file) const {
        const fs::path made = folder_ / "take" / file;
        fs::last_write_time(made, fs::last_write_time(made) - std::chrono::hours(1));
    }
};

bool says(const ProcessResult& result, const std::string& part) {
    return result.err.find(part) != std::string::npos;
}

TEST_F(CaptureRun, does_what_is_missing_or_outdated_and_nothing_else) {
    const auto first = run({"run", path("take")});
    EXPECT_EQ(first.exit_code, 0) << first.err;
    EXPECT_TRUE(says(first, "raks: sync: kept as it is: there is nothing to make it from"))
        << first.err;
    EXPECT_TRUE(says(first, "raks: track: missing")) << first.err;
    EXPECT_TRUE(says(first, "raks: report: missing")) << first.err;
    EXPECT_TRUE(has("tracks.csv"));
    EXPECT_TRUE(has("dance.bvh"));
    EXPECT_TRUE(has("report.html"));
    // A second in which nothing repeats, and no song that tells its beats.
    EXPECT_EQ(first.out, "raks train figure " + path("take") + "/dance.bvh --once -o mine\n");

    const auto again = run({"run", path("take")});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(says(again, "raks: track: up to date")) << again.err;
    EXPECT_TRUE(says(again, "raks: report: up to date")) << again.err;

    make_old("tracks.csv");
    const auto outdated = run({"run", path("take")});
    EXPECT_EQ(outdated.exit_code, 0) << outdated.err;
    EXPECT_TRUE(says(outdated, "raks: track: something that it is made from has changed"));
    EXPECT_TRUE(says(outdated, "raks: report: something that it is made from has changed"));
}

TEST_F(CaptureRun, ends_with_the_step_that_cannot_be_done) {
    fs::remove(folder_ / "take" / "labels.tsv");
    const auto result = run({"run", path("take")});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(says(result, "labels.tsv: is not there; run raks capture label first"))
        << result.err;
    EXPECT_FALSE(has("tracks.csv"));
    EXPECT_FALSE(has("report.html"));
}

TEST_F(CaptureRun, keeps_what_is_done_when_it_is_stopped) {
    // Twenty seconds, which are solved for long enough to be stopped meanwhile.
    make_long_take(10);
    CapturedProcess raks(plan({"run", path("take")}));
    ASSERT_TRUE(raks.wait_for_output("raks: solve: missing"));
    raks.send(SIGINT);
    const ProcessResult stopped = raks.wait();
    EXPECT_EQ(stopped.exit_code, 128 + SIGINT) << stopped.err;
    EXPECT_TRUE(has("tracks.csv"));
    EXPECT_FALSE(has("dance.bvh"));
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "take")) {
        EXPECT_EQ(entry.path().filename().string().find("part"), std::string::npos) << entry.path();
    }
    const auto again = run({"run", path("take")});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(says(again, "raks: track: up to date")) << again.err;
    EXPECT_TRUE(says(again, "raks: solve: missing")) << again.err;
}

TEST_F(CaptureRun, figures_of_the_solve_are_json_on_request) {
    ASSERT_EQ(run({"track", path("take")}).exit_code, 0);
    const auto solved = run({"solve", path("take"), "--json"});
    ASSERT_EQ(solved.exit_code, 0) << solved.err;
    const auto figures = nlohmann::json::parse(solved.out, nullptr, false);
    ASSERT_FALSE(figures.is_discarded()) << solved.out;
    EXPECT_EQ(figures["format"], "raks-solve");
    EXPECT_NEAR(figures["height_m"].get<double>(), 1.714, 0.05);
    EXPECT_LT(figures["residual_mm"].get<double>(), 15.0);
    EXPECT_EQ(figures["markers"].size(), 20U);
    EXPECT_GT(figures["feet"]["left"]["planted"].get<double>(), 0.0);
    EXPECT_FALSE(figures["bones"].empty());
    EXPECT_GE(figures["limits"]["frames_beyond"].get<double>(), 0.0);
    EXPECT_TRUE(figures["doubts"].is_array());
}

TEST_F(CaptureRun, reports_of_what_there_is_so_far) {
    const auto result = run({"report", path("take"), "-o", path("page.html")});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(fs::exists(path("page.html")));
    const auto page = [this] { return *read_text_file(folder_ / "page.html", 1'000'000); };
    EXPECT_EQ(page().find("<video"), std::string::npos);
    ASSERT_TRUE(write_file(folder_ / "take/side_by_side.mp4", "a film"));
    EXPECT_EQ(run({"report", path("take"), "-o", path("page.html")}).exit_code, 0);
    EXPECT_NE(page().find("src=\"take/side_by_side.mp4\""), std::string::npos);
    expect_one_line({"report", path("take"), "--truth", path("take") + "/truth"},
                    1,
                    "has no tracks to compare");
    expect_one_line({"run", path("nowhere")}, 1, "no capture: it has no capture.toml");
}

}  // namespace
}  // namespace raks::test
