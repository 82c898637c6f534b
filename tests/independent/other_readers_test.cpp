// What other programs make of files that we write: a dance as VRMA in Khronos' validator and
// pixiv's three-vrm-animation, one as VMD in babylon-mmd, one as GLB in three.js as a browser draws
// it, avatars in `assimp info`. Skipped, with a word, where node, npm, the network, Chromium or
// assimp is missing.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/skeleton/formats/mmd/vmd.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/independent/mmd_body_document.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

const fs::path kHere = fs::path(RAKS_SOURCE_DIR) / "tests" / "independent";
const fs::path kModels = fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "avatars";
// In the build folder: packages are fetched once for it.
const fs::path kPackages = fs::path(RAKS_BINARY_DIR) / "tests" / "independent" / "packages";

ProcessResult run_there(std::vector<std::string> command) {
    ProcessPlan plan;
    plan.command = std::move(command);
    plan.folder = kPackages.string();
    plan.timeout = std::chrono::seconds(300);
    return run_process(plan);
}

/// Whether npm could not reach its registry, as it says it.
bool is_network_fault(const std::string& message) {
    for (const char* code : {"ENOTFOUND",
                             "EAI_AGAIN",
                             "ECONNREFUSED",
                             "ECONNRESET",
                             "ETIMEDOUT",
                             "ENETUNREACH",
                             "EHOSTUNREACH"}) {
        if (message.find(code) != std::string::npos) {
            return true;
        }
    }
    return false;
}

