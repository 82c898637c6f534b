#pragma once

#include <string>

#include "training/discovery/clip_discovery.hpp"

namespace raks::apps {

/// One self-contained HTML page of the repeats found in clips: each clip's feet over time with the
/// repeats as boxes, then each repeat (at most 60 a clip) as a strip over its beats, the body on
/// every beat or half beat and the speed of both feet. Those that `figure` is learnt from are
/// green, the others red. The same data give the same bytes. Threads: any. Real-time: no.
[[nodiscard]] std::string draw_repeats(const motion::DiscoveredClips& found,
                                       const std::string& figure);

}  // namespace raks::apps
