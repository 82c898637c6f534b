#include "engine/control/remote_request.hpp"

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include <fmt/format.h>

namespace raks::engine {
namespace {

std::string_view without_blanks(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kBlanks);
    return first == std::string_view::npos
               ? std::string_view()
               : text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

// "seek takes seconds, such as ..": only where the unit has a symbol.
std::string in_unit(const ActionRow& row) {
    const std::string_view symbol = symbol_of(row.value->unit);
    return symbol.empty() ? "" : fmt::format(" in {}", symbol);
}

Expected<double> number_of(const ActionRow& row, std::string_view text) {
    // A sign that from_chars does not know.
    const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
    double number = 0.0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (fault != std::errc() || end != digits.data() + digits.size() || !std::isfinite(number)) {
        return fail(fmt::format("action {}: it takes a number{}", row.name, in_unit(row)));
    }
    return number;
}

}  // namespace

bool is_remote(const ActionRow& row) noexcept { return row.action != Action::quit; }

Expected<ActionRequest> remote_request(std::string_view name,
                                       std::string_view value,
                                       HostTime came) {
    const auto found = find_action(name);
    if (!found) {
        return fail(found.error());
    }
    const ActionRow& row = **found;
    if (!is_remote(row)) {
        return fail(fmt::format("action {}: only who sits at the program may ask for it", name));
    }
    ActionRequest request{.action = row.action, .came = came};
    const std::string_view given = without_blanks(value);
    if (row.value) {
        const auto number = number_of(row, given);
        if (!number) {
            return fail(number.error());
        }
        if (const auto taken = take_value(row, *number); !taken) {
            return fail(taken.error());
        }
        request.value = *number;
    } else if (!given.empty()) {
        if (const auto checked = check_text(row, given); !checked) {
            return fail(checked.error());
        }
        request.text = given;
    }
    return request;
}

}  // namespace raks::engine
