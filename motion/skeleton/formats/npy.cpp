#include "motion/skeleton/formats/npy.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "base/printable.hpp"
#include "motion/skeleton/text_lines.hpp"

namespace raks::motion {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kMostDimensions = 8;
constexpr std::size_t kMostNumbers = std::size_t{1} << 27U;  // 1 GiB as doubles

// What the head of an array says.
struct NpyHead {
    bool is_swapped = false;  // not in this machine's byte order
    char kind = 'f';          // f: float, i: signed, u: unsigned, b: truth value
    std::size_t size = 0;     // bytes of a number
    bool is_fortran = false;  // the first index runs fastest
    std::vector<std::size_t> shape;
};

std::uint32_t little_endian(std::string_view bytes, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        value |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8U * i);
    }
    return value;
}

// The text after "'key':" in the head, which is a Python dictionary. Empty: there is none.
std::string_view value_of_key(std::string_view head, const std::string& key) {
    for (const char quote : {'\'', '"'}) {
        const std::string quoted = quote + key + quote;
        const std::size_t at = head.find(quoted);
        if (at != std::string_view::npos) {
            std::string_view rest = trimmed(head.substr(at + quoted.size()));
            if (!rest.empty() && rest.front() == ':') {
                return trimmed(rest.substr(1));
            }
        }
    }
    return {};
}

// '<f4', '>i8', '|u1', '=f8'.
Expected<void> take_type(std::string_view text, NpyHead& head) {
    if (text.size() < 2 || (text[0] != '\'' && text[0] != '"')) {
        return fail("is a table of several columns, not an array of numbers");
    }
    text.remove_prefix(1);
    const std::string_view type = text.substr(0, text.find_first_of("'\""));
    std::string_view rest = type;
    if (!rest.empty() && std::string_view("<>=|").find(rest[0]) != std::string_view::npos) {
        head.is_swapped = rest[0] == '>';
        rest.remove_prefix(1);
    }
    if (rest.empty() || rest[0] == 'O') {
        return fail(
            "holds objects as a pickle, and pickles are programs, which are not run; save it "
            "as an array of numbers");
    }
    head.kind = rest[0];
    rest.remove_prefix(1);
    const auto parsed = std::from_chars(rest.data(), rest.data() + rest.size(), head.size);
    const bool is_size = parsed.ec == std::errc{} && parsed.ptr == rest.data() + rest.size();
    const bool is_float = head.kind == 'f' && (head.size == 2 || head.size == 4 || head.size == 8);
    const bool is_whole = (head.kind == 'i' || head.kind == 'u') &&
                          (head.size == 1 || head.size == 2 || head.size == 4 || head.size == 8);
    const bool is_truth = head.kind == 'b' && head.size == 1;
    if (!is_size || !(is_float || is_whole || is_truth)) {
        return fail(
            fmt::format("is of type \"{}\"; known are floats of 16, 32, 64 bits and whole "
                        "numbers",
                        printable(type, 20)));
    }
    static_assert(std::endian::native == std::endian::little, "numbers are read as they lie");
    return {};
}

// (120, 72), (3,), ().
Expected<void> take_shape(std::string_view text, NpyHead& head) {
    const std::size_t end = text.find(')');
    if (text.empty() || text.front() != '(' || end == std::string_view::npos) {
        return fail("has a damaged header: it gives no shape");
    }
    text = text.substr(1, end - 1);
    while (!trimmed(text).empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        std::string_view word = trimmed(text.substr(0, comma));
        text.remove_prefix(std::min(comma + 1, text.size()));
        std::size_t extent = 0;
        const auto parsed = std::from_chars(word.data(), word.data() + word.size(), extent);
        if (word.empty() || parsed.ec != std::errc{} || parsed.ptr != word.data() + word.size() ||
            head.shape.size() == kMostDimensions) {
            return fail("has a damaged header: its shape is not a list of counts");
        }
        head.shape.push_back(extent);
    }
    return {};
}

// How many numbers a shape has. None: too many.
std::optional<std::size_t> count_of(const std::vector<std::size_t>& shape) {
    std::size_t count = 1;
    for (const std::size_t extent : shape) {
        if (extent != 0 && count > kMostNumbers / extent) {
            return std::nullopt;
        }
        count *= extent;
    }
    return count;
}

template <typename T>
T number_at(const char* bytes, bool is_swapped) {
    char ordered[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        ordered[i] = bytes[is_swapped ? sizeof(T) - 1 - i : i];
    }
    T value{};
    std::memcpy(&value, ordered, sizeof(T));
    return value;
}

