#pragma once

#include <string>
#include <string_view>

namespace raks::apps {

/// One line for people on stderr, behind "raks: ": an error, a warning, what is being done. Names
/// and words that files and the command line bring along cannot break it (base/printable.hpp).
/// Threads: any. Real-time: no.
void say(std::string_view line);

/// One line of progress on stderr, rewritten in place; shown only on a terminal, at most five times
/// a second. Threads: one.
class ProgressLine {
 public:
    /// `what`: stands before the progress, cut to 60 characters.
    explicit ProgressLine(std::string what);
    ~ProgressLine();  ///< clears the line
    /// Not copied: two would write to the same line.
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;  ///< likewise

    /// Shows `share` done, [0, 1], as a percentage.
    void show(double share);
    /// Shows any short text.
    void show(const std::string& text);

 private:
    std::string what_;
    bool is_terminal_;
    bool has_shown_ = false;
    double last_seconds_ = -1.0;
};

}  // namespace raks::apps
