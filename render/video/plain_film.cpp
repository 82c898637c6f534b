// A film in fragments survives the death of its writer; a plain one is what all players and
// platforms take. The packets are the same.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/video/film_encoders.hpp"

namespace raks::render {
namespace {

struct CloseDemuxer {
    void operator()(AVFormatContext* demuxer) const noexcept { avformat_close_input(&demuxer); }
};
using DemuxerHandle = std::unique_ptr<AVFormatContext, CloseDemuxer>;

/// Errors: it cannot be read back, or has not as many tracks.
Expected<DemuxerHandle> open_fragments(const std::string& path, std::size_t tracks) {
    AVFormatContext* context = nullptr;
    AVDictionary* options = nullptr;
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    const std::string url = "file:" + path;
    const int error =
        avformat_open_input(&context, url.c_str(), av_find_input_format("mov"), &options);
    av_dict_free(&options);
    DemuxerHandle demuxer(context);
    if (error < 0) {
        return fail("cannot be read back: " + av_reason(error));
    }
    if (demuxer->nb_streams != tracks) {
        return fail("cannot be read back: a track is missing");
    }
    return demuxer;
}

/// A track as its encoder describes it, but with the codec's head as the fragments have it: their
/// packets have the container's form, the encoder's do not.
bool describe(AVCodecParameters& to, const FilmTrack& track, const AVCodecParameters& fragments) {
    const auto bytes = static_cast<std::size_t>(fragments.extradata_size);
    if (avcodec_parameters_from_context(&to, track.codec) < 0) {
        return false;
    }
    av_freep(&to.extradata);
    to.extradata_size = 0;
    if (bytes == 0) {
        return true;
    }
    to.extradata = static_cast<std::uint8_t*>(av_mallocz(bytes + AV_INPUT_BUFFER_PADDING_SIZE));
    if (to.extradata == nullptr) {
        return false;
    }
    std::copy_n(fragments.extradata, bytes, to.extradata);
    to.extradata_size = fragments.extradata_size;
    return true;
}

Expected<MuxerHandle> open_plain(const char* form,
                                 const std::string& path,
                                 std::span<const FilmTrack> tracks,
                                 const AVFormatContext& fragments) {
    AVFormatContext* context = nullptr;
    const std::string url = "file:" + path;
    int error = avformat_alloc_output_context2(&context, nullptr, form, url.c_str());
    MuxerHandle muxer(context);
    if (error < 0) {
        return fail("cannot be written: " + av_reason(error));
    }
    muxer->flags |= AVFMT_FLAG_BITEXACT;
    // The fragments' head says more of itself (their brand) than belongs to the film.
    if (const AVDictionaryEntry* const comment =
            av_dict_get(fragments.metadata, "comment", nullptr, 0)) {
        av_dict_set(&muxer->metadata, "comment", comment->value, 0);
    }
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        AVStream* const stream = avformat_new_stream(muxer.get(), nullptr);
        if (stream == nullptr ||
            !describe(*stream->codecpar, tracks[i], *fragments.streams[i]->codecpar)) {
            return fail("out of memory");
        }
        stream->time_base = tracks[i].codec->time_base;
        stream->avg_frame_rate = tracks[i].codec->framerate;
    }
    error = avio_open(&muxer->pb, url.c_str(), AVIO_FLAG_WRITE);
    if (error >= 0) {
        error = avformat_write_header(muxer.get(), nullptr);
    }
    if (error < 0) {
        return fail("cannot be written: " + av_reason(error));
    }
    return muxer;
}

/// Time stamps as the encoder gave them: fragments may begin elsewhere.
class Retimed {
 public:
    explicit Retimed(const FilmTrack& track) : track_(track) {}
    void apply(AVPacket& packet, AVRational from) {
        av_packet_rescale_ts(&packet, from, track_.codec->time_base);
        if (!shift_) {
            shift_ = track_.first_dts - packet.dts;
        }
        packet.dts += *shift_;
        packet.pts += *shift_;
        // Read back from fragments a packet has no length: that of the codec's frames, which the
        // last of a track may not reach.
        const std::int64_t whole = std::max(track_.codec->frame_size, 1);
        packet.duration = std::clamp<std::int64_t>(track_.end - packet.pts, 0, whole);
    }

 private:
    FilmTrack track_;
    std::optional<std::int64_t> shift_;
};

}  // namespace

Expected<void> make_plain_film(const char* form,
                               const std::string& fragments,
                               const std::string& plain,
                               std::span<const FilmTrack> tracks) {
    auto demuxer = open_fragments(fragments, tracks.size());
    if (!demuxer) {
        return fail(demuxer.error());
    }
    auto muxer = open_plain(form, plain, tracks, **demuxer);
    if (!muxer) {
        return fail(muxer.error());
    }
    const PacketHandle packet(av_packet_alloc());
    std::vector<Retimed> times(tracks.begin(), tracks.end());
    while (av_read_frame(demuxer->get(), packet.get()) >= 0) {
        const auto track = static_cast<std::size_t>(packet->stream_index);
        const AVStream& from = *(*demuxer)->streams[track];
        const AVStream& to = *(*muxer)->streams[track];
        times[track].apply(*packet, from.time_base);
        av_packet_rescale_ts(packet.get(), tracks[track].codec->time_base, to.time_base);
        packet->pos = -1;
        if (const int error = av_interleaved_write_frame(muxer->get(), packet.get()); error < 0) {
            return fail("cannot be written: " + av_reason(error));
        }
    }
    int error = av_write_trailer(muxer->get());
    // A full disk may show only when the file is closed.
    const int close_error = avio_closep(&(*muxer)->pb);
    error = error < 0 ? error : close_error;
    return error < 0 ? fail("cannot be written: " + av_reason(error)) : Expected<void>();
}

}  // namespace raks::render
