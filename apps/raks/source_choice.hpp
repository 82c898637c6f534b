#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/raks/play_queue.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/show/list_panel.hpp"
#include "engine/show/listed_devices.hpp"

namespace raks::apps {

/// The list of what can be listened to, what can be played to, and the files that play: two pages.
/// Devices come from a short-lived child of this program, again every 2 s while the list is open:
/// what a sound server or a driver does cannot stop the show. Threads: main.
class SourceChoice {
 public:
    /// What the show does now, and what is done when something is taken.
    struct Means {
        std::function<std::string()> input;   ///< name of the device that is listened to; or empty
        std::function<std::string()> output;  ///< likewise that is played to
        std::function<float()> level_dbfs;    ///< of what is heard now
        std::function<PlayQueue*()> queue;    ///< the files that play; null: none
        std::function<void(std::string)> listen;     ///< to the device of this name
        std::function<void(std::string)> play_on;    ///< the device of this name
        std::function<void(std::size_t)> play_file;  ///< of the queue
    };
    explicit SourceChoice(Means means) : means_(std::move(means)) {}
    ~SourceChoice();                             ///< waits for the child as long as that may take
    SourceChoice(const SourceChoice&) = delete;  ///< lists refer to it
    SourceChoice& operator=(const SourceChoice&) = delete;  ///< likewise

    static constexpr std::string_view kName = "sources";  ///< of the list
    static constexpr std::size_t kQueuePage = 1;          ///< its page of files

    /// The list. This must outlive it.
    [[nodiscard]] std::unique_ptr<engine::ListOffer> offer();

 private:
    class Offer;
    void look_around();

    Means means_;
    std::vector<engine::ListedDevice> devices_;
    std::string trouble_ = "looking for devices";
    std::future<Expected<std::vector<engine::ListedDevice>>> asking_;
    HostTime asked_{};
};

}  // namespace raks::apps
