// What `cmake --install` puts somewhere works there by itself.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "audio/io/wav_writer.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/run_program.hpp"

#include <nlohmann/json.hpp>

namespace raks::test {
namespace {

class Install : public ProgramTest {};

TEST_F(Install, the_programs_and_what_they_read_are_put_in_place) {
    const std::string root = path("root");
    run_program({"cmake", "--install", RAKS_BINARY_DIR, "--prefix", root});
    ProcessPlan installed = plan({"dances", "--json"});
    installed.command.front() = root + "/bin/raks";
    const ProcessResult dances = run_process(installed);
    ASSERT_EQ(dances.exit_code, 0) << dances.err;
    const auto document = nlohmann::json::parse(dances.out);
    ASSERT_GE(document["dances"].size(), 6U);
    for (const auto& dance : document["dances"]) {
        EXPECT_EQ(dance["folder"], root + "/share/raks/models/trained");
        EXPECT_EQ(dance["fault"], "");
    }
    // Sound files are decoded by a program that is installed with it.
    const std::string tone = path("tone.wav");
    installed.unset.push_back("RAKS_DECODER");
    ASSERT_TRUE(audio::write_wav(tone, std::vector<float>(48'000, 0.1F), 1, SampleRate(48'000)));
    installed.command = {root + "/bin/raks", "analyze", tone};
    const ProcessResult analyzed = run_process(installed);
    EXPECT_EQ(analyzed.exit_code, 0) << analyzed.err;
    installed.command = {root + "/bin/raks", "train", "genre", "--help"};
    const ProcessResult help = run_process(installed);
    EXPECT_EQ(help.exit_code, 0) << help.err;
    EXPECT_NE(help.out.find("raks train genre"), std::string::npos) << help.out;
}

// A damaged song meets no decoder in it. (libpulse brings libsndfile along, which nothing calls.)
TEST_F(Install, the_program_loads_no_decoder) {
    const std::string needed = run_program({"readelf", "-d", RAKS_PROGRAM});
    EXPECT_EQ(needed.find("libsndfile"), std::string::npos) << needed;
    const std::string all = run_program({"ldd", RAKS_PROGRAM});
    for (const char* library : {"libavcodec", "libavformat", "libavutil", "libsw"}) {
        EXPECT_EQ(all.find(library), std::string::npos) << all;
    }
}

// A model of another format meets no reader of it there, nor does what models hold packed. (Libpng
// is there to write.)
TEST_F(Install, the_program_loads_no_reader_of_foreign_models) {
    const std::string all = run_program({"ldd", RAKS_PROGRAM});
    for (const char* library :
         {"libassimp", "libdraco", "libjpeg", "libmeshoptimizer", "libwebp"}) {
        EXPECT_EQ(all.find(library), std::string::npos) << all;
    }
}

// Calibrating cameras takes OpenCV and Ceres, with some 60 libraries of theirs; dancing does not.
TEST_F(Install, the_program_loads_nothing_that_calibrates_cameras) {
    const std::string all = run_program({"ldd", RAKS_PROGRAM});
    for (const char* library : {"libopencv", "libceres", "libglog", "libcholmod", "libtbb"}) {
        EXPECT_EQ(all.find(library), std::string::npos) << all;
    }
}

}  // namespace
}  // namespace raks::test
