#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "audio/genre/music_tagger.hpp"
#include "audio/genre/tag_source.hpp"
#include "base/channels/event_queue.hpp"
#include "base/channels/latest_value.hpp"
#include "base/realtime.hpp"

namespace raks::engine {

/// Tags the music of an analyzer on a thread of its own, at low priority: whoever hears never
/// waits, and the word comes when it comes, a tenth of a second after its patch where the computer
/// has time. Where it has not, hops are dropped and the patch that they belong to with them.
///
/// After a jump to other music the word is that of the music before for as long.
/// Threads: hear and word from one, the analyzer's; the rest from its owner. Real-time: hear and
/// word yes (wait-free).
class TaggerThread final : public audio::TagSource {
 public:
    /// Hops that wait: 5 s, which is more than a patch takes anywhere.
    static constexpr std::size_t kQueuedHops = 512;

    /// Starts the thread. `network`: not null.
    explicit TaggerThread(std::shared_ptr<const audio::TaggerNetwork> network);
    ~TaggerThread() override;                    ///< waits for the thread: for one patch at most
    TaggerThread(const TaggerThread&) = delete;  ///< not copied: the thread refers to it
    TaggerThread& operator=(const TaggerThread&) = delete;  ///< likewise

    void hear(const audio::TaggerHop& hop) noexcept RAKS_NONBLOCKING override;
    [[nodiscard]] const audio::TaggerWord& word() noexcept RAKS_NONBLOCKING override {
        return words_.read();
    }
    /// Hops that found no room. Threads: any.
    [[nodiscard]] std::uint64_t dropped() const noexcept { return hops_.dropped(); }

 private:
    void run() noexcept;
    void take_hops() noexcept;

    EventQueue<audio::TaggerHop> hops_{kQueuedHops};
    LatestValue<audio::TaggerWord> words_;
    bool has_jumped_ = false;  // the listener's: in a hop that found no room
    audio::HopTagger tagger_;  // the thread's
    audio::TaggerHop hop_;     // likewise
    std::atomic<bool> is_stopping_{false};
    std::thread thread_;
};

}  // namespace raks::engine
