// C3D parameters: numbers and words of a C3D file, and what its head says about it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::motion {

/// How the computer that wrote a file keeps numbers.
enum class C3dProcessor : std::uint8_t { intel = 84, dec = 85, mips = 86 };

/// Reads numbers of a file; what lies beyond its end is 0.
class C3dBytes {
 public:
    C3dBytes(std::string_view bytes, C3dProcessor processor)
        : bytes_(bytes), processor_(processor) {}

    [[nodiscard]] std::size_t size() const noexcept { return bytes_.size(); }
    [[nodiscard]] std::uint8_t byte(std::size_t at) const noexcept;
    [[nodiscard]] std::uint16_t word(std::size_t at) const noexcept;
    /// 4 bytes, IEEE 754 or DEC's F format.
    [[nodiscard]] double number(std::size_t at) const noexcept;
    [[nodiscard]] std::string_view text(std::size_t at, std::size_t length) const noexcept;

 private:
    std::string_view bytes_;
    C3dProcessor processor_;
};

/// One parameter: numbers, or words.
struct C3dParameter {
    std::vector<double> numbers;
    std::vector<std::string> words;  ///< without blanks at their ends
};
/// By "GROUP:NAME" in capitals.
using C3dParameters = std::map<std::string, C3dParameter>;

/// The block size in which a file counts.
inline constexpr std::size_t kC3dBlock = 512;

/// The processor of a file. Errors, without its name: no C3D.
[[nodiscard]] Expected<C3dProcessor> c3d_processor(std::string_view bytes);
/// All parameters of a file, as far as they can be read.
[[nodiscard]] C3dParameters c3d_parameters(const C3dBytes& bytes);

}  // namespace raks::motion
