// The module raks-pipewire.so: pictures as a video stream of PipeWire. The program itself loads
// nothing of it.
#include <pipewire/pipewire.h>
#include <spa/buffer/meta.h>
#include <spa/param/buffers.h>
#include <spa/param/param.h>
#include <spa/param/video/format-utils.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>
#include <vector>

#include "engine/outputs/pipewire_sink.hpp"

// PipeWire's macros are C's.
#pragma GCC diagnostic ignored "-Wold-style-cast"

namespace raks::engine {
namespace {

// Between two tries to find a PipeWire.
constexpr Nanos kPause = std::chrono::seconds(1);
constexpr int kBuffers = 4;

/// Holds the lock that PipeWire's thread gives away while it waits.
class LoopLock {
 public:
    explicit LoopLock(pw_thread_loop* loop) : loop_(loop) { pw_thread_loop_lock(loop_); }
    LoopLock(const LoopLock&) = delete;
    LoopLock& operator=(const LoopLock&) = delete;
    ~LoopLock() { pw_thread_loop_unlock(loop_); }

 private:
    pw_thread_loop* loop_;
};

/// A stream that drives its readers: each picture is one cycle of theirs.
class PipewireSink final : public VideoSink {
 public:
    PipewireSink(std::string name, const VideoFormat& format)
        : name_(std::move(name)),
          format_(format),
          loop_(pw_thread_loop_new("raks-video", nullptr)) {
        if (loop_ != nullptr) {
            pw_thread_loop_start(loop_);
        }
    }
    ~PipewireSink() override {
        if (loop_ != nullptr) {
            disconnect();
            pw_thread_loop_stop(loop_);
            pw_thread_loop_destroy(loop_);
        }
    }

    void send(std::span<const std::uint8_t> rgba) override {
        if (loop_ == nullptr || !is_connected()) {
            return;
        }
        const LoopLock lock(loop_);
        if (pw_stream_get_state(stream_, nullptr) != PW_STREAM_STATE_STREAMING) {
            return;  // nobody looks
        }
        picture_.assign(rgba.begin(), rgba.end());
        if (is_waiting_) {
            count_dropped();
        }
        is_waiting_ = true;
        // Where somebody else drives, the next cycle takes the picture.
        if (pw_stream_is_driving(stream_)) {
            pw_stream_trigger_process(stream_);
        }
    }

    std::optional<std::string> take_trouble() override {
        return std::exchange(trouble_, std::nullopt);
    }

 private:
    // Whether there is a PipeWire; looks for one where there was none.
    [[nodiscard]] bool is_connected() {
        const HostTime now = std::chrono::time_point_cast<Nanos>(HostClock::now());
        if (core_ != nullptr && has_failed_) {
            disconnect();
            next_try_ = now + kPause;
            say(false, "PipeWire is gone; no pictures go there until it is back");
        }
        if (core_ == nullptr && now >= next_try_) {
            next_try_ = now + kPause;
            if (!connect()) {
                say(false, "no PipeWire runs; waiting for one");
            }
        }
        if (core_ != nullptr && is_listed_) {
            say(true, "the pictures are there as \"" + name_ + '"');
        }
        return core_ != nullptr;
    }

    // Only what has changed.
    void say(bool is_there, const std::string& what) {
        if (std::exchange(was_there_, is_there) != is_there) {
            trouble_ = "--video-out pipewire: " + what;
        }
    }

    [[nodiscard]] bool connect() {
        const LoopLock lock(loop_);
        has_failed_ = false;
        is_listed_ = false;
        context_ = pw_context_new(pw_thread_loop_get_loop(loop_), nullptr, 0);
        core_ = context_ == nullptr ? nullptr : pw_context_connect(context_, nullptr, 0);
        if (core_ == nullptr || !open_stream()) {
            release();
            return false;
        }
        return true;
    }

