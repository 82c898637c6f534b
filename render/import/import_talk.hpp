// Our side of the talk with raks-import.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "base/talking_child.hpp"
#include "render/import/wanted_files.hpp"

namespace raks::render {

/// What raks-import made of a model.
struct Imported {
    std::string glb;
    std::vector<std::string> notes;  ///< fit for people
};

/// Hands a model over and answers what is wanted until there is an end, whatever comes from the
/// other side. Good: `imported` is what it made, or why it could make nothing, in one line.
/// Threads: one a socket. Real-time: no.
[[nodiscard]] Talk import_over(int socket,
                               std::span<const std::byte> model,
                               WantedFiles& wanted,
                               TalkDeadline deadline,
                               Expected<Imported>& imported);

}  // namespace raks::render
