#pragma once

#include <filesystem>

#include "base/time.hpp"
#include "engine/live/live_graph.hpp"
#include "engine/offline/song_planner.hpp"

namespace raks::apps {

/// The start of a song in `play`: it is held back in silence while its plan will come soon; else it
/// begins as it comes, and its plan is taken over later. Then the plan of the next song is begun.
/// Threads: main.
class SongStart {
 public:
    /// Begins to plan `file`, and holds the first sample back for at most `patience`. `next`: what
    /// plays after it, or empty. `planner` must outlive this.
    SongStart(engine::SongPlanner& planner,
              std::filesystem::path file,
              std::filesystem::path next,
              Nanos patience);

    /// Looks at the work; call it with every picture, with the graph that plays the song.
    void look(engine::LiveGraph& graph);

 private:
    void let_go(engine::LiveGraph& graph);

    engine::SongPlanner* planner_;
    std::filesystem::path file_;
    std::filesystem::path next_;
    HostTime deadline_;
    bool has_begun_ = false;   // it sounds
    bool is_planned_ = false;  // or will not be
};

}  // namespace raks::apps