/// While it lives no other process that wants the packages goes on: suites run side by side, and
/// `npm ci` begins by removing what is there.
class OnePreparesPackages {
 public:
    OnePreparesPackages()
        : file_(::open((kPackages / "lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666)) {
        ::flock(file_, LOCK_EX);
    }
    OnePreparesPackages(const OnePreparesPackages&) = delete;
    OnePreparesPackages& operator=(const OnePreparesPackages&) = delete;
    ~OnePreparesPackages() { ::close(file_); }

 private:
    int file_;
};

/// Copies a file where the copy is not the same already: another process may be reading it.
void copy_if_other(const fs::path& from, const fs::path& to) {
    if (read_file(to).value_or("") != read_file(from).value()) {
        fs::copy_file(from, to, fs::copy_options::overwrite_existing);
    }
}

class IndependentReaders : public ProgramTest {
 protected:
    /// The exact packages of package-lock.json; skips the test where they cannot be had.
    void SetUp() override {
        fs::create_directories(kPackages);
        if (run_there({"npm", "--version"}).exit_code != 0) {
            GTEST_SKIP() << "node and npm are not installed";
        }
        const OnePreparesPackages alone;
        const std::string lock = read_file(kHere / "package-lock.json").value();
        const fs::path stamp = kPackages / "installed.json";
        for (const char* name : {"package.json",
                                 "package-lock.json",
                                 "check_vrma.mjs",
                                 "check_picture.mjs",
                                 "check_vmd.mjs",
                                 "picture_page.html"}) {
            copy_if_other(kHere / name, kPackages / name);
        }
        if (read_file(stamp).value_or("") == lock) {
            return;
        }
        const auto fetched =
            run_there({"npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"});
        if (fetched.exit_code != 0 && is_network_fault(fetched.err + fetched.out)) {
            GTEST_SKIP() << "npm cannot reach its registry";
        }
        ASSERT_EQ(fetched.exit_code, 0) << fetched.err;
        ASSERT_TRUE(write_file(stamp, lock));
    }

    /// Six seconds of salsa to music of ours.
    void dance_to(const std::string& output, const std::vector<std::string>& more = {}) {
        audio::MusicPlan plan;
        plan.style = audio::Style::montuno;
        plan.tempo = {{0.0, 180.0}};
        plan.seconds = 6.0;
        write_music("song.wav", plan);
        std::vector<std::string> words = {
            "dance", path("song.wav"), "--dance", "salsa", "-o", path(output)};
        words.insert(words.end(), more.begin(), more.end());
        const auto danced = run(words);
        ASSERT_EQ(danced.exit_code, 0) << danced.err;
    }

    /// What the others say of a clip on a model.
    nlohmann::json check(const std::string& clip, const fs::path& model) {
        const auto posed = run({"avatar",
                                "pose",
                                model.string(),
                                "--motion",
                                clip,
                                "--time",
                                "all",
                                "-o",
                                path("ours.tsv")});
        EXPECT_EQ(posed.exit_code, 0) << posed.err;
        const auto said =
            run_there({"node", "check_vrma.mjs", clip, model.string(), path("ours.tsv")});
        EXPECT_EQ(said.exit_code, 0) << said.err;
        return said.exit_code == 0 ? nlohmann::json::parse(said.out) : nlohmann::json();
    }
};

TEST_F(IndependentReaders, find_no_fault_in_a_dance_and_pose_the_same_joints) {
    dance_to("dance.vrma");
    for (const char* name : {"Godette_vrm_v4.vrm", "smoke_spring.vrm"}) {
        const nlohmann::json said = check(path("dance.vrma"), kModels / name);
        ASSERT_TRUE(said.is_object()) << name;
        EXPECT_EQ(said["errors"], 0) << said;
        EXPECT_EQ(said["warnings"], 0) << said;
        EXPECT_NEAR(said["duration"].get<double>(), 6.0, 0.05);
        EXPECT_GT(said["compared"].get<int>(), 500);
        // A tenth of a millimetre: floats of two programs.
        EXPECT_LT(said["worst"].get<double>(), 1e-4) << name << ": " << said["where"];
    }
}

TEST_F(IndependentReaders, draw_a_dance_as_we_do) {
    dance_to("dance.glb");
    const auto drawn = run({"avatar",
                            "pose",
                            path("dance.glb"),
                            "--motion",
                            path("dance.glb"),
                            "--time",
                            "3",
                            "-o",
                            path("ours.png")});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const auto said = run_there(
        {"node", "check_picture.mjs", path("dance.glb"), "3", path("ours.png"), path("both.png")});
    ASSERT_EQ(said.exit_code, 0) << said.err;
    const auto answer = nlohmann::json::parse(said.out);
    if (answer.contains("skipped")) {
        GTEST_SKIP() << answer["skipped"].get<std::string>();
    }
    ASSERT_TRUE(answer.contains("overlap")) << said.out;
    EXPECT_GT(answer["ours"].get<int>(), 20'000) << said.out;
    // 0.94 to 0.97 here: light and edges differ.
    EXPECT_GT(answer["overlap"].get<double>(), 0.9) << said.out;
}

// Places of all bones at frames of a VMD, in babylon-mmd and here.
class VmdReaders : public IndependentReaders {
 protected:
    void expect_same_places(const std::string& motion, std::uint32_t step) {
        const auto file = motion::read_vmd(read_file(motion).value());
        ASSERT_TRUE(file) << file.error().message;
        ASSERT_TRUE(write_file(path("body.json"), mmd_body_document(file->motion, step).dump()));
        const auto said = run_there({"node", "check_vmd.mjs", motion, path("body.json")});
        ASSERT_EQ(said.exit_code, 0) << said.err;
        const auto answer = nlohmann::json::parse(said.out);
        EXPECT_GT(answer["compared"].get<int>(), 2000) << said.out;
        // 10 mm are promised; 0.1 mm are seen.
        EXPECT_LT(answer["worst"].get<double>() * motion::kMmdMetres, 0.001) << said.out;
    }
};

TEST_F(VmdReaders, pose_a_dance_for_mikumikudance_as_we_do) {
    for (const char* legs : {"ik", "fk"}) {
        dance_to("dance.vmd", {"--legs", legs});
        expect_same_places(path("dance.vmd"), 3);
    }
}

// Keys drawn by dice, in no order, with curves; legs have goals that their turns do not reach.
TEST_F(VmdReaders, bend_knees_towards_goals_as_we_do) {
    expect_same_places((fs::path(RAKS_SOURCE_DIR) / "tests/fuzz/corpus/vmd/goals.vmd").string(), 1);
}

class ForeignPrograms : public ProgramTest {};

TEST_F(ForeignPrograms, assimp_finds_no_fault_in_exported_avatars) {
    ProcessPlan plan;
    plan.command = {"assimp", "version"};
    if (run_process(plan).exit_code != 0) {
        GTEST_SKIP() << "assimp-utils is not installed";
    }
    for (const std::string ending : {"glb", "3ds", "obj"}) {
        for (const char* from : {"", "RiggedFigure.glb", "smoke_spring.vrm"}) {
            std::vector<std::string> words = {"avatar", "export", path("x." + ending)};
            if (*from != '\0') {
                words.insert(words.end(), {"--from", (kModels / from).string()});
            }
            const auto exported = run(words);
            ASSERT_EQ(exported.exit_code, 0) << exported.err;
            plan.command = {"assimp", "info", path("x." + ending)};
            const auto said = run_process(plan);
            EXPECT_EQ(said.exit_code, 0) << ending << " of " << from << ": " << said.out;
            EXPECT_EQ((said.out + said.err).find("ERROR"), std::string::npos) << said.out;
        }
    }
}

}  // namespace
}  // namespace raks::test
