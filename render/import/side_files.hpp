#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::render {

/// The files that a model names beside itself: buffers and pictures. Opens plain files in the
/// model's folder and the folders below it, and nothing else, whatever the model says: no other
/// scheme, no absolute path, no "..", no hidden file or folder, no link. Threads: one. Real-time:
/// no.
class SideFiles {
 public:
    /// Opens nothing: for a model that does not lie in a folder.
    SideFiles() = default;
    explicit SideFiles(std::filesystem::path folder) : folder_(std::move(folder)), is_open_(true) {}

    /// All of a file. `uri`: relative, percent-encoded, as it stands in the model. Errors: it leads
    /// out of the folder, is hidden (".ssh"), names a scheme, no such file, no plain file, larger
    /// than `max_bytes`.
    [[nodiscard]] Expected<std::vector<std::byte>> read(std::string_view uri,
                                                        std::size_t max_bytes) const;

 private:
    std::filesystem::path folder_;
    bool is_open_ = false;
};

/// The names of the folders and, at the end, of the file that a URI names. Errors: those of
/// SideFiles::read that the name alone has. Threads: any. Real-time: no.
[[nodiscard]] Expected<std::vector<std::string>> side_path(std::string_view uri);

/// What a data URI holds: "data:TYPE;base64,...". Errors: no such URI, no base64, another `TYPE`
/// than one of application/octet-stream, application/gltf-buffer or image/*; larger than
/// `max_bytes`. Threads: any. Real-time: no.
[[nodiscard]] Expected<std::vector<std::byte>> read_data_uri(std::string_view uri,
                                                             std::size_t max_bytes);
/// Whether it is one: begins with "data:".
[[nodiscard]] bool is_data_uri(std::string_view uri) noexcept;

}  // namespace raks::render
