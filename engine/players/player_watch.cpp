#include "engine/players/player_watch.hpp"

#include <poll.h>
#include <sys/eventfd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <ctime>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/descriptor.hpp"
#include "engine/players/player_bus.hpp"

namespace raks::engine {
namespace {

constexpr Nanos kLooksAgainAfter = std::chrono::seconds(10);
// More than so many messages, or so much work on them, within a second is a flood.
constexpr int kMostMessages = 500;
constexpr Nanos kMostWork = std::chrono::milliseconds(200);

Nanos work_of_this_thread() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return std::chrono::seconds(time.tv_sec) + Nanos(time.tv_nsec);
}

// Counts what comes within each second.
class FloodGauge {
 public:
    // One message more. Whether it is too much.
    [[nodiscard]] bool takes(HostTime now) {
        if (now - since_ >= std::chrono::seconds(1)) {
            since_ = now;
            messages_ = 0;
            work_ = work_of_this_thread();
        }
        return ++messages_ > kMostMessages || work_of_this_thread() - work_ > kMostWork;
    }

 private:
    HostTime since_{};
    int messages_ = 0;
    Nanos work_{};
};

}  // namespace

struct PlayerWatch::Impl {
    Impl() : wake(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), thread([this] { run(); }) {}
    ~Impl() {
        is_stopping = true;
        eventfd_write(wake.number, 1);
        thread.join();
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void run() noexcept;
    [[nodiscard]] std::string listen();
    void sleep(const PlayerBus::Wait& wait) const;
    void pass_on(PlayerList& list);
    void say(const std::string& line);

    Descriptor wake;
    std::atomic<bool> is_stopping{false};
    std::mutex mutex;  // of the two below
    std::vector<PlayerEvent> events;
    std::vector<std::string> lines;
    std::string said;    // the last line: it is not said twice
    std::thread thread;  // last: it uses all of the others
};

// Why the bus was left is said once, and again when it is another reason.
void PlayerWatch::Impl::run() noexcept {
    while (!is_stopping) {
        const std::string why = listen();
        if (!is_stopping) {
            say("--now-playing: " + why + "; it is tried again every 10 s");
            sleep({-1, 0, host_now() + kLooksAgainAfter});
        }
    }
}

// Until the end, or until the bus is left; returns why.
std::string PlayerWatch::Impl::listen() {
    PlayerList list;
    FloodGauge flood;
    std::string why;
    {
        PlayerBus bus(list);
        if (const auto opened = bus.open(); !opened) {
            return opened.error().message;
        }
        while (!is_stopping && why.empty()) {
            const HostTime now = host_now();
            const auto has_more = bus.turn(now);
            pass_on(list);
            if (!has_more) {
                why = has_more.error().message;
            } else if (*has_more && flood.takes(now)) {
                why = "players send too much";
            } else if (!*has_more) {
                sleep(bus.wait());
            }
        }
    }
    // Nobody is known any more.
    if (list.now().status == PlayStatus::playing) {
        const std::lock_guard lock(mutex);
        events.push_back({PlayerEvent::Kind::told, {}});
    }
    return why;
}

void PlayerWatch::Impl::sleep(const PlayerBus::Wait& wait) const {
    std::array<pollfd, 2> files = {{{wake.number, POLLIN, 0}, {wait.file, wait.events, 0}}};
    timespec patience{};
    if (wait.until) {
        const Nanos left = std::max(*wait.until - host_now(), Nanos(0));
        patience.tv_sec = std::chrono::duration_cast<std::chrono::seconds>(left).count();
        patience.tv_nsec = (left % std::chrono::seconds(1)).count();
    }
    ppoll(files.data(), files.size(), wait.until ? &patience : nullptr, nullptr);
}

// Who does not fetch them loses the oldest.
void PlayerWatch::Impl::pass_on(PlayerList& list) {
    std::vector<PlayerEvent> news = list.take_events();
    if (news.empty()) {
        return;
    }
    const std::lock_guard lock(mutex);
    for (PlayerEvent& event : news) {
        if (events.size() == PlayerList::kMostEvents) {
            events.erase(events.begin());
        }
        events.push_back(std::move(event));
    }
}

void PlayerWatch::Impl::say(const std::string& line) {
    if (line != said) {
        said = line;
        const std::lock_guard lock(mutex);
        lines.push_back(line);
    }
}

bool PlayerWatch::is_built() noexcept { return true; }

std::unique_ptr<PlayerWatch> PlayerWatch::open() {
    return std::unique_ptr<PlayerWatch>(new PlayerWatch(std::make_unique<Impl>()));
}

PlayerWatch::PlayerWatch(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
PlayerWatch::~PlayerWatch() = default;

std::vector<PlayerEvent> PlayerWatch::take_events() {
    const std::lock_guard lock(impl_->mutex);
    return std::exchange(impl_->events, {});
}

std::vector<std::string> PlayerWatch::take_lines() {
    const std::lock_guard lock(impl_->mutex);
    return std::exchange(impl_->lines, {});
}

}  // namespace raks::engine
