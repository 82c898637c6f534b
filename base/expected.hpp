#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace raks {

/// Why something at an edge of the program (file, device, configuration, model) failed: one line
/// without a trailing newline that says which thing, which value and what to do. The program prints
/// it after "raks: ".
struct Error {
    std::string message;  ///< the line

    /// The same error with its context in front: `"salsa.json: " + message`.
    [[nodiscard]] Error in(const std::string& where) && {
        return {where + ": " + std::move(message)};
    }
};

/// A value, or the reason why there is none. (Debian 12's GCC has no std::expected.)
template <typename T>
using Expected = tl::expected<T, Error>;

/// `return fail("x.bvh: line 3: ...");` in a function that returns Expected<T>.
[[nodiscard]] inline tl::unexpected<Error> fail(std::string message) {
    return tl::unexpected<Error>(Error{std::move(message)});
}

/// Passes an error on.
[[nodiscard]] inline tl::unexpected<Error> fail(Error error) {
    return tl::unexpected<Error>(std::move(error));
}

}  // namespace raks
