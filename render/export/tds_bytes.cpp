#include <cstring>

#include "render/export/tds_parts.hpp"

namespace raks::render {

TdsBytes& TdsBytes::u16(std::size_t value) {
    bytes_ += static_cast<char>(value);
    bytes_ += static_cast<char>(value >> 8U);
    return *this;
}

TdsBytes& TdsBytes::u32(std::size_t value) { return u16(value).u16(value >> 16U); }

TdsBytes& TdsBytes::number(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof(bits));
    return u32(bits);
}

TdsBytes& TdsBytes::vector(const glm::vec3& value) {
    return number(value.x).number(value.y).number(value.z);
}

TdsBytes& TdsBytes::text(std::string_view value) {
    bytes_ += value;
    bytes_ += '\0';
    return *this;
}

TdsBytes& TdsBytes::chunk(std::uint16_t id, const TdsBytes& body) {
    constexpr std::size_t kHead = 6;
    u16(id).u32(kHead + body.bytes_.size());
    bytes_ += body.bytes_;
    return *this;
}

}  // namespace raks::render
