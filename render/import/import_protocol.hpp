// What raks and the program raks-import say to one another, over a stream socket. Both are of the
// same build; neither trusts what the other says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/talking_child.hpp"

namespace raks::render {

/// raks answers with the first two, raks-import says the others.
enum class ImportKind : std::uint32_t {
    file,    ///< all of a file: the model at the start, then what was wanted
    none,    ///< why what was wanted cannot be had
    want,    ///< a file beside the model, or a data URI, as the model names it
    note,    ///< what was repaired, guessed or left out: one line
    failed,  ///< why the model cannot be read; the end
    done,    ///< the model as a binary glTF; the end
};

/// The most that a part may have, bytes.
inline constexpr std::size_t kMostImportBytes = std::size_t{512} << 20U;

/// One part of the talk.
struct ImportPart {
    ImportKind kind = ImportKind::failed;
    std::string bytes;
};

/// Sends a part whole. Threads: one a socket. Real-time: no.
[[nodiscard]] Talk send_part(int socket,
                             ImportKind kind,
                             std::string_view bytes,
                             TalkDeadline deadline);
/// Receives a part whole. Threads: one a socket. Real-time: no.
[[nodiscard]] Talk receive_part(int socket, ImportPart& part, TalkDeadline deadline);

}  // namespace raks::render
