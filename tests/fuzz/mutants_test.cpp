// Damaged files through the program itself, over all readers: whatever lies in a file, the program
// ends soon, says one line, and leaves nothing behind. By itself the test tries one file for each
// reader. RAKS_MUTANTS=20000 tries 20,000, RAKS_MODEL_MUTANTS=2000 that many of models and their
// motion, RAKS_MUTANTS_OF=FBX those of one door alone; RAKS_MUTANTS_SEED is the seed of the first,
// and each further one has the next seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/random.hpp"
#include "tests/end_to_end/program_fixture.hpp"
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
constexpr long kMostKilobytesOfModels = 1'000'000;  // unpacked pictures among them

/// How a file is damaged: a text by its structure, all else byte by byte; of a GLB the text in it,
/// every other time.
enum class Form { text, bytes, glb };

/// One way of a file into the program.
struct Door {
    std::string name;
    std::string file;                 ///< where the damaged file lies, in the test's folder
    std::string bytes;                ///< the good file
    std::vector<std::string> words;   ///< of the command
    Form form = Form::text;           ///< what the file is
    std::vector<std::string> writes;  ///< what a good run leaves
};

/// What went wrong, how often.
using Faults = std::map<std::string, int>;

class Mutants : public ProgramTest {
 protected:
    [[nodiscard]] std::string source(const std::string& name) const {
        return read_file(fs::path(RAKS_SOURCE_DIR) / name).value();
    }
    void add_sounds();
    void add_motion();
    void add_settings();
    void add_models();
    void choose_doors();
    void try_all(const char* count_name);
    void try_one(const Door& door, std::uint64_t seed);
    void note(const Door& door, std::uint64_t seed, const std::string& what);

    std::vector<Door> doors_;
    std::set<std::string> usual_;  ///< files that lie there before
    Faults faults_;
    long most_allowed_ = kMostKilobytes;
    double most_cpu_ = 0.0;
    long most_kilobytes_ = 0;
};

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
        doors_.push_back({ending, name, bytes, {"analyze", path(name)}, Form::bytes, {}});
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
                          Form::bytes,
                          {}});
    }
}

/// Models: what is in them, how they are posed, and motion put on one that is whole.
void Mutants::add_models() {
    const std::string folder = "tests/data/avatars/";
    const std::string table = path("x.tsv");
    doors_.push_back({"glTF",
                      "m.gltf",
                      source(folder + "SimpleSkin.gltf"),
                      {"avatar", "show", path("m.gltf")},
                      Form::text,
                      {}});
    for (const std::string name :
         {"smoke_spring.vrm", "six_poses.vrma", "RiggedFigure.glb", "Godette_vrm_v4.vrm"}) {
        const std::string file = "m" + fs::path(name).extension().string();
        doors_.push_back(
            {name, file, source(folder + name), {"avatar", "show", path(file)}, Form::glb, {}});
    }
    for (const auto& [door, name, form] :
         {std::tuple("3DS", "derived_kenney_character.3ds", Form::bytes),
          std::tuple("FBX", "bent_bar.fbx", Form::bytes),
          std::tuple("FBX as text", "bent_bar_text.fbx", Form::text),
          std::tuple("Collada", "bent_bar.dae", Form::text),
          std::tuple("OBJ", "bent_bar.obj", Form::text)}) {
        const std::string file = "m" + fs::path(name).extension().string();
        doors_.push_back(
            {door, file, source(folder + name), {"avatar", "show", path(file)}, form, {}});
    }
    const std::string whole = std::string(RAKS_SOURCE_DIR) + "/" + folder + "six_poses.vrma";
    for (const std::string name : {"smoke_spring.vrm", "Godette_vrm_v4.vrm"}) {
        doors_.push_back({"posed " + name,
                          "m.vrm",
                          source(folder + name),
                          {"avatar", "pose", path("m.vrm"), "--motion", whole, "-o", table},
                          Form::glb,
                          {"x.tsv"}});
    }
    // Of which there is nothing to say.
    const std::string figure = std::string(RAKS_SOURCE_DIR) + "/" + folder + "smoke_spring.vrm";
    doors_.push_back({"motion",
                      "m.vrma",
                      source(folder + "six_poses.vrma"),
                      {"avatar", "pose", figure, "--motion", path("m.vrma"), "-o", table},
                      Form::glb,
                      {"x.tsv"}});
    ASSERT_TRUE(write_file(path("figure.glb"), source(folder + "RiggedFigure.glb")));
    doors_.push_back({"labels of bones",
                      "m.toml",
                      source("tests/fuzz/corpus/bone_labels/rigged_figure.toml"),
                      {"avatar", "show", path("figure.glb"), "--labels", path("m.toml")},
                      Form::text,
                      {}});
}

void Mutants::add_motion() {
    const std::string waltz = source("config/choreographies/waltz.toml");
    doors_.push_back({"choreography",
                      "m.toml",
                      waltz,
                      {"train", "figure", path("m.toml"), "-o", path("out/")},
                      Form::text,
                      {"out"}});
    ASSERT_EQ(run({"dance", path("song.wav"), "-o", path("good.bvh"), "--fps", "30"}).exit_code, 0);
    const std::string clip = read_file(path("good.bvh")).value();
    doors_.push_back({"clip",
                      "m.bvh",
                      clip,
                      {"stick", path("m.bvh"), "--frame", "5", "-o", path("x.png")},
                      Form::text,
                      {"x.png"}});
    const std::string corpus = "tests/fuzz/corpus/";
    for (const auto& [ending, file, form] : {std::tuple("npz", "smpl_npz/amass.npz", Form::bytes),
                                             std::tuple("c3d", "c3d/intel_float.c3d", Form::bytes),
                                             std::tuple("trc", "trc/two.trc", Form::text)}) {
        const std::string name = std::string("m.") + ending;
        doors_.push_back({ending,
                          name,
                          source(corpus + file),
                          {"stick", path(name), "--frame", "0", "-o", path("x.png")},
                          form,
                          {"x.png"}});
    }
    ASSERT_TRUE(write_file(path("labels.tsv"), source("tests/fuzz/corpus/labels/good.tsv")));
    doors_.push_back(
        {"labels",
         "m.tsv",
         source("tests/fuzz/corpus/labels/good.tsv"),
         {"train", "figure", path("good.bvh"), "--labels", path("m.tsv"), "-o", path("out/")},
         Form::text,
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
                          Form::text,
                          {"x.bvh"}});
    }
}

