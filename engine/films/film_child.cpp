#include "engine/films/film_child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/printable.hpp"
#include "base/program_parts.hpp"
#include "base/talking_child.hpp"
#include "base/time.hpp"

namespace raks::engine {
namespace {

using audio::DecodeKind;
using audio::Passed;
using audio::Waited;

constexpr Nanos kLongestWait = std::chrono::seconds(30);  // for a picture
constexpr int kPollMilliseconds = 50;
constexpr int kMostPixels = 8192;
constexpr int kPictureBuffer = 4 << 20;  // bytes that the child may write ahead, if we may ask so

// Two ends of a socket: ours and the child's.
bool make_pair(int kind, Descriptor& ours, Descriptor& childs) {
    std::array<int, 2> pair{-1, -1};
    if (::socketpair(AF_UNIX, kind | SOCK_CLOEXEC, 0, pair.data()) != 0) {
        return false;
    }
    ours.number = pair[0];
    childs.number = pair[1];
    return true;
}

// What a decoder says, fit for people.
std::string line_of(std::string_view words) { return printable(words, audio::kDecodeTextBytes); }

bool is_size(const audio::DecodedPicture& picture) {
    return picture.width >= 1 && picture.width <= kMostPixels && picture.height >= 1 &&
           picture.height <= kMostPixels;
}

}  // namespace

Expected<std::unique_ptr<FilmChild>> FilmChild::start(std::function<bool()> is_stop_requested) {
    const auto program = find_program_part("raks-decode", "libexec/raks", "RAKS_DECODER");
    if (!program) {
        return fail(program.error());
    }
    std::unique_ptr<FilmChild> child(new FilmChild);
    child->is_stop_requested_ = std::move(is_stop_requested);
    Descriptor socket;
    Descriptor pictures;
    Descriptor lifeline;
    std::array<int, 2> pipe{-1, -1};
    if (!make_pair(SOCK_SEQPACKET, child->socket_, socket) ||
        !make_pair(SOCK_STREAM, child->pictures_, pictures) ||
        ::pipe2(pipe.data(), O_CLOEXEC) != 0) {
        return fail("raks-decode cannot be started: " + std::generic_category().message(errno));
    }
    lifeline.number = pipe[0];
    child->lifeline_.number = pipe[1];
    static_cast<void>(::setsockopt(
        pictures.number, SOL_SOCKET, SO_SNDBUF, &kPictureBuffer, sizeof kPictureBuffer));
    const std::array<int, 3> given{socket.number, pictures.number, lifeline.number};
    const auto pid =
        audio::spawn_decoder({.program = *program, .descriptors = given, .mode = "--pictures"});
    if (!pid) {
        return fail(pid.error());
    }
    child->pid_ = *pid;
    return child;
}

FilmChild::~FilmChild() {
    if (pid_ >= 0) {
        end_child(pid_);
    }
}

// Until something can be received, or its end shows.
Waited FilmChild::wait(int descriptor) const {
    const HostTime start = HostClock::now();
    for (;;) {
        pollfd look{descriptor, POLLIN, 0};
        if (::poll(&look, 1, kPollMilliseconds) > 0) {
            return Waited::answer;
        }
        if (is_stop_requested_()) {
            return Waited::stopped;
        }
        if (HostClock::now() - start > kLongestWait) {
            return Waited::hung;
        }
    }
}

Waited FilmChild::receive() {
    const Waited waited = wait(socket_.number);
    if (waited != Waited::answer) {
        return waited;
    }
    return audio::receive_message(socket_.number, message_) == Passed::yes ? Waited::answer
                                                                           : Waited::broke;
}

Waited FilmChild::read_pixels(std::span<std::uint8_t> bytes) {
    while (!bytes.empty()) {
        if (const Waited waited = wait(pictures_.number); waited != Waited::answer) {
            return waited;
        }
        const ssize_t got = ::recv(pictures_.number, bytes.data(), bytes.size(), 0);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            return Waited::broke;
        }
        bytes = bytes.subspan(static_cast<std::size_t>(got));
    }
    return Waited::answer;
}

// Ends the process; returns what happened, in words.
std::string FilmChild::end(Waited why) {
    const std::string how = end_child(std::exchange(pid_, -1));
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
    if (pid_ < 0) {
        return fail(name_ + ": has no decoder any more");
    }
    audio::DecodeMessage ask;
    ask.kind = DecodeKind::open_film;
    ask.set_text(name_);
    const Passed sent = audio::send_message(socket_.number, ask, std::span(&file.number, 1));
    const Waited waited = sent == Passed::yes ? receive() : Waited::broke;
    if (waited == Waited::answer && message_.kind == DecodeKind::failed) {
        return fail(line_of(message_.words()));
    }
    const audio::DecodedPicture& film = message_.picture;
    if (waited != Waited::answer || message_.kind != DecodeKind::opened || !is_size(film) ||
        !std::isfinite(film.pictures_per_second) || !std::isfinite(message_.head.claimed_seconds)) {
        return fail(name_ + ": " + end(waited) + " before its first picture");
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
                  .format = line_of(message_.words())};
    if (message_.head.claimed_seconds >= 0.0) {
        info.claimed_seconds = message_.head.claimed_seconds;
    }
    return info;
}

// The film ends here, and the warning says why.
Expected<std::optional<FilmPicture>> FilmChild::break_off(Waited why) {
    const std::string what = end(why);
    if (why == Waited::stopped || !newest_) {
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
        return break_off(Waited::stopped);
    }
    if (const Waited waited = receive(); waited != Waited::answer) {
        return break_off(waited);
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
        return break_off(Waited::answer);
    }
    FilmPicture picture{head.seconds, head.width, head.height, {}};
    picture.rgb.resize(static_cast<std::size_t>(head.width) *
                       static_cast<std::size_t>(head.height) * 3);
    if (const Waited waited = read_pixels(picture.rgb); waited != Waited::answer) {
        return break_off(waited);
    }
    newest_ = head.seconds;
    return picture;
}

}  // namespace raks::engine
