#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tests/end_to_end/window.hpp"
#include "tests/support/child_process.hpp"

/// What keys change in a window.
namespace raks::test {

/// The colour of the upper left corner.
inline std::array<int, 3> corner(const std::string& picture) {
    const auto byte = [&](std::size_t at) { return int{static_cast<unsigned char>(picture[at])}; };
    return {byte(0), byte(1), byte(2)};
}

/// Plays in a window, paused: what a key changes is all that changes. (Pictures are compared by
/// EXPECT_TRUE: nobody wants to read them.)
class KeysTest : public WindowTest {
 protected:
    void start(const std::string& overlay, const std::string& view = "auto") {
        start({"play", "--no-sound", overlay, "--view", view});
    }
    void start(std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), {path("one.wav"), path("two.wav")});
        raks_.emplace(in_window(arguments));
        ASSERT_TRUE(raks_->wait_for_output("one.wav"));
    }
    /// Waits for the dance: some looks, each other than the one before. (On a busy machine a
    /// picture stays for more looks than one.)
    static bool shows_dancing() {
        std::string before = picture();
        int moved = 0;
        return shows([&](const std::string& now) {
            moved += difference(now, before) > 0.1 ? 1 : 0;
            before = now;
            return moved >= 4;
        });
    }
    /// The picture in the pause.
    std::string start_and_pause(const std::string& overlay) {
        start({"-v", "play", "--no-sound", overlay});
        return pause(*raks_);
    }
    /// The picture in a pause of the dance. (The first moments of a song have no pose before them.)
    /// A stick figure: hair that has swung on does not swing back.
    std::string dance_and_pause() {
        start({"-v", "play", "--no-sound", "--no-overlay", "--view", "stick"});
        EXPECT_TRUE(shows_dancing());
        return pause(*raks_);
    }
    static bool shows_again(const std::string& picture) {
        return shows([&](const std::string& now) { return now == picture; });
    }
    static bool shows_other_than(const std::string& picture) {
        return shows([&](const std::string& now) { return difference(now, picture) > 0.05; });
    }
    static bool shows_corner(const std::array<int, 3>& colour) {
        return shows([&](const std::string& now) { return corner(now) == colour; });
    }
    /// Presses, and what the lower part is then; it must have changed.
    static std::string changed_by(const std::string& key, const std::string& before) {
        press({key});
        EXPECT_TRUE(shows([&](const std::string& now) { return lower(now) != before; })) << key;
        return lower(still_picture());
    }

    std::optional<CapturedProcess> raks_;
};

}  // namespace raks::test
