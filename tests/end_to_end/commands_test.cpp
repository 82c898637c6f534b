#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include <csignal>
#include "audio/io/audio_file.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/end_to_end/program_fixture.hpp"

#include <glm/geometric.hpp>

namespace raks::test {
namespace {

class Commands : public ProgramTest {
 protected:
    audio::GeneratedMusic write_music(const std::string& name,
                                      double bpm,
                                      double seconds,
                                      audio::Style style = audio::Style::montuno) const {
        audio::MusicPlan plan;
        plan.style = style;
        plan.tempo = {{0.0, bpm}};
        plan.seconds = seconds;
        return ProgramTest::write_music(name, plan);
    }
};

TEST_F(Commands, raks_alone_shows_three_examples) {
    const ProcessResult result = run({});
    EXPECT_EQ(result.exit_code, 0);
    for (const char* example : {"raks live", "raks play song.mp3", "raks render song.mp3"}) {
        EXPECT_NE(result.out.find(example), std::string::npos) << result.out;
    }
}

/// Every element closed in order, one root, no bare '<' or '&' in text: what an XML parser demands.
::testing::AssertionResult is_well_formed(const std::string& xml) {
    std::vector<std::string> open;
    int roots = 0;
    for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at)) {
        const std::size_t end = xml.find('>', at);
        if (end == std::string::npos) {
            return ::testing::AssertionFailure() << "a tag without end";
        }
        const std::string tag = xml.substr(at + 1, end - at - 1);
        if (std::count(tag.begin(), tag.end(), '"') % 2 != 0 ||
            tag.find('<') != std::string::npos) {
            return ::testing::AssertionFailure() << "bad tag " << tag.substr(0, 80);
        }
        const std::string name =
            tag.substr(tag[0] == '/', tag.find_first_of(" /?", 1) - (tag[0] == '/'));
        if (tag[0] == '/') {
            if (open.empty() || "/" + open.back() != tag) {
                return ::testing::AssertionFailure() << "unexpected <" << tag << ">";
            }
            open.pop_back();
        } else if (tag[0] != '?') {
            roots += open.empty() ? 1 : 0;
            if (tag.back() != '/') {
                open.push_back(name);
            }
        }
        at = end;
    }
    for (std::size_t at = xml.find('&'); at != std::string::npos; at = xml.find('&', at + 1)) {
        const std::size_t end = xml.find(';', at);
        if (end == std::string::npos || end - at > 5) {
            return ::testing::AssertionFailure() << "a bare &";
        }
    }
    if (!open.empty() || roots != 1) {
        return ::testing::AssertionFailure() << open.size() << " open, " << roots << " roots";
    }
    return ::testing::AssertionSuccess();
}

