#pragma once

#include <functional>
#include <vector>

#include "audio/io/audio_file_backends.hpp"

namespace raks::audio {

/// Opens one stream of a chained file; the number is its place among the links.
using OpenLink = std::function<Expected<AudioFileReaderPtr>(const DecoderInput&, std::size_t)>;

/// Streams that lie one behind the other in a file, as one sound with rate and channels of the
/// first. Of each stream exactly as many frames are given as it claims (where fewer can be decoded,
/// silence takes their place), so that seeking is exact; one that does not claim a length is
/// decoded once to count them. A stream that cannot be opened is left out, and warning() says so.
/// One stream is open at a time. Errors: none of them can be opened (the first one's reason).
/// Threads: one at a time. Real-time: no.
[[nodiscard]] Expected<AudioFileReaderPtr> open_chain(const std::vector<DecoderInput>& links,
                                                      const OpenLink& open);

}  // namespace raks::audio
