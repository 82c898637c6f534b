#pragma once

#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "motion/dance/dance_content.hpp"

namespace raks::motion {

/// What was solved of a dance as this machine stores it, with a sum that tells damage. For a cache:
/// it fits the program that wrote it, the skeleton and the grammar that it was solved with.
/// Threads: workers. Real-time: no.
[[nodiscard]] std::string pack_content(const DanceContent& content);

/// Reads it back; the same bits. `skeleton`, `grammar`: those that it was solved with.
/// Errors: damaged, cut short, of another program; other figures than the grammar has.
[[nodiscard]] Expected<DanceContent> unpack_content(std::string_view bytes,
                                                    const Skeleton& skeleton,
                                                    const FigureGrammar& grammar);

}  // namespace raks::motion
