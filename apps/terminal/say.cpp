#include "apps/terminal/say.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/printable.hpp"
#include "base/time.hpp"

#include <fmt/format.h>

namespace raks::apps {

namespace {

std::atomic<Talk> g_talk{Talk::usual};

// relaxed: set once, before any other thread
Talk talk() noexcept { return g_talk.load(std::memory_order_relaxed); }

#if defined(RAKS_ASSERTS) || defined(RAKS_SANITIZED)
constexpr bool kMaySilence = false;
#else
constexpr bool kMaySilence = true;
#endif

// Where our own lines go while stderr goes nowhere; null: stderr.
std::FILE* g_lines = nullptr;
std::atomic<int> g_descriptor{STDERR_FILENO};

// Set once, before any other thread.
std::FILE* lines() noexcept { return g_lines != nullptr ? g_lines : stderr; }

// Whether a line of progress stands on the terminal, which whoever writes next has to clear.
std::atomic<bool> g_progress_is_shown{false};

// What clears the line of progress, once; else nothing.
const char* clearing() noexcept {
    // relaxed: the lines themselves are kept apart by the lock of the stream
    return g_progress_is_shown.exchange(false, std::memory_order_relaxed) ? "\r\033[K" : "";
}

double seconds_now() { return to_seconds(Nanos(HostClock::now().time_since_epoch())); }

}  // namespace

void set_talk(Talk talk) noexcept { g_talk.store(talk, std::memory_order_relaxed); }

void silence_libraries() noexcept {
    if (!kMaySilence || talk() == Talk::verbose) {
        return;
    }
    const int own = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    std::FILE* const file = own >= 0 && nothing >= 0 ? fdopen(own, "w") : nullptr;
    if (file != nullptr) {
        std::setvbuf(file, nullptr, _IONBF, 0);
        g_lines = file;
        g_descriptor.store(own, std::memory_order_relaxed);  // relaxed: no other thread yet
        dup2(nothing, STDERR_FILENO);
    }
    if (nothing >= 0) {
        close(nothing);
    }
}

void let_libraries_speak() noexcept { dup2(descriptor_of_lines(), STDERR_FILENO); }

// relaxed: set once, before any other thread
int descriptor_of_lines() noexcept { return g_descriptor.load(std::memory_order_relaxed); }

void complain(std::string_view line) {
    std::fprintf(lines(), "%sraks: %s\n", clearing(), printable(line).c_str());
}

void say(std::string_view line) {
    if (talk() != Talk::quiet) {
        complain(line);
    }
}

void say_detail(std::string_view line) {
    if (talk() == Talk::verbose) {
        complain(line);
    }
}

namespace {

// A line of progress would else stand before the first line of a result on the same terminal.
void clear_progress() { std::fputs(clearing(), lines()); }

}  // namespace

void print_json(std::string_view document) {
    clear_progress();
    std::fwrite(document.data(), 1, document.size(), stdout);
}

void print_text(std::string_view text) {
    clear_progress();
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        // Nothing is cut out of a result, however long it is.
        const std::string line = printable(text.substr(0, end), std::string_view::npos);
        std::fwrite(line.data(), 1, line.size(), stdout);
        if (end == std::string_view::npos) {
            return;
        }
        std::fputc('\n', stdout);
        text.remove_prefix(end + 1);
    }
}

namespace {
// At most five updates a second: writing to a terminal is slow.
constexpr double kSecondsBetween = 0.2;
// Before that much is done and has been waited for, what is left is a guess.
constexpr double kLeastShare = 0.02;
constexpr double kLeastSeconds = 2.0;

// Columns of a terminal that does not tell them.
constexpr std::size_t kUsualColumns = 80;

std::size_t columns_of_terminal() {
    winsize size{};
    const bool is_known = ioctl(descriptor_of_lines(), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return is_known ? size.ws_col : kUsualColumns;
}
}  // namespace

ProgressLine::ProgressLine(std::string_view what)
    : what_(printable(what, 60)),
      is_terminal_(isatty(descriptor_of_lines()) == 1 && talk() != Talk::quiet),
      start_seconds_(seconds_now()) {}

ProgressLine::~ProgressLine() { clear_progress(); }

void ProgressLine::rename(std::string_view what) { what_ = printable(what, 60); }

void ProgressLine::show(double share) {
    std::string text = fmt::format("{:3.0f} %", 100.0 * share);
    const double gone = seconds_now() - start_seconds_;
    if (share >= kLeastShare && gone >= kLeastSeconds) {
        text += ", " + time_in_words(gone * (1.0 - share) / share) + " left";
    }
    show(text);
}

void ProgressLine::show(const std::string& text) {
    // Updates in between are dropped, not queued: the next one is newer.
    const double now = seconds_now();
    if (!is_terminal_ || now - last_seconds_ < kSecondsBetween) {
        return;
    }
    last_seconds_ = now;
    // A line that goes on in the next row cannot be cleared: what stands before is cut to fit. The
    // last column stays free, behind which some terminals begin the next row.
    const std::size_t taken = text.size() + 2;
    const std::size_t columns = columns_of_terminal();
    const std::size_t room = columns > taken ? columns - taken : 0;
    // What printable cuts has three dots in its middle.
    const std::string what =
        what_.size() <= room ? what_ : printable(what_, room > 3 ? room - 3 : 0);
    g_progress_is_shown.store(true, std::memory_order_relaxed);  // relaxed: as above
    std::fprintf(lines(), "\r\033[K%s %s", what.c_str(), text.c_str());
    std::fflush(lines());
}

void ProgressLine::reached(std::string_view line) {
    if (!is_terminal_) {
        say(line);
    }
}

std::string time_in_words(double seconds) {
    const auto whole = static_cast<long>(std::lround(std::clamp(seconds, 0.0, 1e9)));
    if (whole < 60) {
        return fmt::format("{} s", whole);
    }
    if (whole < 3600) {
        return fmt::format("{} min {} s", whole / 60, whole % 60);
    }
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace raks::apps
