#include "base/talk_answer.hpp"

#include <cstdint>
#include <string>
#include <string_view>

#include "base/printable.hpp"

namespace raks {
namespace {

constexpr std::uint32_t kMostWords = 1000;  // bytes

// What was made follows or, where it failed, the words of `words` bytes.
struct AnswerHead {
    std::uint32_t magic = 0x52410001;  // other builds have another one
    std::uint32_t is_good = 0;         // 0 or 1
    std::uint32_t is_caged = 0;        // likewise
    std::uint32_t words = 0;           // at most kMostWords
};

}  // namespace

Talk send_answer(int socket, const Expected<std::span<const std::byte>>& made, bool is_caged) {
    const std::string_view words =
        made ? std::string_view() : std::string_view(made.error().message).substr(0, kMostWords);
    const AnswerHead head{.is_good = made ? 1U : 0U,
                          .is_caged = is_caged ? 1U : 0U,
                          .words = static_cast<std::uint32_t>(words.size())};
    const Talk sent = send_all(socket, std::as_bytes(std::span(&head, 1)), kNever);
    return sent == Talk::good
               ? send_all(socket, made ? *made : std::as_bytes(std::span(words)), kNever)
               : sent;
}

Talk receive_answer(int socket,
                    std::span<std::byte> made,
                    TalkDeadline deadline,
                    TalkAnswer& answer) {
    AnswerHead head;
    const Talk talk = receive_all(socket, std::as_writable_bytes(std::span(&head, 1)), deadline);
    if (talk != Talk::good) {
        return talk;
    }
    if (head.magic != AnswerHead().magic || head.words > kMostWords) {
        return Talk::nonsense;
    }
    answer.is_caged = head.is_caged != 0;
    if (!answer.is_caged) {
        note_uncaged_child();
    }
    if (head.is_good != 0) {
        answer.done = {};
        return receive_all(socket, made, deadline);
    }
    std::string words(head.words, '\0');
    const Talk said = receive_all(socket, std::as_writable_bytes(std::span(words)), deadline);
    answer.done = fail(printable(words));
    return said;
}

}  // namespace raks
