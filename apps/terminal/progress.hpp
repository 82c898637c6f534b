#pragma once

#include <string>

namespace raks::apps {

/// One line of progress on stderr, rewritten in place: only on a terminal, at most five a second.
class ProgressLine {
 public:
    explicit ProgressLine(std::string what);
    ~ProgressLine();  ///< clears the line
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// `share` done, [0, 1].
    void show(double share);
    /// Any short text.
    void show(const std::string& text);

 private:
    std::string what_;
    bool is_terminal_;
    bool has_shown_ = false;
    double last_seconds_ = -1.0;
};

}  // namespace raks::apps
