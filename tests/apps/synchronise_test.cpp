// Films whose clocks are known, from their files to the clocks, the table and the JSON.
#include "apps/raks_capture/synchronise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/sync_report.hpp"
#include "audio/io/wav_writer.hpp"
#include "audio/music/damage/room_recorder.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::apps {
namespace {

constexpr int kSampleRate = 48'000;
constexpr double kSeconds = 25.0;

// A folder with the sounds of cameras, and the song beside it.
class Synchronise : public ::testing::Test {
 protected:
    Synchronise() {
        audio::MusicPlan plan;
        plan.seconds = 45.0;
        plan.channels = 1;
        music_ = audio::generate(plan)->samples;
        std::filesystem::create_directory(films());
    }

    [[nodiscard]] std::filesystem::path films() const { return folder_ / "take"; }
    [[nodiscard]] std::filesystem::path song() const { return folder_ / "song.wav"; }
    void write_song() const { write(song(), music_); }

    static void write(const std::filesystem::path& file, const std::vector<float>& samples) {
        ASSERT_TRUE(audio::write_wav(file, samples, 1, SampleRate(kSampleRate)));
    }
    // What a camera heard of the song from `offset` seconds on.
    void film(const std::string& name, double offset, double drift_ppm, double metres = 0.0) const {
        audio::RoomRecorder recorder;
        recorder.seconds = kSeconds;
        recorder.offset = offset;
        recorder.drift_ppm = drift_ppm;
        recorder.metres = metres;
        recorder.reverberation = 0.3;
        recorder.direct_to_reverberant_db = 3.0;
        recorder.signal_to_noise_db = 20.0;
        Dice dice(7, static_cast<std::uint64_t>(name.front()));
        auto samples = audio::record_in_room(kSampleRate, music_, recorder, dice);
        for (float& sample : samples) {
            sample *= 0.3F;
        }
        write(films() / (name + ".wav"), samples);
    }
    // Turns a camera's sound into a film by the ffmpeg program.
    void make_film(const std::string& name) const {
        const std::string sound = (films() / (name + ".wav")).string();
        const std::string command =
            "ffmpeg -nostdin -loglevel error -y -f lavfi -i color=size=64x48:rate=5 -i '" + sound +
            "' -shortest -c:v mpeg4 -c:a aac '" + (films() / (name + ".mp4")).string() + "'";
        ASSERT_EQ(std::system(command.c_str()), 0) << command;  // NOLINT(concurrency-mt-unsafe)
        std::filesystem::remove(sound);
    }
    // Writes capture.toml with these cameras: names and films; `metres`: of each to the
    // loudspeaker.
    void plan(const std::vector<std::string>& films,
              const std::vector<double>& metres = {},
              std::optional<double> start = {}) const {
        CapturePlan plan;
        plan.start = start;
        for (std::size_t i = 0; i < films.size(); ++i) {
            PlannedCamera camera;
            camera.name = std::filesystem::path(films[i]).stem().string();
            camera.film = films[i];
            camera.loudspeaker = i < metres.size() ? metres[i] : 0.0;
            plan.cameras.push_back(camera);
        }
        ASSERT_TRUE(write_file(this->films() / "capture.toml", capture_plan_text(plan)));
    }
    // The exit code of the command, 1 for an error.
    static int run(const SyncArguments& arguments) {
        const ExitCode code = sync_capture(arguments);
        return code ? *code : kExitFailed;
    }
    [[nodiscard]] std::vector<capture::Clock> written_clocks() const {
        const std::string file = (films() / "clocks.toml").string();
        const auto text = read_file(file);
        const auto clocks = text ? capture::read_clocks(*text, file) : fail(text.error());
        EXPECT_TRUE(clocks) << clocks.error().message;
        return clocks.value_or(std::vector<capture::Clock>{});
    }

