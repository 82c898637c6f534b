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
    explicit TerminalOfOurs(unsigned short columns = 80) : stderr_(dup(STDERR_FILENO)) {
        int terminal = -1;
        const winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
        EXPECT_EQ(openpty(&keeper_, &terminal, nullptr, nullptr, &size), 0);
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

TEST(Say, a_result_clears_the_progress_before_it) {
    const TerminalOfOurs terminal;
    ProgressLine progress("song.wav");
    progress.show(std::string("50 %"));
    ::testing::internal::CaptureStdout();
    print_text("120 BPM\n");
    complain("the end");
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "120 BPM\n");
    EXPECT_EQ(terminal.written_up_to("the end\r\n"),
              "\r\033[Ksong.wav 50 %\r\033[Kraks: the end\r\n");
}

TEST(Say, progress_fits_into_one_row_of_the_terminal) {
    const TerminalOfOurs terminal(20);
    ProgressLine progress("a song with a long name.wav");
    progress.show(std::string("120 BPM"));
    const std::string written = terminal.written_up_to("120 BPM");
    EXPECT_EQ(written.size(), std::string("\r\033[K").size() + 19) << written;
}

}  // namespace
}  // namespace raks::apps
