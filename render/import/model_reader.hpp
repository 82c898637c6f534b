#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "render/import/side_files.hpp"
#include "render/model/model.hpp"

/// Model files of every kind that is read. A kind is a row of the table in model_reader.cpp.
namespace raks::render {

/// Reads a model. `name`: of the file, whose ending says what it is; `side`: what lies beside it.
/// Errors: an ending that is not known; what the reader says, without the name in front.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<Model> read_model(std::span<const std::byte> bytes,
                                         std::string_view name,
                                         const SideFiles& side);

/// Reads the file and what lies beside it. Errors: as read_file and read_model, with the path in
/// front; more than 256 MB. Threads: workers. Real-time: no.
[[nodiscard]] Expected<Model> load_model(const std::filesystem::path& path);

/// The endings that are read: ".glb".
[[nodiscard]] std::vector<std::string_view> model_endings();
/// Whether the ending of the name is one of those that are read.
[[nodiscard]] bool is_model_name(const std::filesystem::path& path);

}  // namespace raks::render
