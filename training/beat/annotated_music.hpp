#pragma once

#include <filesystem>

#include "base/expected.hpp"
#include "training/beat/corpus.hpp"

namespace raks::audio {

/// Writes the pieces that have beats into a new folder, as load_beat_corpus reads them: index.tsv
/// (its class is the family), and for each piece NAME.wav and NAME.beats; all or nothing. So that
/// trackers are judged by music that nothing was learnt from: another seed, other soundfonts.
/// Errors: as make_pieces and PendingFile::create_folder.
[[nodiscard]] Expected<void> write_music_folder(const CorpusPlan& plan,
                                                const std::filesystem::path& folder);

}  // namespace raks::audio
