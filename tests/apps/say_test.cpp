#include "apps/terminal/say.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <string>

namespace raks::apps {
namespace {

/// Stands for stderr while it lives, and keeps what is written to it.
class TerminalOfOurs {
 public:
    TerminalOfOurs() : stderr_(dup(STDERR_FILENO)) {
        int terminal = -1;
        EXPECT_EQ(openpty(&keeper_, &terminal, nullptr, nullptr, nullptr), 0);
        dup2(terminal, STDERR_FILENO);
        close(terminal);
    }
    ~TerminalOfOurs() {
        dup2(stderr_, STDERR_FILENO);
        close(stderr_);
        close(keeper_);
    }
    TerminalOfOurs(const TerminalOfOurs&) = delete;
    TerminalOfOurs& operator=(const TerminalOfOurs&) = delete;

    /// What was written up to `end`, which must come.
    [[nodiscard]] std::string written_up_to(const std::string& end) const {
        std::string written;
        char letter = 0;
        while (!written.ends_with(end) && read(keeper_, &letter, 1) == 1) {
            written += letter;
        }
        return written;
    }

 private:
    int stderr_;
    int keeper_ = -1;
};

TEST(Say, a_line_clears_the_progress_before_it) {
    const TerminalOfOurs terminal;
    {
        ProgressLine progress("song.wav");
        progress.show(std::string("120 BPM"));
        complain("the device is gone");
    }
    complain("the end");
    EXPECT_EQ(terminal.written_up_to("the end\r\n"),
              "\r\033[Ksong.wav 120 BPM\r\033[Kraks: the device is gone\r\nraks: the end\r\n");
}

TEST(Say, progress_that_nothing_interrupts_is_cleared_at_its_end) {
    const TerminalOfOurs terminal;
    {
        ProgressLine progress("song.wav");
        progress.show(std::string("120 BPM"));
    }
    complain("the end");
    EXPECT_EQ(terminal.written_up_to("the end\r\n"),
              "\r\033[Ksong.wav 120 BPM\r\033[Kraks: the end\r\n");
}

}  // namespace
}  // namespace raks::apps
