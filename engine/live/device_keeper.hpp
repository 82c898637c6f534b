#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "audio/io/device_stream.hpp"
#include "audio/io/devices.hpp"

namespace raks::engine {

/// Finds and opens devices while a show runs, on a thread of its own, as servers may let one wait:
/// another default to follow, a device that comes back, another monitor that has sound. It says
/// what it found; whoever owns it decides.
///
/// What counts as the same device is its id, in the same audio system. A person's choice is only
/// waited for. A choice of ours follows the default; but an input goes to a monitor or back to
/// where it was, never to another microphone.
/// Threads: main for all methods. Real-time: no.
class DeviceKeeper {
 public:
    /// What is kept.
    struct Plan {
        audio::DeviceStream::Direction direction = audio::DeviceStream::Direction::input;
        bool is_named = false;  ///< the person chose the device, not we
        audio::StreamConfig config = {};
    };
    /// What was found.
    struct News {
        /// What it is about.
        enum class Kind {
            opened,    ///< `stream` of `device` runs and is to take over
            moved,     ///< the server moved our stream to `device`
            elsewhere  ///< `device`, another monitor, has sound
        };
        Kind kind = Kind::opened;                     ///< what it is about
        audio::AudioDevice device = {};               ///< which device
        std::unique_ptr<audio::DeviceStream> stream;  ///< of `opened`
    };

    /// `current`: the device whose stream runs now.
    DeviceKeeper(const Plan& plan, audio::AudioDevice current);
    ~DeviceKeeper();  ///< waits for the thread: 2 s at most
    /// Not copied: the thread holds a reference to it.
    DeviceKeeper(const DeviceKeeper&) = delete;
    DeviceKeeper& operator=(const DeviceKeeper&) = delete;  ///< likewise

    /// Devices or the default changed: opens what is to be followed, if anything.
    void look();
    /// The server moved the stream to the device with this id.
    void note_move(const std::string& id);
    /// The device is gone: tries to open it, or what is to be followed, until it succeeds.
    void reopen();
    /// Looks for another monitor that has sound.
    void listen_around();
    /// Closes a stream, which may take a second.
    void close_later(std::unique_ptr<audio::DeviceStream> stream);

    /// What was found, oldest first; nothing when there is no more. `opened` makes its device the
    /// current one.
    [[nodiscard]] std::optional<News> take();

 private:
    struct Jobs {
        int looks = 0;  // how often still
        bool reopens = false;
        bool listens = false;
        std::optional<std::string> moved = {};
        std::vector<std::unique_ptr<audio::DeviceStream>> to_close = {};
    };

    void run();
    [[nodiscard]] std::optional<Jobs> next_jobs();
    [[nodiscard]] bool is_urgent() const noexcept;
    void look_again(int times);
    [[nodiscard]] std::string current_id();
    void follow();
    void name_moved(const std::string& id);
    [[nodiscard]] bool try_to_reopen();
    [[nodiscard]] std::vector<audio::AudioDevice> devices() const;
    [[nodiscard]] std::optional<audio::AudioDevice> wanted(
        const std::vector<audio::AudioDevice>& devices);
    [[nodiscard]] bool open(const audio::AudioDevice& device);
    void tell(News news);

    const Plan plan_;
    const audio::AudioSystemKind system_;
    std::string chosen_;  // id of our own choice; the thread's
    std::mutex mutex_;    // for all below
    std::condition_variable wake_;
    Jobs jobs_;
    std::string current_;
    std::deque<News> news_;
    bool is_stopping_ = false;
    std::thread thread_;
};

}  // namespace raks::engine
