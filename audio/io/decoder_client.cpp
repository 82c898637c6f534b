#include "audio/io/decoder_client.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <system_error>
#include <utility>

#include "audio/io/decoder_part.hpp"
#include "base/file.hpp"
#include "base/printable.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

constexpr Nanos kLongestSilence = std::chrono::seconds(2);  // without a sign of life
constexpr Nanos kLongestAnswer = std::chrono::seconds(30);  // of a file, with such signs

// What a decoder says, fit for people.
std::string line_of(std::string_view words) { return printable(words, kDecodeTextBytes); }

}  // namespace

Expected<std::unique_ptr<DecoderClient>> DecoderClient::open(DecodedSource source) {
    auto process = DecoderProcess::start(source.is_stop_requested);
    return process ? open(std::move(source), std::move(*process))
                   : fail(source.name + ": " + process.error().message);
}

Expected<std::unique_ptr<DecoderClient>> DecoderClient::open(
    DecodedSource source, std::unique_ptr<DecoderProcess> process) {
    std::unique_ptr<DecoderClient> client(new DecoderClient(std::move(source), std::move(process)));
    if (auto started = client->start(); !started) {
        return fail(started.error());
    }
    return client;
}

Expected<void> DecoderClient::start() {
    DecodeMessage ask;
    ask.kind = source_.is_pipe ? DecodeKind::open_pipe : DecodeKind::open_file;
    ask.value = source_.longest_wait.count();
    ask.set_text(source_.name);
    const Talk sent = send_message(process_->socket(), ask, std::span(&source_.descriptor, 1));
    const Talk talk = sent == Talk::good ? receive() : sent;
    if (talk == Talk::good && message_.kind == DecodeKind::failed) {
        return fail(line_of(message_.words()));
    }
    if (talk != Talk::good || !take_head()) {
        return fail(source_.name + ": " + end(talk) + " before its first sound");
    }
    return {};
}

// False for a head that no decoder gives.
bool DecoderClient::take_head() {
    const DecodedHead& head = message_.head;
    const std::string_view words = message_.words();
    if (message_.kind != DecodeKind::opened || head.channels < 1 ||
        head.channels > kMaxFileChannels || !SampleRate(head.rate).is_supported() ||
        head.format_bytes > words.size() || head.tag_bytes > words.size() - head.format_bytes ||
        !std::isfinite(head.offset) || !(head.gain > 0.0F && std::isfinite(head.gain)) ||
        !std::isfinite(head.claimed_seconds)) {
        return false;
    }
    info_.rate = SampleRate(head.rate);
    info_.channels = head.channels;
    if (head.claimed_seconds >= 0.0) {
        info_.claimed_seconds = head.claimed_seconds;
    }
    if (head.claimed_frames >= 0) {
        info_.claimed_frames = head.claimed_frames;
    }
    info_.hearing = {head.is_from_side != 0, head.offset, head.gain};
    info_.format = line_of(words.substr(0, head.format_bytes));
    info_.tags = tags_of_text(words.substr(head.format_bytes, head.tag_bytes));
    warning_ = line_of(words.substr(head.format_bytes + head.tag_bytes));
    if (head.is_confined == 0) {
        note_uncaged_child();
    }
    return true;
}

// The next message.
Talk DecoderClient::receive() {
    const HostTime start = HostClock::now();
    HostTime alive = start;
    std::uint64_t beat = 0;
    return await_message(process_->socket(), message_, [&] {
        if (source_.is_stop_requested()) {
            return Talk::stopped;
        }
        const HostTime now = HostClock::now();
        // relaxed: orders nothing
        const std::uint64_t seen = process_->memory().beat.load(std::memory_order_relaxed);
        if (seen != std::exchange(beat, seen)) {
            alive = now;
        }
        const bool is_hung =
            now - alive > kLongestSilence || (!source_.is_pipe && now - start > kLongestAnswer);
        return is_hung ? Talk::late : Talk::good;
    });
}

// Ends the process; returns what happened, in words.
std::string DecoderClient::end(Talk why) {
    const std::string how = process_->end();
    process_.reset();
    has_slot_ = false;
    is_at_end_ = true;
    return why_ended(why, how);
}

// The sound ends here, and the warning says why.
void DecoderClient::break_off(Talk why) {
    const std::string what = end(why);
    if (why != Talk::stopped) {
        warning_ = fmt::format("{}: {} at {:.2f} s; the rest is left out",
                               source_.name,
                               what,
                               static_cast<double>(position_) / info_.rate.hertz());
    }
}

