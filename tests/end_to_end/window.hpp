#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/xvfb.hpp"

namespace raks::test {

inline constexpr int kWindowWidth = 640;
inline constexpr int kWindowHeight = 360;

/// The program in a window on a display of our own, larger than the window. A minute of
/// music lies in one.wav and in two.wav.
class WindowTest : public ProgramTest {
 protected:
    void SetUp() override;

    [[nodiscard]] ProcessPlan in_window(std::vector<std::string> arguments) const;

    /// Names of the pictures that were saved, sorted.
    [[nodiscard]] std::vector<std::string> screenshots() const;

    /// Waits for the window, gives it the keyboard and presses the keys, one after the other.
    static void press(const std::vector<std::string>& keys);

    /// Presses the left button at a place of the window, moves by so many pixels, and lets go.
    static void click(int x, int y, int by_x = 0);

    /// The window as it is on the screen: raw RGB, rows from the top.
    static std::string picture();

    /// Looks at the window until `is_right` says so; false when it did not for a long time.
    static bool shows(const std::function<bool(const std::string&)>& is_right);

    /// The picture once it is drawn and stands still: several in a row are the same in their lower
    /// part (what changes in a pause, the pictures a second, is written in the upper one).
    static std::string still_picture();

    /// Presses the key for a pause of a program that was started with -v, and the picture then. (A
    /// song that is held back stands still, too: what the picture is before says nothing.)
    static std::string pause(CapturedProcess& raks);

    std::optional<Xvfb> display_;
};

/// What lies below the messages, which come and go by themselves: feet, and the overlay's panels.
std::string lower(const std::string& picture);

/// Times that `text` stands in what was said so far.
int count_of(const std::string& text, const std::string& said);

/// Mean absolute difference of the samples, 0 to 255.
double difference(const std::string& a, const std::string& b);

}  // namespace raks::test
