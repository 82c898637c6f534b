#include "engine/live/motion_stage.hpp"

#include <utility>

#include "base/realtime.hpp"

namespace raks::engine {

MotionStage::MotionStage(motion::Ensemble dancers,
                         EventQueue<MusicState>& states,
                         EventQueue<DancedHop>* record)
    : dancers_(std::move(dancers)),
      states_(states),
      record_(record),
      commands_(64),
      stage_(std::make_unique<StageState>()) {
    stage_->dancers = dancers_.size();
}

void MotionStage::tick() noexcept {
    const FlushToZeroScope flush_to_zero;
    motion::DancerCommand command{};
    while (commands_.pop(command)) {
        dancers_.command(command);
    }
    bool has_danced = false;
    while (states_.pop(stage_->music)) {
        dancers_.advance(stage_->music, stage_->tracks);
        stage_->dancer = dancers_.status();
        if (record_ != nullptr) {
            record_->push({stage_->music.hop, stage_->track().at_hop(stage_->music.hop)});
        }
        // release: pairs with the acquire in danced_hops(): the record is there when it is counted.
        danced_hops_.fetch_add(1, std::memory_order_release);
        has_danced = true;
    }
    if (has_danced) {
        stage_->published_at_ns = HostClock::now().time_since_epoch().count();
        published_.write(*stage_);
    }
}

}  // namespace raks::engine
