#include "engine/live/motion_stage.hpp"

#include <algorithm>
#include <utility>

#include "base/assert.hpp"
#include "base/realtime.hpp"
#include "base/sleep_until.hpp"

namespace raks::engine {

namespace {

FeedFigure figure_of(const motion::DancerStatus& dancer) noexcept {
    return dancer.is_dancing ? FeedFigure{dancer.figure, dancer.counts, dancer.dance}
                             : FeedFigure{};
}

}  // namespace

MotionStage::MotionStage(motion::Ensemble dancers, Wiring wiring)
    : dancers_(std::make_unique<motion::Ensemble>(std::move(dancers))),
      wiring_(std::move(wiring)),
      stage_(std::make_unique<StageState>()) {
    take_places();
    // What is seen until the music begins.
    dancers_->stand_ready(stage_->tracks);
    publish();
    for (motion::PoseTrack& track : stage_->tracks) {
        track.clear();
    }
}

void MotionStage::take_places() noexcept {
    stage_->dancers = dancers_->size();
    std::copy(dancers_->places().begin(), dancers_->places().end(), stage_->places.begin());
}

void MotionStage::publish() noexcept {
    for (StageChannel* const reader : wiring_.readers) {
        reader->write_with([this](StageState& slot) { slot.copy_used(*stage_); });
    }
    if (wiring_.feed != nullptr) {
        wiring_.feed->show(*stage_);
    }
}

MotionStage::~MotionStage() {
    // The queue holds raw pointers: what nobody will take is freed here.
    Order order;
    while (orders_.pop(order)) {  // nobody ticks any more
        const std::unique_ptr<motion::Ensemble> never_danced(order.dancers);
    }
}

bool MotionStage::command(const motion::DancerCommand& command) noexcept {
    return orders_.push({.command = command});
}

// Dancers who left are freed on this thread, since the motion thread must not free.
bool MotionStage::replace(motion::Ensemble dancers, Entry entry) {
    left_.collect();
    auto next = std::make_unique<motion::Ensemble>(std::move(dancers));
    if (!orders_.push({.dancers = next.get(), .entry = entry})) {
        return false;
    }
    // The queue owns the dancers from here on.
    static_cast<void>(next.release());
    return true;
}

void MotionStage::obey(const Order& order) noexcept RAKS_NONBLOCKING {
    if (order.dancers == nullptr) {
        dancers_->command(order.command);
        return;
    }
    if (order.entry == Entry::onward) {
        order.dancers->go_on_from(*dancers_);
    }
    // The dancers before go to the retire queue, which main empties: freeing would block this
    // thread.
    const bool has_room = left_.retire(dancers_);
    RAKS_ASSERT(has_room);
    static_cast<void>(has_room);
    // Empty now, so nothing is freed.
    RAKS_TRUSTED(dancers_.reset(order.dancers));
    take_places();
    if (order.entry == Entry::onward) {
        return;
    }
    // Old poses would be interpolated into those of the new dancers.
    for (motion::PoseTrack& track : stage_->tracks) {
        track.clear();
    }
}

void MotionStage::tick() noexcept RAKS_NONBLOCKING {
    // Subnormal numbers are slow on the processor.
    const FlushToZeroScope flush_to_zero;
    Order order;
    // Orders first: replaced dancers must not dance one more hop.
    while (orders_.pop(order)) {
        obey(order);
    }
    bool has_danced = false;
    // Usually one state; after a late wake-up several, danced in order so that the result does not
    // depend on timing.
    const std::size_t held_back = held_back_.load(std::memory_order_relaxed);
    while (wiring_.states.size() > held_back && wiring_.states.pop(stage_->music)) {
        dancers_->advance(stage_->music, stage_->tracks);
        stage_->recent[static_cast<std::size_t>(stage_->music.hop) % StageState::kRecent] =
            stage_->music;
        stage_->dancer = dancers_->status();
        if (wiring_.feed != nullptr) {
            wiring_.feed->tell({stage_->music, figure_of(stage_->dancer)});
        }
        const bool is_recorded =
            wiring_.record == nullptr ||
            wiring_.record->push({stage_->music.hop, stage_->track().at_hop(stage_->music.hop)});
        // release: pairs with the acquire in danced_hops(): the record is there when it is counted.
        danced_hops_.fetch_add(is_recorded ? 1 : 0, std::memory_order_release);
        has_danced = true;
    }
    // One copy a reader and wake-up, however many hops were danced.
    if (has_danced) {
        stage_->published_at_ns = host_now().time_since_epoch().count();
        publish();
    }
}

namespace {

// Well under a hop (10 ms): a state waits at most this long. Between ticks the thread sleeps, 98 %
// of the time.
constexpr Nanos kNap = std::chrono::milliseconds(2);

}  // namespace

MotionThread::MotionThread(motion::Ensemble dancers, MotionStage::Wiring wiring)
    : stage_(std::move(dancers), std::move(wiring)), thread_([this] { run(); }) {}

MotionThread::~MotionThread() {
    is_stopping_.store(true, std::memory_order_relaxed);  // relaxed: join() orders the rest
    thread_.join();
}

// Naps after every tick: the stage publishes at most every 2 ms.
void MotionThread::run() noexcept {
    // Below sound, above all that is ordinary; without the right it goes on as it is.
    int below = kAnyPriority;
    prefer_this_thread(RealtimeThread::motion, below);
    while (!is_stopping_.load(std::memory_order_relaxed)) {  // relaxed: see the destructor
        // Another stream may have another priority.
        if (const int wanted = below_.load(std::memory_order_relaxed); wanted != below) {
            below = wanted;
            prefer_this_thread(RealtimeThread::motion, below);
        }
        stage_.tick();
        sleep_until(host_now() + kNap);
    }
}

}  // namespace raks::engine
