#pragma once

#include <string>
#include <string_view>

namespace raks::apps {

/// How much the program says on stderr: `quiet`, what went wrong alone; `verbose`, details too.
enum class Talk { quiet, usual, verbose };
/// Sets it for the whole program; `usual` until then. Threads: main, before any other.
void set_talk(Talk talk) noexcept;

/// From here on nothing reaches the terminal but the lines of this page: what libraries print on
/// stderr by themselves (PortAudio, ALSA, JACK, X, EGL) is lost, unless `verbose`. Builds with
/// asserts or sanitizers, which print there, too, are left as they are. Threads: main, before any
/// other.
void silence_libraries() noexcept;
/// Gives stderr back: before another program takes this one's place. Threads: main.
void let_libraries_speak() noexcept;
/// The descriptor that the lines go to. Threads: any. Real-time: yes; in a handler of signals, too.
[[nodiscard]] int descriptor_of_lines() noexcept;

/// One line for people on stderr, behind "raks: ": a warning, what is being done; not where
/// `quiet`. Names and words that files and the command line bring along cannot break it
/// (base/printable.hpp). Threads: any. Real-time: no.
void say(std::string_view line);
/// The same for details that few want to know: only where `verbose`.
void say_detail(std::string_view line);
/// The same for what went wrong: always.
void complain(std::string_view line);

/// A command's result for people, on stdout: lines, each with its end. As `say`, what a file's or
/// device's name brings along reaches no terminal: control characters but line ends become '?'. A
/// name that may hold line ends goes through printable (base/printable.hpp) before it gets into
/// `text`. Threads: main.
void print_text(std::string_view text);
/// A document for programs, on stdout as it is: JSON escapes by itself. Threads: main.
void print_json(std::string_view document);

/// One line of progress on stderr, rewritten in place; shown only on a terminal, at most five times
/// a second, and not where `quiet`. The lines above clear it before they are written. Threads: one.
class ProgressLine {
 public:
    /// `what`: stands before the progress, cut to 60 characters, or to what the terminal has room
    /// for.
    explicit ProgressLine(std::string_view what);
    ~ProgressLine();  ///< clears the line
    /// Not copied: two would write to the same line.
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;  ///< likewise

    /// From the next time on this stands before the progress.
    void rename(std::string_view what);
    /// Shows `share` done, [0, 1], as a percentage, and how long the rest takes by what the share
    /// has taken.
    void show(double share);
    /// Shows any short text.
    void show(const std::string& text);
    /// A part is done: a line for those who do not see the progress, since stderr is no terminal.
    void reached(std::string_view line);

 private:
    std::string what_;
    bool is_terminal_;
    double start_seconds_;
    double last_seconds_ = -1.0;
};

/// A span of time as people say it: "40 s", "3 min 20 s", "1 h 5 min".
[[nodiscard]] std::string time_in_words(double seconds);

}  // namespace raks::apps