    raks::test::TemporaryFolder folder_;
    std::vector<float> music_;
};

TEST_F(Synchronise, films_and_a_song_give_clocks_and_the_offset_to_train_with) {
    film("back", 12.0, 0.0);
    film("left", 10.5, 40.0);
    film("right", 13.25, -30.0);
    make_film("left");
    write_song();
    plan({"back.wav", "left.mp4", "right.wav"}, {}, 2.5);
    ASSERT_EQ(run({.folder = films().string(), .music = song().string()}), kExitDone);
    const auto clocks = written_clocks();
    ASSERT_EQ(clocks.size(), 3U);
    EXPECT_EQ(clocks[0].camera, "back");
    EXPECT_EQ(clocks[0].offset, 0.0);
    EXPECT_EQ(clocks[1].camera, "left");
    EXPECT_NEAR(clocks[1].offset, -1.5, 5e-4);
    EXPECT_NEAR(clocks[1].drift_ppm, 40.0, 5.0);
    EXPECT_NEAR(clocks[2].offset, 1.25, 5e-4);
    EXPECT_NEAR(clocks[2].drift_ppm, -30.0, 5.0);
    for (const capture::Clock& clock : clocks) {
        EXPECT_GE(clock.confidence, kDoubtfulConfidence);
    }
    const auto music = read_file(films() / "music.toml");
    ASSERT_TRUE(music);
    EXPECT_NE(music->find("begins = -12.000"), std::string::npos) << *music;
    EXPECT_NE(music->find("\noffset = 12.000"), std::string::npos) << *music;
}

TEST_F(Synchronise, table_and_json_say_the_same) {
    film("back", 12.0, 0.0);
    film("left", 10.5, 40.0);
    write_song();
    SyncPlan plan;
    plan.cameras = {{"back", films() / "back.wav"}, {"left", films() / "left.wav"}};
    plan.music = song();
    double last = -1.0;
    const auto result = synchronise(plan, [&](double share) {
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1.0);
        last = share;
        return true;
    });
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->is_whole);
    EXPECT_EQ(last, 1.0);
    const std::string table = sync_table(*result, plan);
    EXPECT_NE(table.find("back       0.0000       0.0"), std::string::npos) << table;
    EXPECT_NE(table.find("the capture's clock"), std::string::npos) << table;
    EXPECT_NE(table.find(song().string() + " begins at "), std::string::npos) << table;
    EXPECT_NE(table.find("--offset 12.000"), std::string::npos) << table;
    const auto document = nlohmann::json::parse(sync_json(*result, plan));
    EXPECT_EQ(document["format"], "raks-sync");
    EXPECT_EQ(document["cameras"][0]["through"], nullptr);
    EXPECT_NEAR(document["cameras"][1]["offset"].get<double>(), -1.5, 5e-4);
    EXPECT_NEAR(document["music"]["offset"].get<double>(), 12.0, 5e-4);
    EXPECT_TRUE(document["warnings"].empty()) << document["warnings"];
}

TEST_F(Synchronise, cameras_that_hear_nothing_are_named_and_the_others_go_on) {
    film("a", 0.0, 0.0);
    film("b", 1.0, 0.0);
    write(films() / "silent.wav", std::vector<float>(kSampleRate * 10));
    write(films() / "short.wav", std::vector<float>(music_.begin(), music_.begin() + kSampleRate));
    ASSERT_TRUE(write_file(films() / "broken.mp4", "no film"));
    std::vector<float> slow;  // twice as slow as it was
    for (std::size_t i = 0; i < static_cast<std::size_t>(kSeconds * kSampleRate); ++i) {
        slow.insert(slow.end(), {music_[i], music_[i]});
    }
    write(films() / "slow.wav", slow);
    plan({"a.wav", "b.wav", "broken.mp4", "short.wav", "silent.wav"});
    EXPECT_EQ(run({.folder = films().string()}), kExitPartly);
    ASSERT_EQ(written_clocks().size(), 2U);

    SyncPlan plan;
    for (const char* const name :
         {"a.wav", "b.wav", "broken.mp4", "short.wav", "silent.wav", "slow.wav"}) {
        plan.cameras.push_back({name, films() / name});
    }
    const auto result = synchronise(plan);
    ASSERT_TRUE(result);
    EXPECT_FALSE(result->is_whole);
    ASSERT_EQ(result->warnings.size(), 4U);
    EXPECT_NE(result->warnings[0].find("broken.mp4"), std::string::npos);
    EXPECT_NE(result->warnings[1].find("short.wav: 1.0 s of sound are too short"),
              std::string::npos);
    EXPECT_NE(result->warnings[2].find("silent.wav: its sound is silent"), std::string::npos);
    EXPECT_NE(result->warnings[3].find("slow.wav"), std::string::npos);
    EXPECT_NE(result->warnings[3].find("2.0 times as long as the others: is it in slow motion?"),
              std::string::npos)
        << result->warnings[3];
}

