// Parts of a 3DS file that is written.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/export/tds_writer.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// The bytes of a 3DS file.
class TdsBytes {
 public:
    TdsBytes& u16(std::size_t value);
    TdsBytes& u32(std::size_t value);
    TdsBytes& number(float value);
    TdsBytes& vector(const glm::vec3& value);
    /// With the zero behind it.
    TdsBytes& text(std::string_view value);
    /// A chunk: its id, its length, what is in it.
    TdsBytes& chunk(std::uint16_t id, const TdsBytes& body);

    TdsBytes& append(const TdsBytes& others) {
        bytes_ += others.bytes_;
        return *this;
    }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
    std::string bytes_;
};

/// z up from y up.
[[nodiscard]] inline glm::vec3 with_z_up(const glm::vec3& v) { return {v.x, -v.z, v.y}; }

/// The materials as chunks; pictures go into `made`. `names`: of tds_material_names.
[[nodiscard]] TdsBytes tds_materials(const Model& model,
                                     const std::vector<std::string>& names,
                                     const std::string& stem,
                                     TdsExport& made);

}  // namespace raks::render
