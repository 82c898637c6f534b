#include <array>

#include "engine/outputs/line_output.hpp"
#include "engine/outputs/output.hpp"

namespace raks::engine {
namespace {

constexpr std::array kKinds = std::to_array<OutputKind>({
    {"lines",
     "FILE",
     "beats and events, as they are heard, as lines of JSON; - for stdout",
     open_lines},
});

}  // namespace

std::span<const OutputKind> output_kinds() noexcept { return kKinds; }

}  // namespace raks::engine