TEST_F(Synchronise, music_that_no_camera_heard_is_said) {
    film("a", 0.0, 0.0);
    film("b", 1.0, 0.0);
    audio::MusicPlan other;
    other.style = audio::Style::four_on_the_floor;
    other.seconds = 30.0;
    other.channels = 1;
    write(song(), audio::generate(other)->samples);
    plan({"a.wav", "b.wav"});
    EXPECT_EQ(run({.folder = films().string(), .music = song().string()}), kExitPartly);
    EXPECT_EQ(written_clocks().size(), 2U);
    EXPECT_FALSE(std::filesystem::exists(films() / "music.toml"));
}

TEST_F(Synchronise, clocks_set_by_hand_count_before_the_sound) {
    film("a", 5.0, 0.0);
    film("b", 6.0, 0.0);
    write(films() / "mute.wav", std::vector<float>(kSampleRate * 10));
    plan({"a.wav", "b.wav", "mute.wav"});
    const auto hand = folder_ / "hand.toml";
    const std::vector<capture::Clock> set{{"a", 100.0, 0.0, 1.0}, {"mute", 101.5, 10.0, 1.0}};
    ASSERT_TRUE(write_file(hand, capture::clocks_text(set)));
    ASSERT_EQ(run({.folder = films().string(), .offsets = hand.string()}), kExitDone);
    const auto clocks = written_clocks();
    ASSERT_EQ(clocks.size(), 3U);
    EXPECT_EQ(clocks[0], set[0]);
    EXPECT_NEAR(clocks[1].offset, 101.0, 5e-4);
    EXPECT_EQ(clocks[2], set[1]);
    // A clock for nobody is a slip of the pen.
    ASSERT_TRUE(write_file(hand, capture::clocks_text({{"c", 1.0, 0.0, 1.0}})));
    EXPECT_EQ(run({.folder = films().string(), .offsets = hand.string()}), kExitFailed);
}

TEST_F(Synchronise, the_way_of_the_sound_is_taken_off_where_the_loudspeaker_is_known) {
    film("a", 5.0, 0.0, 2.0);
    film("b", 6.0, 0.0, 9.0);
    plan({"a.wav", "b.wav"}, {2.0, 9.0});
    ASSERT_EQ(run({.folder = films().string()}), kExitDone);
    EXPECT_NEAR(written_clocks()[1].offset, 1.0, 5e-4);
    plan({"a.wav", "b.wav"});
    ASSERT_EQ(run({.folder = films().string()}), kExitDone);
    EXPECT_NEAR(written_clocks()[1].offset, 1.0 - 7.0 / 343.0, 5e-4);
}

TEST_F(Synchronise, folders_without_a_capture_or_without_sound_are_refused) {
    EXPECT_EQ(run({.folder = films().string()}), kExitFailed);
    EXPECT_EQ(run({.folder = (folder_ / "nowhere").string()}), kExitFailed);
    plan({"a.wav", "b.wav"});
    EXPECT_EQ(run({.folder = films().string()}), kExitFailed);
    EXPECT_FALSE(std::filesystem::exists(films() / "clocks.toml"));
}

}  // namespace
}  // namespace raks::apps