TEST_F(Commands, analyze_plots_every_panel) {
    const audio::GeneratedMusic music = write_music("a & b.wav", 120.0, 12.0, audio::Style::clicks);
    std::string reference;
    for (const audio::ReferenceBeat& beat : music.beats) {
        reference += std::to_string(to_seconds(beat.time)) + "\t1\n";
    }
    ASSERT_TRUE(write_file(path("a.beats"), reference));
    for (const char* method : {"pointer", "paper", "paper-whole"}) {
        const ProcessResult result = run({"analyze",
                                          path("a & b.wav"),
                                          "--beat",
                                          method,
                                          "--plot",
                                          path("a.svg"),
                                          "--reference",
                                          path("a.beats")});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        const auto svg = read_file(path("a.svg"));
        ASSERT_TRUE(svg);
        EXPECT_TRUE(is_well_formed(*svg));
        EXPECT_LT(svg->size(), 2'000'000U);
        for (const char* id : {"waveform",
                               "spectrogram",
                               "onsets",
                               "beats",
                               "tempo",
                               "bar",
                               "confidence",
                               "energy",
                               "form",
                               "accents",
                               "time"}) {
            EXPECT_NE(svg->find("<g id=\"" + std::string(id) + "\">"), std::string::npos) << id;
        }
        EXPECT_NE(svg->find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
        EXPECT_NE(svg->find("a &amp; b.wav"), std::string::npos);
    }
    EXPECT_EQ(files(), (std::vector<std::string>{"a & b.wav", "a.beats", "a.svg"}));
}

TEST_F(Commands, analyze_tells_tempo_and_beats) {
    const audio::GeneratedMusic music = write_music("drums.wav", 128.0, 20.0, audio::Style::drums);
    const ProcessResult result = run({"analyze", path("drums.wav"), "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const auto document = nlohmann::json::parse(result.out);
    EXPECT_EQ(document["format"], "raks-analysis");
    EXPECT_EQ(document["version"], 1);
    EXPECT_NEAR(document["duration"].get<double>(), 20.0, 0.01);
    EXPECT_NEAR(document["tempo"].back()["bpm"].get<double>(), 128.0, 1.0);
    // Beats of the last ten seconds are those that the generator played.
    int hits = 0;
    int wanted = 0;
    for (const audio::ReferenceBeat& reference : music.beats) {
        const double time = to_seconds(reference.time);
        if (time < 10.0 || time > 19.8) {
            continue;
        }
        ++wanted;
        for (const auto& beat : document["beats"]) {
            hits += std::abs(beat["time"].get<double>() - time) < 0.035 ? 1 : 0;
        }
    }
    EXPECT_GE(hits, wanted * 95 / 100) << wanted;
}

TEST_F(Commands, analyze_tags_the_music_every_three_seconds) {
    write_music("drums.wav", 128.0, 10.0, audio::Style::drums);
    const ProcessResult result = run({"analyze", path("drums.wav"), "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    auto document = nlohmann::json::parse(result.out);
    ASSERT_EQ(document["tagger"].size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& point = document["tagger"][i];
        EXPECT_NEAR(point["time"].get<double>(), 2.992 * static_cast<double>(i + 1), 0.02);
        ASSERT_EQ(point["strongest"].size(), 3U);
        double before = 1.0;
        for (const auto& tag : point["strongest"]) {
            EXPECT_FALSE(tag["tag"].get<std::string>().empty());
            EXPECT_LE(tag["probability"].get<double>(), before);
            before = tag["probability"].get<double>();
        }
    }
    // With the whole file before it the tags are the same; without the tagger all is that does not
    // follow from the dance.
    const ProcessResult whole = run({"analyze", path("drums.wav"), "--json", "--whole"});
    EXPECT_EQ(nlohmann::json::parse(whole.out)["tagger"], document["tagger"]);
    const ProcessResult off = run({"analyze", path("drums.wav"), "--json", "--tagger", "off"});
    auto without = nlohmann::json::parse(off.out);
    EXPECT_FALSE(without.contains("tagger"));
    for (const char* const follows : {"tagger", "genre", "beats", "predicted", "tempo"}) {
        document.erase(follows);
        without.erase(follows);
    }
    EXPECT_EQ(without, document);
}

TEST_F(Commands, without_the_taggers_weights_one_line_is_said_and_the_music_is_heard) {
    write_music("drums.wav", 128.0, 4.0, audio::Style::drums);
    const std::string weights = path("data/models/pretrained/msd_musicnn.tagger");
    std::filesystem::create_directories(std::filesystem::path(weights).parent_path());
    ASSERT_TRUE(write_file(weights, "raks-tagger\n"));
    ProcessPlan cut = plan({"analyze", path("drums.wav"), "--json"});
    cut.environment.emplace_back("RAKS_DATA", path("data"));
    const ProcessResult result = run_process(cut);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err,
              "raks: " + weights +
                  ": is cut short at its head; install Raks again; music is not tagged\n");
    const auto document = nlohmann::json::parse(result.out);
    EXPECT_FALSE(document.contains("tagger"));
    EXPECT_FALSE(document["beats"].empty());
}

TEST_F(Commands, dance_writes_a_bvh_of_the_musics_length) {
    write_music("salsa.wav", 184.0, 8.0);
    const ProcessResult result =
        run({"dance", path("salsa.wav"), "-o", path("x.bvh"), "--fps", "60"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto clip = motion::read_bvh(folder_ / "x.bvh");
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_EQ(clip->frame_count, 480U);
}

TEST_F(Commands, dance_writes_each_of_a_couple_danced_by_positions_too) {
    write_music("salsa.wav", 184.0, 6.0);
    const ProcessResult result = run({"dance",
                                      path("salsa.wav"),
                                      "-o",
                                      path("x.bvh"),
                                      "--formation",
                                      "couple",
                                      "--figures",
                                      "positions"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto lead = motion::read_bvh(folder_ / "x_1.bvh");
    const auto follow = motion::read_bvh(folder_ / "x_2.bvh");
    ASSERT_TRUE(lead && follow);
    EXPECT_EQ(lead->frame_count, 360U);
    EXPECT_EQ(follow->frame_count, 360U);
    EXPECT_GT(glm::distance(lead->position(359, 0), follow->position(359, 0)), 0.3);
    EXPECT_FALSE(std::filesystem::exists(path("x.bvh")));
}

TEST_F(Commands, dance_is_the_same_bytes_for_a_seed) {
    write_music("salsa.wav", 184.0, 6.0);
    ASSERT_EQ(run({"dance", path("salsa.wav"), "-o", path("a.bvh")}).exit_code, 0);
    ASSERT_EQ(run({"dance", path("salsa.wav"), "-o", path("b.bvh")}).exit_code, 0);
    EXPECT_EQ(read_file(path("a.bvh")).value(), read_file(path("b.bvh")).value());
}

TEST_F(Commands, render_writes_the_same_video_twice) {
    write_music("salsa.wav", 184.0, 1.5);
    for (const char* name : {"a.avi", "b.avi", "a.mp4", "a.webm", "a.mkv"}) {
        const ProcessResult result = run({"render",
                                          path("salsa.wav"),
                                          "-o",
                                          path(name),
                                          "--size",
                                          "320x180",
                                          "--quality",
                                          "fast"});
        ASSERT_EQ(result.exit_code, 0) << name << result.err;
    }
    EXPECT_EQ(read_file(path("a.avi")).value(), read_file(path("b.avi")).value());
    for (const char* name : {"a.mp4", "a.webm", "a.mkv"}) {
        EXPECT_GT(std::filesystem::file_size(path(name)), 10'000U) << name;
    }
}

TEST_F(Commands, bench_latency_writes_its_document_with_the_tempo_that_plays) {
    const ProcessResult result = run({"bench", "latency", "--json", "--duration", "8"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto document = nlohmann::json::parse(result.out);
    EXPECT_EQ(document["format"], "raks-bench");
    EXPECT_EQ(document["bench"], "latency");
    EXPECT_NEAR(document["bpm"].get<double>(), 180.0, 4.0);
    for (const char* name : {"callback_ms", "music_age_ms", "pose_age_ms"}) {
        for (const char* share : {"p50", "p95", "p99", "max"}) {
            EXPECT_TRUE(document[name].contains(share)) << name << " " << share;
        }
    }
    EXPECT_EQ(document["dropped_states"].get<double>(), 0.0);
    // Nothing came back from anywhere: no figure is made up.
    for (const char* name : {"loop", "landing"}) {
        EXPECT_EQ(document[name].get<std::string>().rfind("not measured: ", 0), 0U);
    }
    for (const char* name : {"loop_latency_ms", "picture_lead_ms", "landing_mean_ms"}) {
        EXPECT_FALSE(document.contains(name)) << name;
    }
}

TEST_F(Commands, bench_train_writes_its_document) {
    const ProcessResult result = run({"bench", "train", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto document = nlohmann::json::parse(result.out);
    EXPECT_EQ(document["bench"], "train");
    EXPECT_GT(document["training_cpu_s"].get<double>(), 0.0);
    EXPECT_GT(document["scoring_cpu_us_a_frame"].get<double>(), 0.0);
}

TEST_F(Commands, train_report_writes_one_page_of_every_figure) {
    // Two takes of someone who sways from side to side.
    std::string labels = "take\trole\tstart\tend\tfigure\tbeats\n";
    for (const char* take : {"a", "b"}) {
        std::vector<motion::Pose> poses;
        for (int i = 0; i < 401; ++i) {
            motion::Pose pose;
            pose.hips_position = motion::mannequin_skeleton().offsets[0];
            pose.hips_position.x += 0.1F * std::sin(0.0314159F * static_cast<float>(i));
            poses.push_back(pose);
        }
        ASSERT_TRUE(motion::write_bvh(
            path(std::string(take) + ".bvh"), motion::mannequin_skeleton(), poses, 60.0));
        labels += fmt::format("{0}\tlead\t0\t200\tsway\t8\n{0}\tlead\t200\t400\tsway\t8\n", take);
    }
    ASSERT_TRUE(write_file(path("labels.tsv"), labels));
    const ProcessResult result = run({"train",
                                      "report",
                                      path("a.bvh"),
                                      path("b.bvh"),
                                      "--labels",
                                      path("labels.tsv"),
                                      "--figure",
                                      "sway",
                                      "--scale",
                                      "1",
                                      "--most-states",
                                      "4",
                                      "-o",
                                      path("report.html")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out.rfind("sway of the lead, 4 repeats: states", 0), 0U) << result.out;
    const std::string page = read_file(path("report.html")).value();
    EXPECT_NE(page.find("How long states last"), std::string::npos);
    EXPECT_EQ(page.find("nan"), std::string::npos);
}

TEST_F(Commands, play_without_window_and_sound_runs_to_the_files_end) {
    write_music("salsa.wav", 184.0, 3.0);
    const ProcessResult result = run({"play", path("salsa.wav"), "--headless", "--no-sound"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(Commands, play_stopped_by_a_signal_ends_with_its_code) {
    write_music("salsa.wav", 184.0, 20.0);
    for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
        CapturedProcess child(plan({"play", path("salsa.wav"), "--headless", "--no-sound"}));
        ASSERT_TRUE(child.wait_for_output("salsa.wav"));
        child.send(signal);
        const ProcessResult result = child.wait();
        EXPECT_FALSE(result.timed_out);
        EXPECT_EQ(result.exit_code, code) << result.err;
    }
}

}  // namespace
}  // namespace raks::test
