#include "engine/decode/decode_server.hpp"

#include <poll.h>

#include <utility>

#include "audio/io/decoders.hpp"
#include "audio/io/piped_sound.hpp"

namespace raks::engine {

using audio::DecodeKind;

void DecodeServer::run() {
    if (!open()) {
        return;
    }
    for (;;) {
        const bool may_decode = free_.any() && !is_at_end_;
        if (is_asked() || !may_decode) {
            if (!obey()) {
                return;
            }
        } else if (!fill_slot()) {
            return;
        }
    }
}

bool DecodeServer::is_asked() const {
    pollfd look{socket_, POLLIN, 0};
    return ::poll(&look, 1, 0) > 0;
}

bool DecodeServer::send(DecodeKind kind, std::string_view text) {
    answer_.kind = kind;
    answer_.set_text(text);
    return audio::send_message(socket_, answer_) == Talk::good;
}

Expected<std::unique_ptr<audio::AudioFileReader>> DecodeServer::open_source(int descriptor) {
    const std::string name(asked_.words());
    if (asked_.kind == DecodeKind::open_pipe) {
        return audio::PipedSound::open({.name = name,
                                        .descriptor = descriptor,
                                        .longest_wait = Nanos(asked_.value),
                                        .is_stop_requested = [this] {
                                            // relaxed: a sign of life, orders nothing
                                            memory_.beat.fetch_add(1, std::memory_order_relaxed);
                                            return false;
                                        }});
    }
    const auto file = audio::FileWindow::adopt(descriptor, name);
    return file ? audio::open_by_decoders(name, *file) : fail(file.error());
}

// False: nothing more is to be done.
bool DecodeServer::open() {
    int descriptor = -1;
    if (audio::receive_message(socket_, asked_, std::span(&descriptor, 1)) != Talk::good ||
        descriptor < 0) {
        return false;
    }
    auto opened = open_source(descriptor);
    if (!opened) {
        static_cast<void>(send(DecodeKind::failed, opened.error().message));
        return false;
    }
    reader_ = std::move(*opened);
    const audio::AudioFileInfo& info = reader_->info();
    const std::string tags = audio::text_of_tags(info.tags);
    answer_.head = {.rate = info.rate.hertz(),
                    .channels = info.channels,
                    .claimed_seconds = info.claimed_seconds.value_or(-1.0),
                    .claimed_frames = info.claimed_frames.value_or(-1),
                    .is_from_side = info.hearing.is_from_side ? 1U : 0U,
                    .offset = info.hearing.offset,
                    .gain = info.hearing.gain,
                    .format_bytes = static_cast<std::uint32_t>(info.format.size()),
                    .tag_bytes = static_cast<std::uint32_t>(tags.size()),
                    .is_confined = is_confined_ ? 1U : 0U};
    return send(DecodeKind::opened, info.format + tags + reader_->warning());
}

// One thing that raks asks for.
bool DecodeServer::obey() {
    if (audio::receive_message(socket_, asked_) != Talk::good) {
        return false;
    }
    if (asked_.kind == DecodeKind::take_back && asked_.generation == answer_.generation) {
        free_.set(asked_.slot % free_.size());
    } else if (asked_.kind == DecodeKind::seek) {
        return seek(asked_.value);
    }
    return true;
}

bool DecodeServer::seek(std::int64_t frame) {
    answer_.generation = asked_.generation;
    free_.set();
    const auto sought = reader_->seek(frame);
    is_at_end_ = !sought;
    return sought ? send(DecodeKind::sought, reader_->warning())
                  : send(DecodeKind::failed, sought.error().message);
}

bool DecodeServer::fill_slot() {
    std::size_t slot = 0;
    while (!free_.test(slot)) {
        ++slot;
    }
    free_.reset(slot);
    answer_.slot = static_cast<std::uint32_t>(slot);
    answer_.value = static_cast<std::int64_t>(reader_->read(memory_.slots[slot]));
    is_at_end_ = answer_.value == 0;
    return send(DecodeKind::samples, reader_->warning());
}

}  // namespace raks::engine
