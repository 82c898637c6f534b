/// The tree of sources that the tests of the house read.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace raks::test {

/// The root of the repository.
inline const std::filesystem::path kSourceTree = RAKS_SOURCE_DIR;

/// A file whole; nothing where it cannot be opened.
inline std::string source_text(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

}  // namespace raks::test
