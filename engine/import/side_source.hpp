// What a model that is being imported can have from beside itself, and say.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/expected.hpp"

namespace raks::engine {

/// Ways out of an import: it opens no file and prints nothing itself.
struct ImportWays {
    /// All of a file that lies beside the model, by the name that the model gives it, or of a data
    /// URI. Errors: there is none, or it may not be read.
    std::function<Expected<std::string>(std::string_view)> fetch;
    /// Says one line: what was repaired, guessed or left out.
    std::function<void(std::string)> note;
};

}  // namespace raks::engine
