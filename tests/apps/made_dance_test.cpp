#include "apps/xbody/made_dance.hpp"

#include <gtest/gtest.h>

#include <sys/wait.h>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

/// A program in the place of raks.
class MadeDances : public ::testing::Test {
 protected:
    fs::path program(const std::string& script) const {
        const fs::path file = folder_ / "program";
        EXPECT_TRUE(write_file(file, "#!/bin/sh\n" + script + "\n"));
        fs::permissions(file, fs::perms::owner_all);
        return file;
    }
    // Waits for the child, but leaves it to the dance.
    static Expected<std::optional<fs::path>> wait(MadeDance& dance) {
        auto taken = dance.take();
        while (taken && !*taken) {
            siginfo_t ended{};
            waitid(P_ALL, 0, &ended, WEXITED | WNOWAIT);
            taken = dance.take();
        }
        return taken;
    }

    test::TemporaryFolder folder_;
};

TEST_F(MadeDances, are_there_once_the_program_has_ended_and_gone_with_the_value) {
    fs::path made;
    {
        auto dance = MadeDance::begin(program("echo \"$1 $6\" > \"$4\""), "/music/-song.mp3");
        ASSERT_TRUE(dance) << dance.error().message;
        MadeDance moved = std::move(*dance);
        const auto taken = wait(moved);
        ASSERT_TRUE(taken) << taken.error().message;
        made = **taken;
        EXPECT_EQ(read_file(made).value_or(""), "dance /music/-song.mp3\n");
    }
    EXPECT_FALSE(fs::exists(made.parent_path()));
}

TEST_F(MadeDances, that_cannot_be_made_are_said) {
    for (const char* const script : {"exit 1", "exit 0", "kill -9 $$"}) {
        auto dance = MadeDance::begin(program(script), "/music/song.mp3");
        ASSERT_TRUE(dance) << dance.error().message;
        const auto taken = wait(*dance);
        ASSERT_FALSE(taken) << script;
        EXPECT_EQ(taken.error().message,
                  "song.mp3: no dance could be made to it; raks dance tells why");
    }
}

TEST_F(MadeDances, that_are_given_up_end_their_program) {
    {
        auto dance = MadeDance::begin(program("exec sleep 1000"), "/music/song.mp3");
        ASSERT_TRUE(dance) << dance.error().message;
        EXPECT_FALSE(dance->take().value());
    }
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
}

}  // namespace
}  // namespace raks::apps
