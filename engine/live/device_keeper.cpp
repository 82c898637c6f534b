#include "engine/live/device_keeper.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "audio/io/pulse_devices.hpp"

namespace raks::engine {
namespace {

using audio::AudioDevice;
using Direction = audio::DeviceStream::Direction;

constexpr std::chrono::milliseconds kTryAgain(200);
// PipeWire tells of another default before it says which: it is asked again, at this distance.
constexpr int kLooks = 3;
constexpr std::chrono::milliseconds kLookAgain(150);
// A server moves an output by itself when the default changes; it gets so long to do it.
constexpr std::chrono::milliseconds kServerMoves(150);

bool can(const AudioDevice& device, Direction direction) {
    return (direction == Direction::input ? device.input_channels : device.output_channels) > 0;
}

}  // namespace

DeviceKeeper::DeviceKeeper(const Plan& plan, AudioDevice current)
    : plan_(plan),
      system_(current.system),
      chosen_(current.id),
      current_(std::move(current.id)),
      thread_([this] { run(); }) {}

DeviceKeeper::~DeviceKeeper() {
    {
        const std::lock_guard lock(mutex_);
        is_stopping_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void DeviceKeeper::look() {
    const std::lock_guard lock(mutex_);
    jobs_.looks = kLooks;
    wake_.notify_one();
}

void DeviceKeeper::note_move(const std::string& id) {
    const std::lock_guard lock(mutex_);
    jobs_.moved = id;
    current_ = id;
    wake_.notify_one();
}

void DeviceKeeper::reopen() {
    const std::lock_guard lock(mutex_);
    jobs_.reopens = true;
    wake_.notify_one();
}

void DeviceKeeper::listen_around() {
    const std::lock_guard lock(mutex_);
    jobs_.listens = true;
    wake_.notify_one();
}

void DeviceKeeper::close_later(std::unique_ptr<audio::DeviceStream> stream) {
    const std::lock_guard lock(mutex_);
    jobs_.to_close.push_back(std::move(stream));
    wake_.notify_one();
}

std::optional<DeviceKeeper::News> DeviceKeeper::take() {
    const std::lock_guard lock(mutex_);
    if (news_.empty()) {
        return std::nullopt;
    }
    News news = std::move(news_.front());
    news_.pop_front();
    if (news.kind == News::Kind::opened) {
        current_ = news.device.id;
    }
    return news;
}

void DeviceKeeper::tell(News news) {
    const std::lock_guard lock(mutex_);
    news_.push_back(std::move(news));
}

std::string DeviceKeeper::current_id() {
    const std::lock_guard lock(mutex_);
    return current_;
}

// Under the mutex.
bool DeviceKeeper::is_urgent() const noexcept {
    return is_stopping_ || jobs_.reopens || jobs_.listens || jobs_.moved || !jobs_.to_close.empty();
}

// After a pause, unless something more urgent comes.
void DeviceKeeper::look_again(int times) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, kLookAgain, [this] { return is_urgent(); });
    jobs_.looks = std::max(jobs_.looks, times);
}

// Waits for work; nothing at the end. The jobs are taken out, so that new ones can come meanwhile.
std::optional<DeviceKeeper::Jobs> DeviceKeeper::next_jobs() {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return is_urgent() || jobs_.looks > 0; });
    if (is_stopping_) {
        return std::nullopt;
    }
    return std::exchange(jobs_, Jobs{});
}

void DeviceKeeper::run() {
    while (auto jobs = next_jobs()) {
        // First: a device may refuse a second stream.
        jobs->to_close.clear();
        if (jobs->moved) {
            name_moved(*jobs->moved);
        }
        if (jobs->reopens) {
            if (!try_to_reopen()) {
                std::unique_lock lock(mutex_);
                jobs_.reopens = true;
                wake_.wait_for(lock, kTryAgain, [this] { return is_stopping_; });
            }
        } else if (jobs->looks > 0) {
            follow();
        }
        if (jobs->listens) {
            if (auto device = audio::other_monitor_with_sound(current_id())) {
                tell({.kind = News::Kind::elsewhere, .device = std::move(*device), .stream = {}});
            }
        }
        if (jobs->looks > 1) {
            look_again(jobs->looks - 1);
        }
    }
}

// Empty while the server is away.
std::vector<AudioDevice> DeviceKeeper::devices() const {
    const auto system = audio::AudioSystem::open(system_);
    return system ? system->devices() : std::vector<AudioDevice>();
}

// The device that should be open: the person's, or our choice among `devices` as they are now.
std::optional<AudioDevice> DeviceKeeper::wanted(const std::vector<AudioDevice>& devices) {
    const std::string current = current_id();
    const auto same = std::find_if(devices.begin(), devices.end(), [&](const AudioDevice& device) {
        return device.id == current && can(device, plan_.direction);
    });
    if (!plan_.is_named) {
        const bool is_input = plan_.direction == Direction::input;
        const auto choice = is_input ? audio::choose_input(devices) : audio::choose_output(devices);
        if (choice && (!is_input || choice->device.is_monitor || choice->device.id == current)) {
            return choice->device;
        }
    }
    return same == devices.end() ? std::nullopt : std::optional(*same);
}

bool DeviceKeeper::open(const AudioDevice& device) {
    audio::StreamConfig config = plan_.config;
    config.stays = plan_.is_named;
    auto stream = audio::DeviceStream::open(plan_.direction, device, config);
    if (!stream) {
        return false;
    }
    chosen_ = device.id;
    tell({.kind = News::Kind::opened, .device = device, .stream = std::move(*stream)});
    return true;
}

bool DeviceKeeper::try_to_reopen() {
    const auto device = wanted(devices());
    return device && open(*device);
}

// Only a change of our own choice is followed: a person may have moved the stream elsewhere.
void DeviceKeeper::follow() {
    if (plan_.is_named) {
        return;
    }
    const auto device = wanted(devices());
    if (!device || device->id == chosen_) {
        return;
    }
    if (plan_.direction == Direction::output) {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, kServerMoves, [&] { return is_stopping_ || current_ == device->id; });
    }
    // A stream that could not be opened now may be at the next look.
    if (current_id() == device->id || open(*device)) {
        chosen_ = device->id;
    }
}

void DeviceKeeper::name_moved(const std::string& id) {
    const std::vector<AudioDevice> all = devices();
    const auto found = std::find_if(
        all.begin(), all.end(), [&](const AudioDevice& device) { return device.id == id; });
    if (found != all.end()) {
        tell({.kind = News::Kind::moved, .device = *found, .stream = {}});
    }
}

}  // namespace raks::engine
