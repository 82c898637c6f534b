#include "audio/io/ffmpeg_tags.hpp"

#include <array>
#include <string_view>

#include "audio/io/ffmpeg_window.hpp"

namespace raks::audio {
namespace {

// What tags are called in the formats that FFmpeg reads, the better names first. FFmpeg looks for
// them without regard to case.
struct TagName {
    std::string_view tag;
    const char* name;
};
constexpr std::array<TagName, 11> kNames = {{{"title", "title"},
                                             {"artist", "artist"},
                                             {"artist", "album_artist"},
                                             {"artist", "author"},
                                             {"album", "album"},
                                             {"genre", "genre"},
                                             {"bpm", "bpm"},
                                             {"bpm", "TBPM"},
                                             {"bpm", "tempo"},
                                             {"bpm", "tmpo"},
                                             {"bpm", "WM/BeatsPerMinute"}}};

// Of what libsndfile decodes, those containers that hold tags.
constexpr const char* kTaggedFormats = "wav,w64,aiff,caf,flac,ogg";

void take_tags(const AVDictionary* entries, AudioTags& tags) {
    for (const TagName& known : kNames) {
        if (const AVDictionaryEntry* found = av_dict_get(entries, known.name, nullptr, 0)) {
            set_tag(tags, known.tag, found->value);
        }
    }
}

}  // namespace

AudioTags tags_of(const AVFormatContext& container, const AVStream& stream) {
    AudioTags tags;
    take_tags(container.metadata, tags);
    take_tags(stream.metadata, tags);
    return tags;
}

AudioTags read_tags(const FileWindow& window) {
    av_log_set_level(AV_LOG_QUIET);
    WindowCursor cursor{window};
    const FfmpegHandle<AVIOContext> bytes = read_through(cursor);
    AVFormatContext* context = bytes != nullptr ? avformat_alloc_context() : nullptr;
    if (context == nullptr) {
        return {};
    }
    context->pb = bytes.get();
    AVDictionary* options = nullptr;
    av_dict_set(&options, "format_whitelist", kTaggedFormats, 0);
    const int error = avformat_open_input(&context, nullptr, nullptr, &options);
    av_dict_free(&options);
    const FfmpegHandle<AVFormatContext> container(context);  // null after an error
    return error < 0 || container->nb_streams == 0 ? AudioTags()
                                                   : tags_of(*container, *container->streams[0]);
}

}  // namespace raks::audio
