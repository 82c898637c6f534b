// raks eval beats on a corpus of generated music with exact beats.
#include <gtest/gtest.h>

#include <csignal>
#include <sstream>

#include <fmt/format.h>

#include "audio/io/audio_file.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

#include <nlohmann/json.hpp>

namespace raks::test {
namespace {

namespace fs = std::filesystem;

class EvalBeats : public ProgramTest {
 protected:
    void SetUp() override {
        ProgramTest::SetUp();
        fs::create_directories(corpus());
        std::string index = "name\tclass\n";
        for (const auto& [style, name] : {std::pair{audio::Style::drums, "drums_120"},
                                          std::pair{audio::Style::montuno, "salsa_180"},
                                          std::pair{audio::Style::drums, "drums_100"}}) {
            const std::string bpm = std::string(name).substr(std::string(name).size() - 3);
            add(style, name, std::stod(bpm));
            index += fmt::format("{}\t{}\n", name, std::string(name).substr(0, 5));
        }
        ASSERT_TRUE(write_file(corpus() / "index.tsv", index));
    }
    void add(audio::Style style, const std::string& name, double bpm) const {
        audio::MusicPlan plan;
        plan.style = style;
        plan.tempo = {{0.0, bpm}};
        plan.seconds = 14.0;
        plan.channels = 1;
        const audio::GeneratedMusic music = write_music("corpus/" + name + ".wav", plan);
        std::string beats;
        for (const audio::ReferenceBeat& beat : music.beats) {
            beats += fmt::format("{:.6f}\t{}\n", to_seconds(beat.time), beat.bar_position);
        }
        ASSERT_TRUE(write_file(corpus() / (name + ".beats"), beats));
    }
    [[nodiscard]] fs::path corpus() const { return folder_ / "corpus"; }
    [[nodiscard]] nlohmann::json document(std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments = {"eval", "beats", corpus().string(), "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(result.err, "");
        return nlohmann::json::parse(result.out);
    }
    [[nodiscard]] std::string bytes(const std::string& name) const {
        return read_file(path(name)).value_or("missing: " + name);
    }
    void expect_one_line(std::vector<std::string> more, int exit_code, const std::string& part) {
        std::vector<std::string> arguments = {"eval", "beats", corpus().string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        ProgramTest::expect_one_line(arguments, exit_code, part);
    }
};

TEST_F(EvalBeats, prints_a_row_a_class_and_says_nothing_else) {
    const ProcessResult result = run({"eval", "beats", corpus().string(), "--each"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.out.rfind("| raks ", 0), 0U) << result.out;
    // In the order of the index, classes too.
    std::size_t at = 0;
    for (const char* row : {"\n| all ",
                            "\n| drums ",
                            "\n| salsa ",
                            "\n| drums_120 ",
                            "\n| salsa_180 ",
                            "\n| drums_100 "}) {
        const std::size_t found = result.out.find(row, at);
        ASSERT_NE(found, std::string::npos) << row << "\n" << result.out;
        at = found;
    }
    EXPECT_EQ(result.out.find("nan"), std::string::npos);
}

TEST_F(EvalBeats, tracks_steady_drums_and_scores_them_so) {
    const nlohmann::json scored = document({"--class", "drums"});
    EXPECT_EQ(scored["format"], "raks-eval-beats");
    EXPECT_EQ(scored["version"], 1);
    ASSERT_EQ(scored["trackers"].size(), 1U);
    const auto& tracker = scored["trackers"][0];
    EXPECT_EQ(tracker["name"], "raks");
    ASSERT_EQ(tracker["excerpts"].size(), 2U);
    ASSERT_EQ(tracker["classes"].size(), 2U);  // all, drums
    EXPECT_EQ(tracker["classes"][0]["never_locked"], 0);
    EXPECT_GE(tracker["classes"][0]["scores"]["F"], 0.95);
    EXPECT_GE(tracker["classes"][0]["scores"]["pred35"], 0.95);
    EXPECT_LE(tracker["classes"][0]["scores"]["lock_s"], 4.0);
}

/// Without how sure the beats and bars were, which other trackers' files do not say.
nlohmann::json without_confidence(nlohmann::json rows) {
    for (nlohmann::json& row : rows) {
        row["scores"].erase("sure, wrong");
        row["scores"].erase("sure, wrong 1");
    }
    return rows;
}

TEST_F(EvalBeats, writes_what_it_scored_and_scores_it_again_the_same) {
    const nlohmann::json own = document({"--out", path("heard")});
    EXPECT_NE(bytes("heard/salsa_180.beats").find('\t'), std::string::npos);
    EXPECT_FALSE(bytes("heard/salsa_180.pred").empty());
    const nlohmann::json both = document({"--peers", path("heard")});
    ASSERT_EQ(both["trackers"].size(), 2U);
    EXPECT_EQ(both["trackers"][1]["name"], "heard");
    EXPECT_EQ(without_confidence(both["trackers"][1]["classes"]),
              without_confidence(own["trackers"][0]["classes"]));
    EXPECT_EQ(without_confidence(both["trackers"][1]["excerpts"]),
              without_confidence(both["trackers"][0]["excerpts"]));
}

/// Analyze recognises the dance, too, whose tempi are likelier then: a hint moves beats by
/// microseconds here.
TEST_F(EvalBeats, hears_what_analyze_tells) {
    ASSERT_EQ(document({"--out", path("heard")})["version"], 1);
    const ProcessResult result = run({"analyze", (corpus() / "salsa_180.wav").string(), "--json"});
    const nlohmann::json analyzed = nlohmann::json::parse(result.out);
    constexpr double kMillisecond = 0.001;
    std::istringstream beats(bytes("heard/salsa_180.beats"));
    for (const auto& beat : analyzed["beats"]) {
        double time = 0.0;
        int bar_position = 0;
        ASSERT_TRUE(beats >> time >> bar_position);
        EXPECT_NEAR(time, beat["time"].get<double>(), kMillisecond);
        EXPECT_EQ(bar_position, beat["bar_position"].get<int>()) << time;
    }
    std::istringstream predicted(bytes("heard/salsa_180.pred"));
    for (const double expected : analyzed["predicted"]) {
        double time = 0.0;
        ASSERT_TRUE(predicted >> time);
        EXPECT_NEAR(time, expected, kMillisecond);
    }
    std::string left;
    EXPECT_FALSE(beats >> left || predicted >> left);
}

TEST_F(EvalBeats, compares_our_methods_with_other_trackers_in_one_table) {
    fs::create_directories(folder_ / "peers/perfect");
    fs::create_directories(folder_ / "peers/half");
    for (const char* name : {"drums_120", "salsa_180", "drums_100"}) {
        fs::copy_file(corpus() / (std::string(name) + ".beats"),
                      folder_ / "peers/perfect" / (std::string(name) + ".beats"));
    }
    fs::copy_file(corpus() / "drums_120.beats", folder_ / "peers/half/drums_120.beats");
    const ProcessResult result = run({"eval",
                                      "beats",
                                      "--peers",
                                      path("peers"),
                                      "--beat",
                                      "pointer",
                                      "--beat",
                                      "paper",
                                      "--beat",
                                      "paper-whole",
                                      "--out",
                                      path("heard"),
                                      corpus().string()});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("half: lacks 2 of 3 excerpts; they count as without beats"),
              std::string::npos)
        << result.err;
    std::size_t at = 0;
    for (const char* row : {"| 3 excerpts ",
                            "\n| raks ",
                            "\n| raks-paper ",
                            "\n| raks-paper-whole ",
                            "\n| half ",
                            "\n| perfect          | 100.0 ",
                            "\n\n| F ",
                            "\n\n| CMLt ",
                            "\n\n| AMLt ",
                            "\n\n| pred35 ",
                            "\n\n| downF "}) {
        const std::size_t found = result.out.find(row, at);
        ASSERT_NE(found, std::string::npos) << row << "\n" << result.out;
        at = found;
    }
    EXPECT_NE(bytes("heard/raks-paper/drums_120.pred"), "");
    EXPECT_FALSE(fs::exists(path("heard/raks-paper-whole/drums_120.pred"))) << "it predicts none";
    EXPECT_EQ(bytes("heard/raks-paper-whole/drums_120.beats").find('\t'), std::string::npos)
        << "it tells no bars";
}

TEST_F(EvalBeats, hears_with_the_network_asked_for) {
    const fs::path shipped = fs::path(RAKS_SOURCE_DIR) / "models/trained/beats.json";
    const nlohmann::json plain = document();
    EXPECT_EQ(document({"--network", shipped.string()}), plain);
    EXPECT_NE(document({"--network", "none"})["trackers"], plain["trackers"]);
    expect_one_line({"--network", path("none.json")}, 1, "none.json");

    // With each class's network the shipped one, both rows of the tables are the same.
    fs::create_directories(folder_ / "without");
    fs::copy_file(shipped, folder_ / "without/drums.json");
    expect_one_line({"--leave-class-out", path("without")}, 1, "salsa.json");
    fs::copy_file(shipped, folder_ / "without/salsa.json");
    const nlohmann::json both = document({"--leave-class-out", path("without")});
    ASSERT_EQ(both["trackers"].size(), 2U);
    EXPECT_EQ(both["trackers"][1]["name"], "raks-left-out");
    EXPECT_EQ(both["trackers"][1]["excerpts"], both["trackers"][0]["excerpts"]);
}

TEST_F(EvalBeats, a_network_averaged_or_heard_together_with_itself_is_that_network) {
    const Expected<std::string> shipped =
        read_file(fs::path(RAKS_SOURCE_DIR) / "models/trained/beats.json", 10'000'000);
    ASSERT_TRUE(shipped);
    auto network = nlohmann::json::parse(*shipped);
    network.erase("others");
    // Both are learnt from what the networks say and are left out.
    network.erase("pulses");
    network.erase("bars");
    network.erase("confidence");
    ASSERT_TRUE(write_file(path("one.json"), network.dump()));
    const nlohmann::json alone = document({"--network", path("one.json")});
    for (const char* const how : {"--average", "--together"}) {
        const ProcessResult result = run(
            {"train", "beats", how, path("one.json"), path("one.json"), "-o", path("made.json")});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(document({"--network", path("made.json")}), alone) << how;
    }
}

TEST_F(EvalBeats, the_same_bytes_every_time) {
    const ProcessResult first = run({"eval", "beats", corpus().string(), "--json"});
    const ProcessResult again = run({"eval", "beats", corpus().string(), "--json"});
    EXPECT_EQ(first.out, again.out);
}

TEST_F(EvalBeats, stopped_by_a_signal_keeps_what_was_finished_and_prints_no_table) {
    // A quarter of an hour beside the short ones: never done when the signal comes.
    audio::MusicPlan plan;
    plan.style = audio::Style::clicks;
    plan.seconds = 900.0;
    plan.rate = SampleRate(8'000);
    plan.channels = 1;
    write_music("corpus/salsa_180.wav", plan);
    ProcessPlan started =
        ProgramTest::plan({"eval", "beats", corpus().string(), "--out", path("heard")});
    started.terminal_columns = 80;
    CapturedProcess process(started);
    ASSERT_TRUE(process.wait_for_output("2 of 3 excerpts")) << process.output().err;
    process.send(SIGTERM);
    const ProcessResult result = process.wait();
    EXPECT_EQ(result.exit_code, 143);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(fs::exists(path("heard/drums_120.pred")));
    EXPECT_TRUE(fs::exists(path("heard/drums_100.beats")));
    EXPECT_FALSE(fs::exists(path("heard/salsa_180.beats"))) << "half heard";
}

TEST_F(EvalBeats, says_what_is_wrong_in_one_line) {
    expect_one_line({"--class", "slasa"}, 1, "class \"slasa\" is unknown; did you mean \"salsa\"?");
    expect_one_line({"--peers", path("nowhere")}, 1, "nowhere: cannot be listed");
    fs::create_directories(folder_ / "empty");
    expect_one_line({"--peers", path("empty")}, 1, "holds no tracker");
    fs::create_directories(folder_ / "peers/alien");
    expect_one_line({"--peers", path("peers")}, 1, "alien: has no beats of any excerpt");
    ASSERT_TRUE(write_file(path("peers/alien/salsa_180.beats"), "one\ntwo\n"));
    expect_one_line({"--peers", path("peers")}, 1, "salsa_180.beats: line 1: time is \"one\"");
    expect_one_line({"--out", (corpus() / "index.tsv").string()}, 1, "index.tsv: cannot be");
    expect_one_line({"--beat", "madmom"}, 2, "--beat");
    ASSERT_TRUE(write_file(corpus() / "salsa_180.wav", "no sound"));
    expect_one_line({}, 1, "salsa_180.wav: ");
    ASSERT_TRUE(write_file(corpus() / "index.tsv", "nothing\n"));
    expect_one_line({}, 1, "index.tsv: has no column \"name\"");
}

}  // namespace
}  // namespace raks::test
