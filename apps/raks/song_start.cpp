#include "apps/raks/song_start.hpp"

#include <utility>

#include "apps/terminal/say.hpp"

namespace raks::apps {

SongStart::SongStart(engine::SongPlanner& planner,
                     std::filesystem::path file,
                     std::filesystem::path next,
                     Nanos patience)
    : planner_(&planner),
      file_(std::move(file)),
      next_(std::move(next)),
      deadline_(HostClock::now() + patience) {
    planner_->prepare(file_);
}

void SongStart::look(engine::LiveGraph& graph) {
    if (is_planned_) {
        // Again with every picture: a dance that is kept meanwhile may be of the next song, too.
        if (!next_.empty()) {
            planner_->prepare(next_);
        }
        return;
    }
    const engine::SongPlanner::Progress progress = planner_->look(file_);
    const HostTime now = HostClock::now();
    const bool comes_soon =
        progress.is_working && now < deadline_ && progress.expected.value_or(now) <= deadline_;
    if (progress.plan) {
        using Beginning = engine::PlannedStates::Beginning;
        graph.follow(progress.plan, has_begun_ ? Beginning::on_bar_line : Beginning::now);
        say_detail(has_begun_ ? "the whole song is analyzed now: from the next bar line on the "
                                "dance knows what comes"
                              : "the whole song was analyzed before it began");
    }
    is_planned_ = !progress.is_working;
    if (!comes_soon) {
        let_go(graph);
    }
}

// At the first call only: later the song has long begun.
void SongStart::let_go(engine::LiveGraph& graph) {
    if (!std::exchange(has_begun_, true)) {
        graph.playback()->let_go();
        if (!is_planned_) {
            say_detail(
                "the song begins before all of it is analyzed: until then the dance follows it as "
                "it is heard");
        }
    }
}

}  // namespace raks::apps
