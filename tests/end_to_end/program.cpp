#include "tests/end_to_end/program.hpp"

#include <algorithm>

namespace raks::test {

std::vector<std::string> ProgramTest::files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
        const std::string name = entry.path().filename().string();
        if (name != "cache" && name != "config") {
            names.push_back(name);
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

bool is_one_error_line(const std::string& text) {
    return text.rfind("raks: ", 0) == 0 && std::count(text.begin(), text.end(), '\n') == 1 &&
           text.back() == '\n';
}

}  // namespace raks::test