void Mutants::add_settings() {
    doors_.push_back({"settings",
                      "config/raks/config.toml",
                      source("config/default.toml"),
                      {"config", "show"},
                      Form::text,
                      {}});
    doors_.push_back({"devices",
                      "state/raks/devices.toml",
                      source("tests/fuzz/corpus/devices/good.toml"),
                      {"devices"},
                      Form::text,
                      {}});
    const std::string list = "#EXTM3U\n#EXTINF:2,a\nsong.wav\n";
    doors_.push_back({"m3u", "m.m3u", list, {"analyze", path("m.m3u")}, Form::text, {}});
    doors_.push_back({"pls",
                      "m.pls",
                      "[playlist]\nFile1=song.wav\nTitle1=a\nNumberOfEntries=1\nVersion=2\n",
                      {"analyze", path("m.pls")},
                      Form::text,
                      {}});
    doors_.push_back({"xspf",
                      "m.xspf",
                      "<?xml version=\"1.0\"?>\n<playlist version=\"1\"><trackList><track>"
                      "<location>song.wav</location></track></trackList></playlist>\n",
                      {"analyze", path("m.xspf")},
                      Form::text,
                      {}});
    doors_.push_back(
        {"beats",
         "m.beats",
         "0.5 1\n1.0 2\n1.5 3\n",
         {"analyze", path("song.wav"), "--plot", path("x.svg"), "--reference", path("m.beats")},
         Form::text,
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

std::string mangled_bytes(const std::string& bytes, std::uint64_t seed) {
    return mangled(bytes, {seed, 1 + seed % 40, seed % 3 == 0 ? 400U : ~0U});
}

std::string little_endian(std::size_t number) {
    std::string bytes;
    for (std::size_t byte = 0; byte < 4; ++byte) {
        bytes += static_cast<char>(number >> (8 * byte));
    }
    return bytes;
}

/// A GLB whose text is damaged by structure; all lengths are right again.
std::string mutated_glb(const std::string& bytes, std::uint64_t seed) {
    constexpr std::size_t kHead = 12;
    constexpr std::size_t kChunkHead = 8;
    const auto byte = [&](std::size_t at) {
        return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at]));
    };
    const std::size_t length = byte(kHead) | byte(kHead + 1) << 8U | byte(kHead + 2) << 16U;
    std::string text = fuzz::mutated(bytes.substr(kHead + kChunkHead, length), seed);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string rest = bytes.substr(kHead + kChunkHead + length);
    return bytes.substr(0, 8) + little_endian(kHead + kChunkHead + text.size() + rest.size()) +
           little_endian(text.size()) + bytes.substr(kHead + 4, 4) + text + rest;
}

std::string damaged(const Door& door, std::uint64_t seed) {
    switch (door.form) {
        case Form::text:
            return fuzz::mutated(door.bytes, seed);
        case Form::glb:
            // By another bit than the door: doors come by turns, too.
            if (CounterRandom(seed).below(0, 2) == 0) {
                return mutated_glb(door.bytes, seed);
            }
            break;
        case Form::bytes:
            break;
    }
    return mangled_bytes(door.bytes, seed);
}

void Mutants::try_one(const Door& door, std::uint64_t seed) {
    const std::string changed = damaged(door, seed);
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
    if (result.most_kilobytes > most_allowed_) {
        note(door, seed, fmt::format("took over {} MB", most_allowed_ / 1000));
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

/// All, or the one that is asked for.
void Mutants::choose_doors() {
    const char* const asked = std::getenv("RAKS_MUTANTS_OF");  // NOLINT(concurrency-mt-unsafe)
    if (asked != nullptr) {
        doors_.erase(
            std::remove_if(
                doors_.begin(), doors_.end(), [&](const Door& door) { return door.name != asked; }),
            doors_.end());
    }
}

void Mutants::try_all(const char* count_name) {
    choose_doors();
    if (doors_.empty()) {
        GTEST_SKIP() << "skipped: RAKS_MUTANTS_OF names another format";
    }
    for (const std::string& name : files()) {
        usual_.insert(name);
    }
    const std::int64_t count =
        number_from(count_name).value_or(static_cast<std::int64_t>(doors_.size()));
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

TEST_F(Mutants, end_the_program_soon_with_one_line) {
    audio::MusicPlan plan;
    plan.style = audio::Style::drums;
    plan.seconds = 2.0;
    write_music("song.wav", plan);
    add_sounds();
    add_motion();
    add_settings();
    try_all("RAKS_MUTANTS");
}

TEST_F(Mutants, of_models_end_the_program_soon_with_one_line) {
    most_allowed_ = kMostKilobytesOfModels;
    add_models();
    try_all("RAKS_MODEL_MUTANTS");
}

}  // namespace
}  // namespace raks::test
