#pragma once

#include <string>
#include <string_view>

#include "base/expected.hpp"

namespace raks::engine {

/// A Collada file as assimp reads it: UTF-8 (from UTF-16, by its byte-order mark), and without the
/// blanks before the first number of a list. Errors: no XML, cut UTF-16, a document type with
/// entities of its own, more than 256 elements inside one another, numbers of lists that are none
/// or not finite. Threads: any. Real-time: no.
[[nodiscard]] Expected<std::string> mended_collada(std::string_view bytes);

}  // namespace raks::engine