    [[nodiscard]] bool open_stream() {
        static const pw_core_events core_events = [] {
            pw_core_events events{};
            events.version = PW_VERSION_CORE_EVENTS;
            events.error = [](void* sink, std::uint32_t id, int, int error, const char*) {
                // Other errors are of one object, such as a link that could not be made.
                if (id == PW_ID_CORE && error == -EPIPE) {
                    static_cast<PipewireSink*>(sink)->has_failed_ = true;
                }
            };
            return events;
        }();
        static const pw_stream_events stream_events = [] {
            pw_stream_events events{};
            events.version = PW_VERSION_STREAM_EVENTS;
            events.state_changed =
                [](void* sink, pw_stream_state, pw_stream_state state, const char*) {
                    auto& self = *static_cast<PipewireSink*>(sink);
                    self.has_failed_ = self.has_failed_ || state == PW_STREAM_STATE_ERROR;
                    self.is_listed_ = self.is_listed_ || state == PW_STREAM_STATE_PAUSED;
                };
            events.param_changed = [](void* sink, std::uint32_t id, const spa_pod* param) {
                if (id == SPA_PARAM_Format && param != nullptr) {
                    static_cast<PipewireSink*>(sink)->wish_for_buffers();
                }
            };
            events.process = [](void* sink) { static_cast<PipewireSink*>(sink)->process(); };
            return events;
        }();
        pw_core_add_listener(core_, &core_listener_, &core_events, this);
        stream_ = pw_stream_new(core_,
                                name_.c_str(),
                                pw_properties_new(PW_KEY_MEDIA_TYPE,
                                                  "Video",
                                                  PW_KEY_MEDIA_CATEGORY,
                                                  "Playback",
                                                  PW_KEY_MEDIA_CLASS,
                                                  "Stream/Output/Video",
                                                  PW_KEY_NODE_NAME,
                                                  name_.c_str(),
                                                  PW_KEY_NODE_DESCRIPTION,
                                                  name_.c_str(),
                                                  PW_KEY_APP_NAME,
                                                  "Raks",
                                                  nullptr));
        if (stream_ == nullptr) {
            return false;
        }
        pw_stream_add_listener(stream_, &stream_listener_, &stream_events, this);
        std::array<std::uint8_t, 1024> memory{};
        spa_pod_builder builder{};
        spa_pod_builder_init(&builder, memory.data(), memory.size());
        spa_video_info_raw info{};
        info.format = SPA_VIDEO_FORMAT_RGBA;
        info.size = {static_cast<std::uint32_t>(format_.width),
                     static_cast<std::uint32_t>(format_.height)};
        info.framerate = {static_cast<std::uint32_t>(format_.rate_numerator),
                          static_cast<std::uint32_t>(format_.rate_denominator)};
        info.flags = SPA_VIDEO_FLAG_PREMULTIPLIED_ALPHA;
        std::array<const spa_pod*, 1> params = {
            spa_format_video_raw_build(&builder, SPA_PARAM_EnumFormat, &info)};
        const auto flags =
            static_cast<pw_stream_flags>(PW_STREAM_FLAG_DRIVER | PW_STREAM_FLAG_MAP_BUFFERS);
        return pw_stream_connect(
                   stream_, PW_DIRECTION_OUTPUT, PW_ID_ANY, flags, params.data(), params.size()) >=
               0;
    }

