#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/random.hpp"

namespace raks::test {

/// How a file is damaged: so many bytes of its first `reach`, each set to any value.
struct Damage {
    std::uint64_t seed = 1;
    std::uint64_t bytes = 3;
    std::size_t reach = std::string_view::npos;
};

/// The file with that damage: the same for the same `damage`.
inline std::string mangled(std::string_view file, const Damage& damage) {
    std::string result(file);
    const CounterRandom random(damage.seed);
    for (std::uint64_t i = 0; i < damage.bytes; ++i) {
        const std::size_t at = random.below(2 * i, std::min(damage.reach, result.size()));
        result[at] = static_cast<char>(random.below(2 * i + 1, 256));
    }
    return result;
}

}  // namespace raks::test
