#pragma once

#include <string>

#include "base/talking_child.hpp"

namespace raks::audio {

/// The program that decodes sound and, with "--pictures", films.
inline constexpr TalkingPart kDecoderPart{.name = "raks-decode", .variable = "RAKS_DECODER"};

/// Why one was ended, in words: "its decoder broke off (killed by SIGSEGV)". `why`: what came of
/// talking with it, good being an answer that cannot be; `how`: of TalkingChild::end.
[[nodiscard]] std::string why_ended(Talk why, const std::string& how);

/// That one cannot be started: an error of the system.
[[nodiscard]] tl::unexpected<Error> no_decoder(int error_number);

}  // namespace raks::audio
