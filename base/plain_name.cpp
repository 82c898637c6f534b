#include "base/plain_name.hpp"

#include "base/printable.hpp"

#include <fmt/format.h>

namespace raks {

bool is_plain_name(std::string_view name) {
    return !name.empty() && name.size() <= kLongestPlainName && name != "." && name != ".." &&
           name.find_first_of("/\\") == std::string_view::npos && printable(name) == name;
}

std::string why_no_plain_name(std::string_view name) {
    return fmt::format(
        "\"{}\" cannot be a name: 1 to {} bytes, no '/', '\\' or control characters, not \".\" or "
        "\"..\"",
        printable(name, kLongestPlainName),
        kLongestPlainName);
}

}  // namespace raks
