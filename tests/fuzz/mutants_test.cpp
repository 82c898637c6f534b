// Damaged files through the program itself, over all readers: whatever lies in a file, the program
// ends soon, says one line, and leaves nothing behind. By itself the test tries one file for each
// reader. RAKS_MUTANTS=20000 tries 20,000; RAKS_MUTANTS_SEED is the seed of the first, and each
// further one has the next seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program.hpp"
#include "tests/fuzz/mutation.hpp"
#include "tests/support/extent.hpp"
#include "tests/support/mangled.hpp"

#include <fmt/format.h>

namespace raks::test {
namespace {

namespace fs = std::filesystem;

// What the program may take for any file.
constexpr double kMostCpuSeconds = 5.0;
constexpr long kMostKilobytes = 500'000;

/// One way of a file into the program.
struct Door {
    std::string name;
    std::string file;                 ///< where the damaged file lies, in the test's folder
    std::string bytes;                ///< the good file
    std::vector<std::string> words;   ///< of the command
    bool is_text = true;              ///< damaged by structure, else byte by byte
    std::vector<std::string> writes;  ///< what a good run leaves
};

/// What went wrong, how often.
using Faults = std::map<std::string, int>;

class Mutants : public ProgramTest {
 protected:
    void SetUp() override;
    [[nodiscard]] std::string source(const std::string& name) const {
        return read_file(fs::path(RAKS_SOURCE_DIR) / name).value();
    }
    void add_sounds();
    void add_motion();
    void add_settings();
    void add_models();
    void try_one(const Door& door, std::uint64_t seed);
    void note(const Door& door, std::uint64_t seed, const std::string& what);