void DecoderClient::give_slot_back() {
    DecodeMessage ask;
    ask.kind = DecodeKind::take_back;
    ask.generation = generation_;
    ask.slot = slot_;
    has_slot_ = false;
    // One that is gone shows at the next wait.
    static_cast<void>(send_message(process_->socket(), ask));
}

// False for samples that cannot be.
bool DecoderClient::take_samples() {
    const auto channels = static_cast<std::size_t>(info_.channels);
    const std::int64_t most = static_cast<std::int64_t>(kDecodeSlotSamples / channels);
    if (message_.kind != DecodeKind::samples || message_.generation != generation_ ||
        message_.slot >= kDecodeSlots || message_.value < 0 || message_.value > most) {
        return false;
    }
    warning_ = line_of(message_.words());
    slot_ = message_.slot;
    slot_at_ = 0;
    slot_end_ = static_cast<std::size_t>(message_.value) * channels;
    has_slot_ = slot_end_ > 0;
    is_at_end_ = !has_slot_;
    return true;
}

// False at the end.
bool DecoderClient::next_slot() {
    if (has_slot_ && slot_at_ == slot_end_) {
        give_slot_back();
    }
    if (has_slot_ || is_at_end_) {
        return has_slot_;
    }
    const Talk talk = receive();
    if (talk != Talk::good || !take_samples()) {
        break_off(talk);
    }
    return has_slot_;
}

// A pipe gives what there is; a file fills the span, as its decoder would.
std::size_t DecoderClient::read(std::span<float> interleaved) {
    const auto channels = static_cast<std::size_t>(info_.channels);
    const std::size_t wanted = interleaved.size() / channels * channels;
    std::size_t done = 0;
    while (done < wanted && (done == 0 || !source_.is_pipe) && next_slot()) {
        const std::size_t count = std::min(wanted - done, slot_end_ - slot_at_);
        const float* const from = process_->memory().slots[slot_].data() + slot_at_;
        std::copy_n(from, count, interleaved.data() + done);
        slot_at_ += count;
        done += count;
        position_ += static_cast<std::int64_t>(count / channels);
    }
    return done / channels;
}

// The answer to a seek. Samples from before it are passed over: at most one for each slot, or the
// decoder is not to be trusted.
Talk DecoderClient::receive_sought() {
    Talk talk = receive();
    for (std::size_t i = 0; i < kDecodeSlots && talk == Talk::good && !is_new(); ++i) {
        talk = receive();
    }
    return talk;
}

Expected<void> DecoderClient::seek(std::int64_t frame) {
    if (!process_) {
        return fail(warning_.empty() ? source_.name + ": its decoder has ended" : warning_);
    }
    DecodeMessage ask;
    ask.kind = DecodeKind::seek;
    ask.generation = ++generation_;
    ask.value = frame;
    has_slot_ = false;
    is_at_end_ = false;
    const Talk sent = send_message(process_->socket(), ask);
    const Talk talk = sent == Talk::good ? receive_sought() : sent;
    const bool is_answered = talk == Talk::good && is_new();
    if (is_answered && message_.kind == DecodeKind::failed) {
        return fail(line_of(message_.words()));
    }
    position_ = frame;
    if (!is_answered || message_.kind != DecodeKind::sought) {
        break_off(talk);
        return fail(warning_.empty() ? source_.name + ": was stopped" : warning_);
    }
    warning_ = line_of(message_.words());
    return {};
}

Expected<std::unique_ptr<AudioFileReader>> open_audio_file(const std::filesystem::path& path,
                                                           std::function<bool()> is_stopped) {
    // Says what is missing, a folder, not a plain file.
    const auto head = read_file_start(path, 1);
    if (!head) {
        return fail(head.error());
    }
    if (head->empty()) {
        return fail(path.string() + ": is empty");
    }
    // Without waiting: files of the kernel such as /proc/kmsg would keep a reader.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) {
        return fail(path.string() +
                    ": cannot be opened: " + std::generic_category().message(errno));
    }
    DecodedSource source;
    source.name = path.string();
    source.descriptor = descriptor;
    if (is_stopped) {
        source.is_stop_requested = std::move(is_stopped);
    }
    auto client = DecoderClient::open(std::move(source));
    ::close(descriptor);
    return client;
}

}  // namespace raks::audio
