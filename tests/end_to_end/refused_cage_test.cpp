// Inside the sandbox of somebody else, such as that of Flatpak or of a container, which allows none
// inside: files are read all the same, by children with less of a cage, and whoever asks is told.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/end_to_end/program_fixture.hpp"

namespace raks::test {
namespace {

constexpr const char* kNote = "filters of system calls (seccomp) are refused here";

class RefusedCage : public ProgramTest {
 protected:
    /// `prctl`: "prctl" or "no-prctl", see tests/support/refuse_calls.cpp.
    [[nodiscard]] ProcessResult run_refused(const std::string& prctl,
                                            const std::vector<std::string>& arguments) const {
        ProcessPlan refused = plan(arguments);
        refused.command.insert(refused.command.begin(), {RAKS_REFUSE_CALLS, prctl});
        return run_process(refused);
    }
};

#ifdef RAKS_SANITIZED
#define SKIP_WHERE_NO_CHILD_IS_CAGED() GTEST_SKIP() << "children of sanitized builds have no cage"
#else
#define SKIP_WHERE_NO_CHILD_IS_CAGED() static_cast<void>(0)
#endif

TEST_F(RefusedCage, music_is_heard_and_who_asks_is_told_that_its_reader_has_no_filter) {
    SKIP_WHERE_NO_CHILD_IS_CAGED();
    write_clicks("a.wav", 1.0);
    const ProcessResult told = run_refused("prctl", {"-v", "analyze", path("a.wav")});
    if (told.exit_code == 77) {
        GTEST_SKIP() << "this kernel has no filter of system calls";
    }
    EXPECT_EQ(told.exit_code, 0) << told.err;
    EXPECT_NE(told.err.find(kNote), std::string::npos) << told.err;

    const ProcessResult usual = run_refused("prctl", {"analyze", path("a.wav")});
    EXPECT_EQ(usual.exit_code, 0) << usual.err;
    EXPECT_EQ(usual.err.find(kNote), std::string::npos) << usual.err;
    EXPECT_EQ(usual.out, run({"analyze", path("a.wav")}).out);
    EXPECT_EQ(run({"-v", "analyze", path("a.wav")}).err.find(kNote), std::string::npos);
}

// Where seccomp(2) alone is refused, libseccomp takes the older way through prctl(2): the cage is
// whole.
TEST_F(RefusedCage, the_older_call_makes_the_same_filter) {
    write_clicks("a.wav", 1.0);
    const ProcessResult heard = run_refused("no-prctl", {"-v", "analyze", path("a.wav")});
    if (heard.exit_code == 77) {
        GTEST_SKIP() << "this kernel has no filter of system calls";
    }
    EXPECT_EQ(heard.exit_code, 0) << heard.err;
    EXPECT_EQ(heard.err.find(kNote), std::string::npos) << heard.err;
}

// Pictures in models, and models of other formats, are read by children of their own.
TEST_F(RefusedCage, models_are_shown_with_a_warning) {
    SKIP_WHERE_NO_CHILD_IS_CAGED();
    const std::string models = std::string(RAKS_SOURCE_DIR) + "/tests/data/avatars/";
    for (const char* model : {"Godette_vrm_v4.vrm", "bent_bar.fbx"}) {
        const std::vector<std::string> show = {
            "-v", "avatar", "show", models + model, "--thumbnail", path("a.png")};
        const ProcessResult shown = run_refused("prctl", show);
        if (shown.exit_code == 77) {
            GTEST_SKIP() << "this kernel has no filter of system calls";
        }
        EXPECT_EQ(shown.exit_code, 0) << model << "\n" << shown.err;
        EXPECT_NE((shown.out + shown.err).find("seccomp"), std::string::npos)
            << model << "\n"
            << shown.out << shown.err;
        const ProcessResult usual = run(show);
        EXPECT_EQ((usual.out + usual.err).find("seccomp"), std::string::npos) << usual.err;
    }
}

// A film is written by the program itself.
TEST_F(RefusedCage, films_are_written) {
    draw_small_pictures();
    write_clicks("a.wav", 1.0);
    const ProcessResult filmed =
        run_refused("prctl", {"render", path("a.wav"), "-o", path("a.mp4"), "--duration", "0.2"});
    if (filmed.exit_code == 77) {
        GTEST_SKIP() << "this kernel has no filter of system calls";
    }
    EXPECT_EQ(filmed.exit_code, 0) << filmed.err;
}

}  // namespace
}  // namespace raks::test