    std::vector<Door> doors_;
    std::set<std::string> usual_;  ///< files that lie there before
    Faults faults_;
    double most_cpu_ = 0.0;
    long most_kilobytes_ = 0;
};

void Mutants::SetUp() {
    audio::MusicPlan plan;
    plan.style = audio::Style::drums;
    plan.seconds = 2.0;
    write_music("song.wav", plan);
    add_sounds();
    add_motion();
    add_settings();
    add_models();
    for (const std::string& name : files()) {
        usual_.insert(name);
    }
}

void Mutants::add_sounds() {
    for (const std::string ending : {"wav", "flac", "ogg", "opus", "mp3", "m4a", "mkv", "aiff"}) {
        const std::string file = path("good." + ending);
        const std::vector<std::string> encode = {
            "ffmpeg", "-v", "error", "-y", "-i", path("song.wav"), file};
        ProcessPlan plan;
        plan.command = encode;
        ASSERT_EQ(run_process(plan).exit_code, 0) << ending;
        const std::string bytes = read_file(file).value();
        fs::remove(file);
        const std::string name = "m." + ending;
        doors_.push_back({ending, name, bytes, {"analyze", path(name)}, false, {}});
        doors_.push_back({ending + " sought",
                          name,
                          bytes,
                          {"play",
                           path(name),
                           "--headless",
                           "--no-sound",
                           "--as-live",
                           "--start",
                           "1.2",
                           "--duration",
                           "0.1",
                           "-q"},
                          false,
                          {}});
    }
}

void Mutants::add_models() {
    // Text is damaged by structure, containers byte by byte.
    doors_.push_back({"glTF",
                      "m.gltf",
                      source("tests/data/avatars/SimpleSkin.gltf"),
                      {"avatar", "show", path("m.gltf")},
                      true,
                      {}});
    for (const std::string name : {"smoke_spring.vrm", "six_poses.vrma", "RiggedFigure.glb"}) {
        const std::string file = "m" + fs::path(name).extension().string();
        doors_.push_back({name,
                          file,
                          source("tests/data/avatars/" + name),
                          {"avatar", "show", path(file)},
                          false,
                          {}});
    }
}

void Mutants::add_motion() {
    const std::string waltz = source("config/choreographies/waltz.toml");
    doors_.push_back({"choreography",
                      "m.toml",
                      waltz,
                      {"train", "figure", path("m.toml"), "-o", path("out/")},
                      true,
                      {"out"}});
    ASSERT_EQ(run({"dance", path("song.wav"), "-o", path("good.bvh"), "--fps", "30"}).exit_code, 0);
    const std::string clip = read_file(path("good.bvh")).value();
    doors_.push_back({"clip",
                      "m.bvh",
                      clip,
                      {"stick", path("m.bvh"), "--frame", "5", "-o", path("x.png")},
                      true,
                      {"x.png"}});
    ASSERT_TRUE(write_file(path("labels.tsv"), source("tests/fuzz/corpus/labels/good.tsv")));
    doors_.push_back(
        {"labels",
         "m.tsv",
         source("tests/fuzz/corpus/labels/good.tsv"),
         {"train", "figure", path("good.bvh"), "--labels", path("m.tsv"), "-o", path("out/")},
         true,
         {"out"}});
    // A dance of files: each of them in turn.
    // Under a name that no shipped dance has: the program says when a dance hides a shipped one.
    const std::string head = "dance = \"waltz\"";
    std::string mine = waltz;
    ASSERT_NE(mine.find(head), std::string::npos);
    mine.replace(mine.find(head), head.size(), "dance = \"mine\"");
    ASSERT_TRUE(write_file(path("mine.toml"), mine));
    ASSERT_EQ(run({"train", "figure", path("mine.toml"), "-o", path("mine/")}).exit_code, 0);
    for (const auto& entry : fs::directory_iterator(path("mine"))) {
        const std::string name = "mine/" + entry.path().filename().string();
        doors_.push_back({name,
                          name,
                          read_file(entry.path()).value(),
                          {"dance", path("song.wav"), "--dance", path("mine"), "-o", path("x.bvh")},
                          true,
                          {"x.bvh"}});
    }
}

void Mutants::add_settings() {
    doors_.push_back({"settings",
                      "config/raks/config.toml",
                      source("config/default.toml"),
                      {"config", "show"},
                      true,
                      {}});
    doors_.push_back({"devices",
                      "state/raks/devices.toml",
                      source("tests/fuzz/corpus/devices/good.toml"),
                      {"devices"},
                      true,
                      {}});
    const std::string list = "#EXTM3U\n#EXTINF:2,a\nsong.wav\n";
    doors_.push_back({"m3u", "m.m3u", list, {"analyze", path("m.m3u")}, true, {}});
    doors_.push_back({"pls",
                      "m.pls",
                      "[playlist]\nFile1=song.wav\nTitle1=a\nNumberOfEntries=1\nVersion=2\n",
                      {"analyze", path("m.pls")},
                      true,
                      {}});
    doors_.push_back({"xspf",
                      "m.xspf",
                      "<?xml version=\"1.0\"?>\n<playlist version=\"1\"><trackList><track>"
                      "<location>song.wav</location></track></trackList></playlist>\n",
                      {"analyze", path("m.xspf")},
                      true,
                      {}});
    doors_.push_back(
        {"beats",
         "m.beats",
         "0.5 1\n1.0 2\n1.5 3\n",
         {"analyze", path("song.wav"), "--plot", path("x.svg"), "--reference", path("m.beats")},
         true,
         {"x.svg"}});
}

void Mutants::note(const Door& door, std::uint64_t seed, const std::string& what) {
    ++faults_[what];
    // Kept to be looked at, under its own name.
    const char* const kept = std::getenv("RAKS_MUTANTS_KEPT");  // NOLINT(concurrency-mt-unsafe)
    const std::string name = fmt::format("{}-{}", seed, fs::path(door.file).filename().string());
    std::cout << door.name << " " << name << ": " << what << std::endl;
    std::error_code ignored;
    if (kept != nullptr) {
        fs::copy(path(door.file), fs::path(kept) / name, ignored);
    }
}

void Mutants::try_one(const Door& door, std::uint64_t seed) {
    const std::string changed =
        door.is_text ? fuzz::mutated(door.bytes, seed)
                     : mangled(door.bytes, {seed, 1 + seed % 40, seed % 3 == 0 ? 400U : ~0U});
    fs::create_directories(fs::path(path(door.file)).parent_path());
    ASSERT_TRUE(write_file(path(door.file), changed));
    ProcessPlan planned = plan(door.words);
    planned.timeout = std::chrono::seconds(60);
    const ProcessResult result = run_process(planned);
    most_cpu_ = std::max(most_cpu_, result.cpu_seconds);
    most_kilobytes_ = std::max(most_kilobytes_, result.most_kilobytes);
    if (result.timed_out || result.exit_code > 3) {
        note(door, seed, fmt::format("ended with {}", result.timed_out ? -1 : result.exit_code));
    }
    if (result.cpu_seconds > kMostCpuSeconds) {
        note(door, seed, fmt::format("took over {} s of CPU", kMostCpuSeconds));
    }
    if (result.most_kilobytes > kMostKilobytes) {
        note(door, seed, "took over 500 MB");
    }
    const auto lines = std::count(result.err.begin(), result.err.end(), '\n');
    // With exit code 3 the program says one line for each file that it left out.
    if (result.exit_code != 0 && result.exit_code != 3 && lines != 1) {
        note(door, seed, fmt::format("said {} lines: {}", lines, result.err.substr(0, 300)));
    }
    for (const std::string& name : door.writes) {
        fs::remove_all(path(name));
    }
    if (door.file.find('/') == std::string::npos) {
        fs::remove(path(door.file));
    } else {
        ASSERT_TRUE(write_file(path(door.file), door.bytes));
    }
    for (const std::string& name : files()) {
        if (!usual_.contains(name) && name != "config" && name != "state") {
            note(door, seed, "left " + name);
            fs::remove_all(path(name));
        }
    }
}

TEST_F(Mutants, end_the_program_soon_with_one_line) {
    const std::int64_t count =
        number_from("RAKS_MUTANTS").value_or(static_cast<std::int64_t>(doors_.size()));
    const auto first = static_cast<std::uint64_t>(number_from("RAKS_MUTANTS_SEED").value_or(1));
    for (std::int64_t i = 0; i < count; ++i) {
        const Door& door = doors_[static_cast<std::size_t>(i) % doors_.size()];
        ASSERT_NO_FATAL_FAILURE(try_one(door, first + static_cast<std::uint64_t>(i)));
    }
    std::cout << fmt::format(
        "{} files, at most {:.2f} s of CPU and {} MB\n", count, most_cpu_, most_kilobytes_ / 1000);
    for (const auto& [what, times] : faults_) {
        ADD_FAILURE() << times << " x " << what;
    }
}

}  // namespace
}  // namespace raks::test
