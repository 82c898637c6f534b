#include "apps/terminal/program.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include <semaphore.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "base/talking_child.hpp"

#include <CLI/CLI.hpp>

namespace raks::apps {
namespace {

// The chain of commands that the words chose, from the program to the innermost.
std::vector<const CLI::App*> chosen_commands(const CLI::App& app) {
    std::vector<const CLI::App*> chosen = {&app};
    for (auto inner = app.get_subcommands(); !inner.empty();
         inner = chosen.back()->get_subcommands()) {
        chosen.push_back(inner.back());
    }
    return chosen;
}

// Long names without their dashes, which would make all names alike to the search for the nearest.
std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back(name);
        }
    }
    return names;
}

std::vector<std::string> command_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* inner : command.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(inner->get_name());
    }
    return names;
}

// What is wrong with a word that no command or option takes.
std::string about_extra(const CLI::App& command, const std::string& word) {
    const std::string name = printable(word.substr(0, word.find('=')), 40);
    const bool is_option = name.size() > 1 && name.front() == '-';
    const std::vector<std::string> names =
        is_option ? option_names(command) : command_names(command);
    const std::vector<std::string_view> known(names.begin(), names.end());
    if (!is_option) {
        return known.empty() ? "\"" + name + "\" is a word too many"
                             : unknown_name("command", name, known);
    }
    // Of options there are too many to list.
    const std::string_view nearest =
        nearest_name(name.substr(std::min(name.find_first_not_of('-'), name.size())), known);
    const std::string hint =
        nearest.empty() ? "" : "; did you mean \"--" + std::string(nearest) + "\"?";
    return "option \"" + name + "\" is unknown" + hint;
}

// The message of a parse error, with the command whose help explains more.
std::string about(const CLI::App& app, const CLI::Error& error) {
    const std::vector<const CLI::App*> chosen = chosen_commands(app);
    std::string what = error.what();
    const std::vector<std::string> extras = app.remaining(true);
    // CLI11 reports a misspelt command as a missing one: the word that was left over explains it
    // better.
    const bool is_of_words = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                             dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    if (is_of_words && !extras.empty()) {
        what = about_extra(*chosen.back(), extras.front());
    }
    std::string names;
    for (const CLI::App* command : chosen) {
        names += command->get_name() + " ";
    }
    return printable(what) + " (" + names + "--help shows what there is)";
}

}  // namespace

std::optional<int> read_usage(CLI::App& app, int argc, char** argv) {
    app.failure_message([](const CLI::App* program, const CLI::Error& error) {
        return "raks: " + about(*program, error) + "\n";
    });
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // Help and version are "errors" with exit code 0.
        return app.exit(error) == 0 ? kExitDone : kExitUsage;
    }
    return std::nullopt;
}

namespace {

// An error after a signal still ends with the signal's code: the signal was the cause.
int report(const std::string& message) {
    complain(message);
    return exit_code_after_signals(kExitFailed);
}

// Flushes what was printed. A write that fails (a full disk behind stdout) makes the command fail;
// EPIPE does not, as the reader has seen enough.
int end_with(int code) {
    const bool was_printed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (code == kExitDone && !was_printed && errno != EPIPE) {
        return report("standard output cannot be written: " +
                      std::generic_category().message(errno));
    }
    return exit_code_after_signals(code);
}

}  // namespace

namespace {

// An exception on another thread, or where none may be thrown: as a rule there is no memory left.
[[noreturn]] void end_by_exception() noexcept {
    const char* reason = "raks: internal error\n";
    try {
        if (const auto problem = std::current_exception()) {
            std::rethrow_exception(problem);
        }
    } catch (const std::bad_alloc&) {
        reason = "raks: out of memory\n";
    } catch (...) {  // nothing that needs memory is safe here
    }
    [[maybe_unused]] const auto written =
        ::write(descriptor_of_lines(), reason, std::strlen(reason));
    ::_exit(kExitFailed);
}

}  // namespace

