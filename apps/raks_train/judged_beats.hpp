#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "audio/beat/network/beat_network.hpp"
#include "base/expected.hpp"
#include "training/beat/train_confidence.hpp"

namespace raks::apps {

/// Tracks the music of folders of annotated music (load_beat_corpus) and says of each beat that is
/// announced from 5 s on whether it is right. Errors: those of the folders and of their sound.
[[nodiscard]] Expected<std::vector<audio::JudgedBeat>> judge_beats_of(
    std::span<const std::filesystem::path> folders,
    const std::shared_ptr<const audio::BeatNetwork>& network);

}  // namespace raks::apps
