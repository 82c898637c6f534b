// Tables of text with a head line, as the shared data has them.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace raks::test {

/// Cells of a line by the names of their columns.
using TableRow = std::map<std::string, std::string>;

/// All rows of a file whose cells are parted by tabulators; none where it cannot be read.
inline std::vector<TableRow> read_table(const std::filesystem::path& path) {
    std::ifstream file(path);
    const auto cells = [](const std::string& line) {
        std::vector<std::string> parts;
        std::istringstream stream(line);
        std::string part;
        while (std::getline(stream, part, '\t')) {
            parts.push_back(part);
        }
        return parts;
    };
    std::vector<TableRow> rows;
    std::string line;
    std::getline(file, line);
    const std::vector<std::string> names = cells(line);
    while (std::getline(file, line)) {
        const std::vector<std::string> parts = cells(line);
        TableRow row;
        for (std::size_t i = 0; i < names.size(); ++i) {
            row[names[i]] = i < parts.size() ? parts[i] : "";
        }
        rows.push_back(row);
    }
    return rows;
}

}  // namespace raks::test