// IEEE 754 binary16.
double half(std::uint16_t bits) {
    const int exponent = (bits >> 10U) & 0x1F;
    const double mantissa = bits & 0x3FF;
    const double sign = (bits & 0x8000) != 0 ? -1.0 : 1.0;
    if (exponent == 0) {
        return sign * std::ldexp(mantissa, -24);
    }
    if (exponent == 31) {
        return mantissa == 0.0 ? sign * HUGE_VAL : std::nan("");
    }
    return sign * std::ldexp(1024.0 + mantissa, exponent - 25);
}

double number_at(const char* at, const NpyHead& head) {
    const bool swap = head.is_swapped;
    if (head.kind == 'f') {
        return head.size == 2   ? half(number_at<std::uint16_t>(at, swap))
               : head.size == 4 ? static_cast<double>(number_at<float>(at, swap))
                                : number_at<double>(at, swap);
    }
    if (head.kind == 'i') {
        return head.size == 1   ? static_cast<double>(number_at<std::int8_t>(at, swap))
               : head.size == 2 ? static_cast<double>(number_at<std::int16_t>(at, swap))
               : head.size == 4 ? static_cast<double>(number_at<std::int32_t>(at, swap))
                                : static_cast<double>(number_at<std::int64_t>(at, swap));
    }
    return head.size == 1   ? static_cast<double>(number_at<std::uint8_t>(at, swap))
           : head.size == 2 ? static_cast<double>(number_at<std::uint16_t>(at, swap))
           : head.size == 4 ? static_cast<double>(number_at<std::uint32_t>(at, swap))
                            : static_cast<double>(number_at<std::uint64_t>(at, swap));
}

// From the order in which the first index runs fastest to that in which the last does.
std::vector<double> to_row_major(const std::vector<double>& values,
                                 const std::vector<std::size_t>& shape) {
    std::vector<double> result(values.size());
    std::vector<std::size_t> index(shape.size(), 0);
    for (double& value : result) {
        std::size_t at = 0;
        for (std::size_t d = shape.size(); d-- > 0;) {
            at = at * shape[d] + index[d];
        }
        value = values[at];
        for (std::size_t d = shape.size(); d-- > 0 && ++index[d] == shape[d];) {
            index[d] = 0;
        }
    }
    return result;
}

Expected<NpyHead> parse_head(std::string_view text) {
    NpyHead head;
    if (auto done = take_type(value_of_key(text, "descr"), head); !done) {
        return fail(std::move(done.error()));
    }
    head.is_fortran = value_of_key(text, "fortran_order").substr(0, 4) == "True";
    if (auto done = take_shape(value_of_key(text, "shape"), head); !done) {
        return fail(std::move(done.error()));
    }
    return head;
}

}  // namespace

std::string shape_text(const std::vector<std::size_t>& shape) {
    std::string text = "(";
    for (std::size_t d = 0; d < shape.size(); ++d) {
        text += fmt::format("{}{}", d == 0 ? "" : ", ", shape[d]);
    }
    return text + (shape.size() == 1 ? ",)" : ")");
}

Expected<NumberArray> parse_npy(std::string_view bytes) {
    if (bytes.substr(0, kMagic.size()) != kMagic || bytes.size() < 12) {
        return fail("is not a NumPy array");
    }
    const auto version = static_cast<unsigned char>(bytes[6]);
    const std::size_t length_bytes = version == 1 ? 2 : 4;  // of the head's length
    if (version < 1 || version > 3) {
        return fail(fmt::format("is a NumPy array of the unknown version {}", version));
    }
    const std::size_t head_size = little_endian(bytes.substr(8), length_bytes);
    bytes.remove_prefix(8 + length_bytes);
    if (head_size > bytes.size()) {
        return fail("ends inside its header");
    }
    auto head = parse_head(bytes.substr(0, head_size));
    if (!head) {
        return fail(std::move(head.error()));
    }
    bytes.remove_prefix(head_size);
    const auto count = count_of(head->shape);
    if (!count || *count > bytes.size() / head->size) {
        return fail(fmt::format("has the shape {}, but ends after {} numbers",
                                shape_text(head->shape),
                                bytes.size() / head->size));
    }
    NumberArray array;
    array.values.reserve(*count);
    for (std::size_t i = 0; i < *count; ++i) {
        array.values.push_back(number_at(bytes.data() + i * head->size, *head));
    }
    if (head->is_fortran && head->shape.size() > 1) {
        array.values = to_row_major(array.values, head->shape);
    }
    array.shape = std::move(head->shape);
    return array;
}

}  // namespace raks::motion
