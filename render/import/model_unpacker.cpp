#include "render/import/model_unpacker.hpp"

#include <string>
#include <utility>

namespace raks::render {
namespace {

constexpr TalkingPart kProgram{.name = "raks-unpack", .variable = "RAKS_UNPACKER"};

}  // namespace

Talk unpack_over(int socket,
                 const UnpackRequest& what,
                 std::span<const std::byte> packed,
                 std::span<std::byte> out,
                 TalkDeadline deadline,
                 TalkAnswer& answer) {
    Talk talk = send_all(socket, std::as_bytes(std::span(&what, 1)), deadline);
    talk = talk == Talk::good ? send_all(socket, packed, deadline) : talk;
    return talk == Talk::good ? receive_answer(socket, out, deadline, answer) : talk;
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
    TalkAnswer answer;
    const Talk talk = unpack_over(child_->socket(), what, packed, out, *deadline_, answer);
    if (talk != Talk::good) {
        const std::string why = child_->end(talk, longest_);
        child_.reset();
        return fail(why);
    }
    is_uncaged_ = is_uncaged_ || !answer.is_caged;
    return answer.done;
}

}  // namespace raks::render
