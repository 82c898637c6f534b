#include "engine/films/film_child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <system_error>
#include <utility>

#include "audio/io/decoder_part.hpp"
#include "base/printable.hpp"

namespace raks::engine {
namespace {

using audio::DecodeKind;

constexpr std::chrono::seconds kLongestWait(30);  // for a message, or the pixels of a picture
constexpr int kMostPixels = 8192;
constexpr int kPictureBuffer = 4 << 20;  // bytes that the child may write ahead, if we may ask so

// What a decoder says, fit for people.
std::string line_of(std::string_view words) { return printable(words, audio::kDecodeTextBytes); }

bool is_size(const audio::DecodedPicture& picture) {
    return picture.width >= 1 && picture.width <= kMostPixels && picture.height >= 1 &&
           picture.height <= kMostPixels;
}

}  // namespace

Expected<std::unique_ptr<FilmChild>> FilmChild::start(std::function<bool()> is_stop_requested) {
    TalkEnds pictures;
    TalkEnds lifeline;
    if (!pictures.make_sockets(SOCK_STREAM) || !lifeline.make_lifeline()) {
        return audio::no_decoder(errno);
    }
    static_cast<void>(::setsockopt(
        pictures.childs.number, SOL_SOCKET, SO_SNDBUF, &kPictureBuffer, sizeof kPictureBuffer));
    auto started =
        TalkingChild::start(audio::kDecoderPart,
                            {.arguments = {"--pictures"},
                             .kind = SOCK_SEQPACKET,
                             .more_descriptors = {pictures.childs.number, lifeline.childs.number}});
    if (!started) {
        return fail(std::move(started.error()));
    }
    std::unique_ptr<FilmChild> child(new FilmChild);
    child->child_.emplace(std::move(*started));
    child->pictures_.number = pictures.ours.release();
    child->lifeline_.number = lifeline.ours.release();
    child->is_stop_requested_ = std::move(is_stop_requested);
    return child;
}

Patience FilmChild::patience() const {
    return until(std::chrono::steady_clock::now() + kLongestWait, is_stop_requested_);
}

Talk FilmChild::receive() { return audio::await_message(child_->socket(), message_, patience()); }

// Ends the process; returns what happened, in words.
std::string FilmChild::end(Talk why) {
    const std::string how = child_->end();
    child_.reset();
    has_film_ = false;
    return audio::why_ended(why, how);
}

Expected<FilmInfo> FilmChild::open(const std::filesystem::path& path) {
    name_ = path.string();
    warning_.clear();
    newest_.reset();
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.number < 0) {
        return fail(name_ + ": cannot be opened: " + std::generic_category().message(errno));
    }
    if (!child_) {
        return fail(name_ + ": has no decoder any more");
    }
    audio::DecodeMessage ask;
    ask.kind = DecodeKind::open_film;
    ask.set_text(name_);
    const Talk sent = audio::send_message(child_->socket(), ask, std::span(&file.number, 1));
    const Talk talk = sent == Talk::good ? receive() : sent;
    if (talk == Talk::good && message_.kind == DecodeKind::failed) {
        return fail(line_of(message_.words()));
    }
    const audio::DecodedPicture& film = message_.picture;
    if (talk != Talk::good || message_.kind != DecodeKind::opened || !is_size(film) ||
        !std::isfinite(film.pictures_per_second) || !std::isfinite(message_.head.claimed_seconds)) {
        return fail(name_ + ": " + end(talk) + " before its first picture");
    }
    if (message_.head.is_confined == 0) {
        note_uncaged_child();
    }
    has_film_ = true;
    FilmInfo info{.width = film.width,
                  .height = film.height,
                  .pictures_per_second = std::max(film.pictures_per_second, 0.0),
                  .claimed_seconds = std::nullopt,
                  .turned = film.turned,
                  .recorded = std::nullopt,
                  .format = line_of(message_.words())};
    if (std::isfinite(film.seconds) && film.seconds > 0.0) {
        info.recorded = film.seconds;
    }
    if (message_.head.claimed_seconds >= 0.0) {
        info.claimed_seconds = message_.head.claimed_seconds;
    }
    return info;
}

// The film ends here, and the warning says why.
Expected<std::optional<FilmPicture>> FilmChild::break_off(Talk why) {
    const std::string what = end(why);
    if (why == Talk::stopped || !newest_) {
        return fail(name_ + ": " + what + (newest_ ? "" : " before its first picture"));
    }
    warning_ = fmt::format("{}: {} at {:.2f} s; the rest is left out", name_, what, *newest_);
    return std::nullopt;
}

Expected<std::optional<FilmPicture>> FilmChild::next() {
    if (!has_film_) {
        return std::nullopt;
    }
    if (is_stop_requested_()) {
        return break_off(Talk::stopped);
    }
    if (const Talk talk = receive(); talk != Talk::good) {
        return break_off(talk);
    }
    if (message_.kind == DecodeKind::failed) {
        has_film_ = false;
        return fail(line_of(message_.words()));
    }
    if (message_.kind == DecodeKind::film_end) {
        has_film_ = false;
        warning_ = line_of(message_.words());
        return newest_ ? Expected<std::optional<FilmPicture>>(std::nullopt) : fail(warning_);
    }
    const audio::DecodedPicture head = message_.picture;
    const bool is_later = std::isfinite(head.seconds) && (!newest_ || head.seconds > *newest_);
    if (message_.kind != DecodeKind::picture || !is_size(head) || !is_later) {
        return break_off(Talk::nonsense);
    }
    FilmPicture picture{head.seconds, head.width, head.height, {}};
    picture.rgb.resize(static_cast<std::size_t>(head.width) *
                       static_cast<std::size_t>(head.height) * 3);
    const Talk talk =
        receive_all(pictures_.number, std::as_writable_bytes(std::span(picture.rgb)), patience());
    if (talk != Talk::good) {
        return break_off(talk);
    }
    newest_ = head.seconds;
    return picture;
}

}  // namespace raks::engine
