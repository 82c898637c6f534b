#pragma once

#include <filesystem>

#include "audio/beat/training/corpus.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// Writes the pieces that have beats into `folder` (made, if need be), as load_beat_corpus reads
/// them: index.tsv (its class is the family), and for each piece NAME.wav and NAME.beats. So that
/// trackers are judged by music that nothing was learnt from: another seed, other soundfonts.
/// Errors: as make_pieces; the folder is there and not empty, or cannot be written.
[[nodiscard]] Expected<void> write_music_folder(const CorpusPlan& plan,
                                                const std::filesystem::path& folder);

}  // namespace raks::audio
