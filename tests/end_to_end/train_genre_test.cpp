// raks train genre on folders of music as users have them: a few files, damaged ones, shares.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "audio/io/wav_writer.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;
using audio::Style;

class TrainGenre : public ProgramTest {
 protected:
    void write(const std::string& name, const std::string& bytes) const {
        fs::create_directories(fs::path(path(name)).parent_path());
        ASSERT_TRUE(write_file(path(name), bytes));
    }
    void write_music(const std::string& name,
                     Style style,
                     std::uint64_t seed,
                     double seconds = 8.0) const {
        audio::MusicPlan plan;
        plan.style = style;
        plan.tempo = {{0.0, style == Style::montuno ? 180.0 : 118.0}};
        plan.seconds = seconds;
        plan.seed = seed;
        plan.channels = 1;
        plan.rate = SampleRate(32'000);
        fs::create_directories(fs::path(path(name)).parent_path());
        ProgramTest::write_music(name, plan);
    }
    void write_silence(const std::string& name, std::size_t samples) const {
        fs::create_directories(fs::path(path(name)).parent_path());
        ASSERT_TRUE(
            audio::write_wav(path(name), std::vector<float>(samples), 1, SampleRate(16'000)));
    }
    /// Three dances, two files each.
    void write_folder(const std::string& name) const {
        for (const std::uint64_t seed : {1U, 2U}) {
            const std::string file = std::to_string(seed) + ".wav";
            write_music(fs::path(name) / "salsa" / file, Style::montuno, seed);
            write_music(fs::path(name) / "belly" / file, Style::maqsum, seed);
            write_music(fs::path(name) / "house" / file, Style::four_on_the_floor, seed);
        }
    }
    /// As small a model as learns at all.
    [[nodiscard]] ProcessResult train(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"train", "genre"});
        for (const char* const word : {"--states=1",
                                       "--mixtures=1",
                                       "--steps=20",
                                       "--network-units=8",
                                       "--network-steps=1",
                                       "--tuning-steps=1",
                                       "--similarity=0",
                                       "--altered=1"}) {
            arguments.emplace_back(word);
        }
        return run(arguments);
    }
    /// The model's text without the command that made it.
    [[nodiscard]] std::string model(const std::string& name) const {
        const auto text = read_file(path(name));
        return text ? std::regex_replace(*text, std::regex("\"made_with\":[^\n]*"), "") : "missing";
    }
    void expect_failure(const ProcessResult& result, const std::string& last_line) const {
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_TRUE(result.err.ends_with("raks: " + last_line + "\n")) << result.err;
        EXPECT_EQ(result.out, "");
    }
};

TEST_F(TrainGenre, shares_that_are_merged_give_the_model_of_one_machine) {
    write_folder("music");
    const std::string music = path("music");
    const ProcessResult whole = train({music, "--no-validation", "-o", path("whole.json")});
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    for (const std::string share : {"1", "2"}) {
        const ProcessResult part =
            train({music, "--shard", share + "/2", "-o", path(share + ".shard")});
        ASSERT_EQ(part.exit_code, 0) << part.err;
    }
    const std::string first = path("1.shard");
    const std::string second = path("2.shard");
    const ProcessResult merged =
        train({"merge", second, first, "--no-validation", "-o", path("merged.json")});
    ASSERT_EQ(merged.exit_code, 0) << merged.err;
    EXPECT_NE(model("whole.json"), "missing");
    EXPECT_EQ(model("merged.json"), model("whole.json"));
    expect_failure(train({"merge", first, "-o", path("x.json")}),
                   "of 2 shards these are missing: 2; name all of them");
    expect_failure(train({music, "--shard", "3/2", "-o", path("x")}),
                   "--shard is '3/2', must be i/n: share 1 to n, n up to 1000");
    expect_failure(train({"merge", path("whole.json"), "-o", path("x.json")}),
                   path("whole.json") + ": was not made by raks train genre --shard");
}

TEST_F(TrainGenre, a_stopped_run_goes_on_from_its_cache) {
    write_folder("music");
    const auto run_once = [&](const std::string& name) {
        return train({path("music"), "--no-validation", "--cache", path("kept"), "-o", path(name)});
    };
    const ProcessResult first = run_once("first.json");
    ASSERT_EQ(first.exit_code, 0) << first.err;
    EXPECT_NE(first.err.find("min of recordings analyzed"), std::string::npos) << first.err;
    const ProcessResult second = run_once("second.json");
    ASSERT_EQ(second.exit_code, 0) << second.err;
    EXPECT_EQ(second.err.find("min of recordings analyzed"), std::string::npos) << second.err;
    EXPECT_EQ(model("second.json"), model("first.json"));
}

TEST_F(TrainGenre, a_damaged_file_is_named_skipped_and_counted_or_fails_when_strict) {
    write_folder("music");
    write("music/rock/damaged.mp3", "no music\n");
    write_silence("music/house/silent.wav", 48'000);
    const ProcessResult result =
        train({path("music"), "--no-validation", "-o", path("model.json")});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("raks: skipped " + path("music/rock/damaged.mp3") + ": "),
              std::string::npos)
        << result.err;
    EXPECT_NE(result.err.find("raks: skipped " + path("music/house/silent.wav") +
                              ": is silent or shorter than 1 s\n"),
              std::string::npos)
        << result.err;
    EXPECT_NE(result.err.find("raks: 2 of 8 files skipped\n"), std::string::npos) << result.err;
    EXPECT_TRUE(fs::exists(path("model.json")));
    expect_failure(train({path("music"), "--strict", "-o", path("strict.json")}),
                   "2 of 8 files cannot be used (--strict): " + path("music/house/silent.wav") +
                       ": is silent or shorter than 1 s");
    EXPECT_FALSE(fs::exists(path("strict.json")));
}

TEST_F(TrainGenre, what_damage_costs_is_told_by_artist) {
    write_folder("music");
    const ProcessResult result = train({path("music"), "--damage", "--folds=2"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    for (const char* const title : {"recordings, by artist\n",
                                    "recordings, by artist, -12 dB\n",
                                    "recordings, by artist, noise 10 dB\n",
                                    "recordings, by artist, room 0.6 s\n"}) {
        EXPECT_NE(result.out.find(title), std::string::npos) << title;
    }
    expect_failure(train({path("music"), "--damage", "--no-validation"}),
                   "--damage needs a folder of recordings and the validation: it is a part of it");
}

TEST_F(TrainGenre, folders_that_hold_too_little_are_told_what_they_lack) {
    write_music("one/salsa/a.wav", Style::montuno, 1);
    expect_failure(train({path("one"), "-o", path("x.json")}),
                   "salsa: all its music is one file or by one artist, so that none can be held "
                   "out; add music, or use --no-validation");
    write_silence("silent/salsa/a.wav", 40'000);
    write_silence("silent/rock/a.wav", 50'000);
    expect_failure(train({path("silent"), "-o", path("x.json")}),
                   "none of the 2 files can be learnt from");
    write_music("twins/salsa/a.wav", Style::montuno, 1, 2.0);
    write_music("twins/rock/b.wav", Style::montuno, 1, 2.0);
    expect_failure(train({path("twins"), "-o", path("x.json")}),
                   path("twins/rock/b.wav") + " and " + path("twins/salsa/a.wav") +
                       " are the same file under two genres; remove one");
    write_music("short/salsa/a.wav", Style::montuno, 1, 2.0);
    const ProcessResult few = run({"train", "genre", path("short"), "--no-validation"});
    EXPECT_EQ(few.exit_code, 1);
    EXPECT_TRUE(std::regex_search(
        few.err,
        std::regex("\nraks: salsa: [0-9]+ frames of sound, fewer than the 1248 parameters "
                   "of its model; add music or lower --states and --mixtures\n")))
        << few.err;
    expect_failure(train({path("one"), "-o", path("nowhere/x.json")}),
                   path("nowhere/x.json") + ": cannot be written: No such file or directory");
}

TEST_F(TrainGenre, a_genre_is_added_without_the_music_of_the_others) {
    write_folder("music");
    fs::create_directories(path("more"));
    fs::rename(path("music/belly"), path("more/belly"));
    const ProcessResult first = train({path("music"), "--no-validation", "-o", path("two.json")});
    ASSERT_EQ(first.exit_code, 0) << first.err;
    EXPECT_LT(fs::file_size(path("two.samples")), 2U * 2'000'000U + 200'000U);
    fs::remove_all(path("music"));
    const std::string two = path("two.json");
    const ProcessResult second = train({path("more"), "--add-to", two, "-o", path("three.json")});
    ASSERT_EQ(second.exit_code, 0) << second.err;
    const std::string text = model("three.json");
    EXPECT_TRUE(std::regex_search(text,
                                  std::regex("\"genres\": *\\[\\s*\"salsa\",\\s*\"belly\",\\s*"
                                             "\"house\"\\s*\\]")))
        << text.substr(0, 900);
    EXPECT_TRUE(fs::exists(path("three.samples"))) << "a fourth can be added";

    expect_failure(
        train({path("more"), "--add-to", two}),
        "--shard, --add, --add-to and --tagger-for need -o FILE: where to keep what they make");
    fs::copy(path("three.samples"), path("two.samples"), fs::copy_options::overwrite_existing);
    expect_failure(train({path("more"), "--add-to", two, "-o", path("x.json")}),
                   path("two.samples") + ": is of another model than two.json; train it again");
    fs::remove(path("two.samples"));
    expect_failure(train({path("more"), "--add-to", two, "-o", path("x.json")}),
                   path("two.samples") +
                       ": is not there: what two.json was learnt from was not kept; train it again "
                       "with all its music");
    auto bytes = read_file(path("three.samples"));
    ASSERT_TRUE(bytes);
    bytes->at(30) = bytes->at(30) == '0' ? '1' : '0';  // in the name of the hearing
    write("three.samples", *bytes);
    expect_failure(train({path("more"), "--add-to", path("three.json"), "-o", path("x.json")}),
                   path("three.samples") +
                       ": was made with other features or another beat network than this program "
                       "has; train the model again");
}

TEST_F(TrainGenre, songs_whose_dance_was_kept_adapt_the_model_that_comes_with_raks) {
    const std::vector<std::string> add = {"train", "genre", "--add", "-o", path("mine.json")};
    expect_failure(run(add),
                   "no dance of a song was kept yet: play it, choose its dance (D) and press U");
    write_music("album/1.wav", Style::four_on_the_floor, 1, 20.0);
    write_music("album/2.wav", Style::four_on_the_floor, 2, 20.0);
    const std::string folder = path("album");
    const auto row = [&](const std::string& dance, const std::string& song) {
        return dance + "\tCelia\t" + folder + "\t" + folder + "/" + song + "\n";
    };
    const std::string head = "dance\tartist\tfolder\tsong\n";
    write("state/raks/dances.tsv", head + row("rock", "1.wav") + row("rock", "2.wav"));
    const ProcessResult all = run(add);
    EXPECT_EQ(all.exit_code, 0) << all.err;
    EXPECT_NE(all.err.find("raks: what the music tagger says of the dances is adapted to 2 kept "
                           "songs (artists: 1), nothing else is learnt: 0 of them recognised "
                           "before, "),
              std::string::npos)
        << all.err;
    // The new model is one that programs read.
    const ProcessResult judged =
        run({"eval", "genre", path("album"), "--model", path("mine.json")});
    EXPECT_NE(judged.err.find("holds no folder of music"), std::string::npos) << judged.err;
    // Those that are gone are named and counted.
    write("state/raks/dances.tsv",
          head + row("rock", "1.wav") + row("rock", "gone.wav") + row("polka", "2.wav"));
    const ProcessResult some = run(add);
    EXPECT_EQ(some.exit_code, 3) << some.err;
    EXPECT_NE(some.err.find("raks: skipped " + folder + "/gone.wav: is not there any more\n"),
              std::string::npos)
        << some.err;
    EXPECT_NE(some.err.find("raks: skipped " + folder + "/2.wav: dance \"polka\" is unknown\n"),
              std::string::npos)
        << some.err;
    EXPECT_TRUE(some.err.ends_with("raks: 2 kept songs skipped\n")) << some.err;
    write("state/raks/dances.tsv", head + "rock\n");
    expect_failure(run(add),
                   path("state/raks/dances.tsv") + ": line 2: 1 columns, there must be 4");
    expect_failure(
        run({"train", "genre", "--add"}),
        "--shard, --add, --add-to and --tagger-for need -o FILE: where to keep what they "
        "make");
}

TEST_F(TrainGenre, songs_whose_dance_was_kept_are_recordings_beside_a_folders) {
    write_folder("music");
    write_music("album/1.wav", Style::four_on_the_floor, 3);
    write("state/raks/dances.tsv",
          "dance\tartist\tfolder\tsong\nrock\tCelia\t" + path("album") + "\t" +
              path("album/1.wav") + "\n");
    const ProcessResult result =
        train({path("music"), "--add", "--no-validation", "-o", path("model.json")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(model("model.json").find("\"rock\""), std::string::npos);
}

TEST_F(TrainGenre, wrong_usage_says_so) {
    for (const char* const word : {"--polka", "--without=drums", "--altered=-1"}) {
        const ProcessResult result = run({"train", "genre", path("music"), word});
        EXPECT_EQ(result.exit_code, 2) << word;
        EXPECT_NE(result.err, "") << word;
    }
}

TEST_F(TrainGenre, a_model_of_other_features_is_refused) {
    write_music("a.wav", Style::montuno, 1, 2.0);
    fs::create_directories(path("music/salsa"));
    fs::rename(path("a.wav"), path("music/salsa/a.wav"));
    const ProcessResult made = train({path("music"), "--no-validation", "-o", path("model.json")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const auto text = read_file(path("model.json"));
    ASSERT_TRUE(text);
    write("other.json", std::regex_replace(*text, std::regex("htk-39"), "htk-26"));
    const ProcessResult result =
        run({"eval", "genre", path("music"), "--model", path("other.json")});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("features.mfcc is 'htk-26', this program hears 'htk-39': train the "
                              "model again"),
              std::string::npos)
        << result.err;
}

}  // namespace
}  // namespace raks::test
