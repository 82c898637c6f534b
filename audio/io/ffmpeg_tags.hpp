#pragma once

#include "audio/io/audio_tags.hpp"
#include "audio/io/ffmpeg_handles.hpp"
#include "audio/io/file_window.hpp"

namespace raks::audio {

/// The tags of an open container and of one of its streams: some formats keep them with the file,
/// others with the sound. Threads: any. Real-time: no.
[[nodiscard]] AudioTags tags_of(const AVFormatContext& container, const AVStream& stream);

/// The tags of a file that another library decodes, which reads fewer of them; none where FFmpeg
/// does not know the file. Threads: any. Real-time: no.
[[nodiscard]] AudioTags read_tags(const FileWindow& window);

}  // namespace raks::audio
