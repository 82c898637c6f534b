// Content file: a solved dance as bytes for a cache.
#pragma once

#include <memory>
#include <string>

#include "base/expected.hpp"
#include "motion/dance/dance_content.hpp"

namespace raks::motion {

/// The solved content of a dance in this machine's byte order, with a hash that detects damage. For
/// a cache: valid only for the program that wrote it and the skeleton and grammar that it was
/// solved with. Threads: workers. Real-time: no.
[[nodiscard]] std::string pack_content(const DanceContent& content);

/// Reads what pack_content() wrote; the same bits. The content uses the bytes where they lie and
/// keeps them alive. `bytes`: not null. `skeleton`, `grammar`: those that it was solved with.
/// Errors: damaged, cut short, of another program; other figures than the grammar has.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<DanceContent> unpack_content(const std::shared_ptr<const std::string>& bytes,
                                                    const Skeleton& skeleton,
                                                    const FigureGrammar& grammar);
/// The same of a dance of cells, which needs no grammar: its graph is kept with its takes, joins by
/// the millimetre as in the dance's file. Errors: damaged, cut short, of another program; a dance
/// of figures.
[[nodiscard]] Expected<DanceContent> unpack_cell_content(
    const std::shared_ptr<const std::string>& bytes, const Skeleton& skeleton);

}  // namespace raks::motion