    // PipeWire's thread, as all below: the lock is held.
    void wish_for_buffers() {
        std::array<std::uint8_t, 1024> memory{};
        spa_pod_builder builder{};
        spa_pod_builder_init(&builder, memory.data(), memory.size());
        const int stride = 4 * format_.width;
        const auto* const buffers = static_cast<const spa_pod*>(
            spa_pod_builder_add_object(&builder,
                                       SPA_TYPE_OBJECT_ParamBuffers,
                                       SPA_PARAM_Buffers,
                                       SPA_PARAM_BUFFERS_buffers,
                                       SPA_POD_CHOICE_RANGE_Int(kBuffers, 2, 4 * kBuffers),
                                       SPA_PARAM_BUFFERS_blocks,
                                       SPA_POD_Int(1),
                                       SPA_PARAM_BUFFERS_size,
                                       SPA_POD_Int(stride * format_.height),
                                       SPA_PARAM_BUFFERS_stride,
                                       SPA_POD_Int(stride)));
        const auto* const header = static_cast<const spa_pod*>(
            spa_pod_builder_add_object(&builder,
                                       SPA_TYPE_OBJECT_ParamMeta,
                                       SPA_PARAM_Meta,
                                       SPA_PARAM_META_type,
                                       SPA_POD_Id(SPA_META_Header),
                                       SPA_PARAM_META_size,
                                       SPA_POD_Int(sizeof(spa_meta_header))));
        std::array<const spa_pod*, 2> params = {buffers, header};
        pw_stream_update_params(stream_, params.data(), params.size());
    }

    void process() {
        if (!is_waiting_) {
            return;
        }
        is_waiting_ = false;
        pw_buffer* const buffer = pw_stream_dequeue_buffer(stream_);
        if (buffer == nullptr) {
            count_dropped();
            return;
        }
        spa_data& data = buffer->buffer->datas[0];
        if (data.data != nullptr) {
            const std::size_t bytes =
                std::min<std::size_t>(picture_.size(), buffer->buffer->datas[0].maxsize);
            std::memcpy(data.data, picture_.data(), bytes);
            data.chunk->offset = 0;
            data.chunk->size = static_cast<std::uint32_t>(bytes);
            data.chunk->stride = 4 * format_.width;
        }
        if (auto* const header = static_cast<spa_meta_header*>(spa_buffer_find_meta_data(
                buffer->buffer, SPA_META_Header, sizeof(spa_meta_header)))) {
            header->pts = HostClock::now().time_since_epoch().count();
            header->flags = 0;
            header->seq = number_++;
            header->dts_offset = 0;
        }
        pw_stream_queue_buffer(stream_, buffer);
        count_sent();
    }

    void disconnect() {
        const LoopLock lock(loop_);
        release();
    }

    // With the lock held.
    void release() {
        if (stream_ != nullptr) {
            spa_hook_remove(&stream_listener_);
            pw_stream_destroy(std::exchange(stream_, nullptr));
        }
        if (core_ != nullptr) {
            if (core_listener_.link.next != nullptr) {
                spa_hook_remove(&core_listener_);
            }
            pw_core_disconnect(std::exchange(core_, nullptr));
        }
        core_listener_ = {};
        stream_listener_ = {};
        if (context_ != nullptr) {
            pw_context_destroy(std::exchange(context_, nullptr));
        }
        is_waiting_ = false;
    }

    std::string name_;
    VideoFormat format_;
    pw_thread_loop* loop_;
    pw_context* context_ = nullptr;
    pw_core* core_ = nullptr;
    pw_stream* stream_ = nullptr;
    spa_hook core_listener_{};
    spa_hook stream_listener_{};
    std::atomic<bool> has_failed_{false};
    std::atomic<bool> is_listed_{false};  // others can find it
    HostTime next_try_{};
    // Under the loop's lock.
    std::vector<std::uint8_t> picture_;
    bool is_waiting_ = false;  // the picture was not taken yet
    std::uint64_t number_ = 0;
    std::optional<bool> was_there_;
    std::optional<std::string> trouble_;
};

}  // namespace
}  // namespace raks::engine

extern "C" __attribute__((visibility("default"))) void raks_open_pipewire_1(
    const std::string& name,
    const raks::engine::VideoFormat& format,
    raks::engine::OpenedVideoSink& sink);

void raks_open_pipewire_1(const std::string& name,
                          const raks::engine::VideoFormat& format,
                          raks::engine::OpenedVideoSink& sink) {
    pw_init(nullptr, nullptr);
    sink = std::make_unique<raks::engine::PipewireSink>(name, format);
}
