#pragma once

#include <filesystem>

#include "base/expected.hpp"
#include "training/beat/corpus.hpp"

namespace raks::audio {

/// Writes the generated pieces that have beats into a new folder in the layout of load_beat_corpus:
/// index.tsv (its class is the family), and NAME.wav and NAME.beats for each piece. On an error
/// there is no folder. With another seed and other soundfonts than in training, trackers can be
/// evaluated on music that nothing was trained on. Errors: as make_pieces and
/// PendingFile::create_folder.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<void> write_music_folder(const CorpusPlan& plan,
                                                const std::filesystem::path& folder);

}  // namespace raks::audio
