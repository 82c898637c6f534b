#include "render/import/model_unpacker.hpp"

#include <string>
#include <utility>

#include "base/printable.hpp"

namespace raks::render {
namespace {

constexpr TalkingPart kProgram{.name = "raks-unpack", .variable = "RAKS_UNPACKER"};

}  // namespace

Talk unpack_over(int socket,
                 const UnpackRequest& what,
                 std::span<const std::byte> packed,
                 std::span<std::byte> out,
                 TalkDeadline deadline,
                 Expected<void>& done,
                 bool& is_caged) {
    UnpackAnswer answer;
    const std::uint32_t magic = answer.magic;
    Talk talk = send_all(socket, std::as_bytes(std::span(&what, 1)), deadline);
    talk = talk == Talk::good ? send_all(socket, packed, deadline) : talk;
    talk = talk == Talk::good
               ? receive_all(socket, std::as_writable_bytes(std::span(&answer, 1)), deadline)
               : talk;
    if (talk != Talk::good) {
        return talk;
    }
    if (answer.magic != magic || answer.words > kMostUnpackWords) {
        return Talk::nonsense;
    }
    is_caged = answer.is_caged != 0;
    if (answer.is_good != 0) {
        done = {};
        return receive_all(socket, out, deadline);
    }
    std::string words(answer.words, '\0');
    talk = receive_all(socket, std::as_writable_bytes(std::span(words)), deadline);
    done = fail(printable(words));
    return talk;
}

Expected<void> ModelUnpacker::unpack(UnpackRequest what,
                                     std::span<const std::byte> packed,
                                     std::span<std::byte> out) {
    if (!deadline_) {
        deadline_ = std::chrono::steady_clock::now() + longest_;
    }
    if (!child_) {
        auto started = TalkingChild::start(kProgram, {});
        if (!started) {
            return fail(started.error());
        }
        child_.emplace(std::move(*started));
    }
    what.packed_bytes = packed.size();
    Expected<void> done;
    bool is_caged = true;
    const Talk talk = unpack_over(child_->socket(), what, packed, out, *deadline_, done, is_caged);
    if (talk != Talk::good) {
        const std::string why = child_->end(talk, longest_);
        child_.reset();
        return fail(why);
    }
    is_uncaged_ = is_uncaged_ || !is_caged;
    return done;
}

}  // namespace raks::render
