// What an action takes: values within its bounds, and texts.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "base/utf8.hpp"
#include "engine/control/action_table.hpp"
#include "engine/setup/settings.hpp"

namespace raks::engine {
namespace {

// A value as it is written in a remark: "500 ms", or the bare number where the unit has no symbol.
std::string with_unit(double value, ValueUnit unit) {
    const std::string_view symbol = symbol_of(unit);
    return fmt::format("{:g}{}{}", value, symbol.empty() ? "" : " ", symbol);
}

}  // namespace

Expected<TakenValue> take_value(const ActionRow& row, double value) {
    // NaN passes every comparison with a bound and would be taken as it is.
    if (std::isnan(value)) {
        return fail(fmt::format("action {}: its value is not a number", row.name));
    }
    // An action without a value takes anything and passes on 0.
    if (!row.value) {
        return TakenValue{};
    }
    const ActionValue& range = *row.value;
    const bool is_inside = value >= range.lowest && value <= range.highest;
    // A choice out of range names something that does not exist: clamping would do another thing
    // than was asked for.
    if (range.kind == ValueKind::choice && (!is_inside || value != std::round(value))) {
        return fail(fmt::format("action {}: {:g} must be a whole number from {:g} to {:g}",
                                row.name,
                                value,
                                range.lowest,
                                range.highest));
    }
    if (is_inside) {
        return TakenValue{value, {}};
    }
    if (range.kind == ValueKind::level) {
        return fail(fmt::format("action {}: {} must be {:g} to {}",
                                row.name,
                                with_unit(value, range.unit),
                                range.lowest,
                                with_unit(range.highest, range.unit)));
    }
    const double nearest = std::clamp(value, range.lowest, range.highest);
    return TakenValue{nearest,
                      fmt::format("action {}: {} is too far, {} is taken",
                                  row.name,
                                  with_unit(value, range.unit),
                                  with_unit(nearest, range.unit))};
}

Expected<void> check_text(const ActionRow& row, std::string_view text) {
    constexpr std::size_t kLongest = 255;
    if (row.text == TextKind::none) {
        return fail(fmt::format("action {}: it takes no name", row.name));
    }
    const bool is_line = std::none_of(text.begin(), text.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20U || c == '\x7f';
    });
    if (text.empty() || text.size() > kLongest || !is_line || !is_utf8(text)) {
        return fail(fmt::format(
            "action {}: a name is one line of 1 to {} bytes in UTF-8", row.name, kLongest));
    }
    const bool is_a_name = row.text == TextKind::avatar || row.text == TextKind::theme;
    if (is_a_name && text.find('/') != std::string_view::npos) {
        return fail(fmt::format("action {}: a name is taken, no path", row.name));
    }
    if (row.text == TextKind::on_off && text != "on" && text != "off") {
        return fail(fmt::format("action {}: it is on or off", row.name));
    }
    if (row.text == TextKind::backdrop) {
        if (const auto parsed = parse_backdrop(text); !parsed) {
            return fail(fmt::format("action {}: {}", row.name, parsed.error().message));
        }
    }
    return {};
}

std::string_view symbol_of(ValueUnit unit) noexcept {
    // In the order of ValueUnit.
    constexpr std::array<std::string_view, 5> kSymbols = {"s", "ms", "BPM", "", ""};
    return kSymbols[static_cast<std::size_t>(unit)];
}

}  // namespace raks::engine
