#pragma once

/// toml++ as Raks compiles it, in every source file alike: what parse_toml (base/toml_reader.hpp)
/// gives is a toml::table. Nothing else includes <toml++/toml.h>.
///
/// toml++ 3.3 asserts where a damaged file gets it into a state that it did not expect (`a=[}`, or
/// a header without a name); with its assertions off the same files are undefined behaviour. Here
/// an assertion throws instead, and parse_toml makes an error of it.
namespace raks {

/// An assertion of toml++ that failed, with the place in the file where the parser stood.
struct TomlSurprise {
    unsigned line = 0;    ///< from 1; 0: at the end of the text, or not known
    unsigned column = 0;  ///< from 1, in characters
    char32_t found = 0;   ///< the character there
};

/// Throws TomlSurprise. `at`: the parser's pointer to the character that it stands on, which is
/// null at the end; anything else outside the parser.
template <typename At>
[[noreturn]] constexpr void throw_toml_surprise(const At& at) {
    if constexpr (requires { at->position.line; }) {
        if (at != nullptr) {
            throw TomlSurprise{at->position.line, at->position.column, at->value};
        }
    }
    throw TomlSurprise{};
}

}  // namespace raks

namespace toml {
/// What TOML_ASSERT names outside the parser, whose member of this name hides it.
inline constexpr int cp = 0;
}  // namespace toml

// NDEBUG would make toml++ drop TOML_ASSERT and assume that its conditions hold.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(condition) \
    ((condition) ? static_cast<void>(0) : ::raks::throw_toml_surprise(cp))
// Recursion is bounded by this and by the parts of dotted keys.
#define TOML_MAX_NESTED_VALUES 32
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