namespace {

std::atomic<bool> g_has_come_back{false};  // what was to run has ended
std::atomic<int> g_signal{0};
std::atomic<int> g_ends_at_once{0};
static_assert(std::atomic<int>::is_always_lock_free, "used inside a signal handler");

// Posted by each signal; never destroyed, as a handler may run until the last moment.
sem_t g_signals;

// Only what a handler may do. A second signal, or one while nothing is kept, does not wait.
extern "C" void note_signal(int number) {
    g_signal.store(number, std::memory_order_relaxed);  // relaxed: a flag that orders nothing
    sem_post(&g_signals);
    if (g_ends_at_once.load(std::memory_order_relaxed) > 0) {  // relaxed: likewise
        sem_post(&g_signals);
    }
}

void wait_for_signal(const timespec* until) {
    while ((until != nullptr ? sem_clockwait(&g_signals, CLOCK_MONOTONIC, until)
                             : sem_wait(&g_signals)) != 0 &&
           errno == EINTR) {
    }
}

// Leaves nothing half-written, and says where what is kept lies.
[[noreturn]] void end_now() {
    const EndOfWriting end = remove_pending_files();
    for (const std::filesystem::path& part : end.kept) {
        complain("stopped before it was finished: what was made lies in " + part.string());
    }
    _exit(exit_code_after_signals(kExitFailed));
}

// A command has so long to end by itself after a signal; then the process ends, and leaves nothing
// half-written. Runs on a thread of its own.
void end_in_time() {
    wait_for_signal(nullptr);
    timespec until{};
    clock_gettime(CLOCK_MONOTONIC, &until);
    constexpr long kSecond = 1'000'000'000;
    constexpr long kPatience = 700'000'000;
    until.tv_sec += (until.tv_nsec + kPatience) / kSecond;
    until.tv_nsec = (until.tv_nsec + kPatience) % kSecond;
    wait_for_signal(&until);
    end_now();
}

// Whether a line has said why the process ends: one is enough, as threads that go on meanwhile may
// have faults of the same cause.
std::atomic<bool> g_end_is_said{false};
static_assert(std::atomic<bool>::is_always_lock_free, "handlers of signals use it");

// Whether as much as the largest picture needs cannot be had any more.
bool is_memory_short() noexcept {
    constexpr std::size_t kMuch = std::size_t{256} << 20U;
    void* const much =
        ::mmap(nullptr, kMuch, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (much == MAP_FAILED) {
        return true;
    }
    ::munmap(much, kMuch);
    return false;
}

// A fault of ours, or of a library that does not look whether it got the memory that it asked for,
// as drivers of graphics do: then the work has failed. One line in place of silence. Only what a
// handler may do; the signal of another fault then ends the process as it would have.
extern "C" void say_fault(int number) {
    if (g_end_is_said.exchange(true)) {
        _exit(kExitFailed);
    }
    if (is_memory_short()) {
        constexpr std::string_view kLine = "raks: out of memory, in a library\n";
        [[maybe_unused]] const auto written =
            ::write(descriptor_of_lines(), kLine.data(), kLine.size());
        _exit(kExitFailed);
    }
    const char* const line =
        number == SIGABRT
            ? "raks: a library gave up; with -v it says why\n"
            : "raks: ended by a fault in the program or a library, or there is no memory left\n";
    [[maybe_unused]] const auto written = ::write(descriptor_of_lines(), line, std::strlen(line));
    std::raise(number);
}

// Sanitizers have handlers of their own, which stay. The main thread's stack may be what is used
// up.
void catch_faults() noexcept {
    static std::array<std::byte, 16'384> spare{};
    const stack_t stack{.ss_sp = spare.data(), .ss_flags = 0, .ss_size = spare.size()};
    sigaltstack(&stack, nullptr);
    for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
        struct sigaction action {};
        if (sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_DFL) {
            action.sa_handler = say_fault;
            action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER | SA_ONSTACK);
            sigaction(number, &action, nullptr);
        }
    }
}

// Xlib ends a program by exit() when its display is gone: nothing comes back to run_program().
void end_by_library() {
    if (g_has_come_back.load(std::memory_order_relaxed)) {  // relaxed: orders nothing
        return;
    }
    if (!g_end_is_said.exchange(true)) {
        complain("a library ended the program: as a rule its display is gone; with -v it says why");
    }
    end_now();
}

// SIGXFSZ and SIGPIPE are ignored, so that the write that caused them fails with an error that is
// reported. Starts a thread.
void catch_signals() noexcept {
    sem_init(&g_signals, 0, 0);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        std::signal(number, note_signal);
    }
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    catch_faults();
    std::atexit(end_by_library);
    // Its end is the process's.
    std::thread(end_in_time).detach();
}

}  // namespace

// The outermost frame: no exception leaves the program as a crash.
int run_program(const std::function<ParsedCommand()>& parse) {
    std::set_terminate(end_by_exception);
    // What Mesa prints would stand between our lines, which say the same.
    ::setenv("EGL_LOG_LEVEL", "fatal", 0);  // NOLINT(concurrency-mt-unsafe): no other thread yet
    try {
        const ParsedCommand command = parse();
        if (!command.run) {
            return end_with(command.exit_code);
        }
        // Only now: parsing ends as usual.
        catch_signals();
        const ExitCode code = command.run();
        g_has_come_back.store(true, std::memory_order_relaxed);  // relaxed: orders nothing
        if (is_any_child_uncaged()) {
            say_detail(
                "filters of system calls (seccomp) are refused here: what others made is read by "
                "children with limits alone");
        }
        return code ? end_with(*code) : report(code.error().message);
    } catch (const std::bad_alloc&) {
        g_has_come_back.store(true, std::memory_order_relaxed);  // relaxed: as above
        return report("out of memory");
    } catch (const std::exception& error) {
        g_has_come_back.store(true, std::memory_order_relaxed);  // relaxed: as above
        return report(std::string("internal error: ") + error.what());
    }
}

EndAtOnceOnSignals::EndAtOnceOnSignals() noexcept {
    g_ends_at_once.fetch_add(1, std::memory_order_relaxed);  // relaxed: a flag that orders nothing
    if (const auto number = stop_signal()) {
        _exit(128 + *number);
    }
}

EndAtOnceOnSignals::~EndAtOnceOnSignals() {
    g_ends_at_once.fetch_sub(1, std::memory_order_relaxed);  // relaxed: likewise
}

std::optional<int> stop_signal() noexcept {
    const int number = g_signal.load(std::memory_order_relaxed);  // relaxed: see note_signal
    return number == 0 ? std::nullopt : std::optional(number);
}

// The convention of shells for a process that a signal ended.
int exit_code_after_signals(int code) noexcept {
    const std::optional<int> number = stop_signal();
    return number ? 128 + *number : code;
}

}  // namespace raks::apps
