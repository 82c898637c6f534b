#include "engine/live/tagger_thread.hpp"

#include <pthread.h>

#include <utility>

#include "base/sleep_until.hpp"
#include "base/thread_priority.hpp"
#include "engine/live/clock_map.hpp"

namespace raks::engine {
namespace {

constexpr const char* kTaggerThreadName = "raks-tagger";
// Nobody wakes the thread, as that would be a system call of the one who hears.
constexpr Nanos kTaggerRest = std::chrono::milliseconds(50);

}  // namespace

TaggerThread::TaggerThread(std::shared_ptr<const audio::TaggerNetwork> network)
    : tagger_(std::move(network)), thread_([this] { run(); }) {}

TaggerThread::~TaggerThread() {
    // relaxed: a wish, it orders nothing.
    is_stopping_.store(true, std::memory_order_relaxed);
    thread_.join();
}

void TaggerThread::hear(const audio::TaggerHop& hop) noexcept RAKS_NONBLOCKING {
    if (!has_jumped_) {
        has_jumped_ = !hops_.push(hop) && hop.is_other_music;
        return;
    }
    // The jump that found no room is told with the next hop that does.
    audio::TaggerHop jump = hop;
    jump.is_other_music = true;
    has_jumped_ = !hops_.push(jump);
}

void TaggerThread::run() noexcept {
    pthread_setname_np(pthread_self(), kTaggerThreadName);
    put_threads_behind(kTaggerThreadName);
    while (!is_stopping_.load(std::memory_order_relaxed)) {  // relaxed: see the destructor
        take_hops();
        sleep_until(host_now() + kTaggerRest);
    }
}

void TaggerThread::take_hops() noexcept {
    while (!is_stopping_.load(std::memory_order_relaxed) && hops_.pop(hop_)) {
        const audio::TaggerWord& word = tagger_.word();
        const auto before = std::pair(word.patches, word.until);
        tagger_.hear(hop_);
        if (before != std::pair(word.patches, word.until)) {
            words_.write(word);
        }
    }
}

}  // namespace raks::engine
