#include "motion/skeleton/formats/c3d_parameters.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "motion/skeleton/text_lines.hpp"

namespace raks::motion {
namespace {

constexpr std::uint8_t kKey = 0x50;  // the second byte of every C3D

std::string capitals(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), [](char c) {
        return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    });
    return result;
}

std::int8_t signed_byte(const C3dBytes& bytes, std::size_t at) {
    return static_cast<std::int8_t>(bytes.byte(at));
}

// One record of the parameter section: a group, or a parameter of one.
struct Record {
    int group = 0;  // negative: this is a group
    std::string name;
    std::size_t content = 0;  // where its content begins
    std::size_t next = 0;     // where the next record begins; 0: this was the last
};

// From the bytes of type, dimensions and numbers.
C3dParameter parameter_at(const C3dBytes& bytes, std::size_t at) {
    const int type = signed_byte(bytes, at);  // -1: letters, 1: bytes, 2: words, 4: floats
    const std::size_t dimensions = std::min<std::size_t>(bytes.byte(at + 1), 7);
    std::size_t count = 1;
    for (std::size_t d = 0; d < dimensions; ++d) {
        count *= bytes.byte(at + 2 + d);
        count = std::min(count, bytes.size());  // never more than there are bytes
    }
    const std::size_t first = dimensions > 0 ? bytes.byte(at + 2) : 1;
    std::size_t next = at + 2 + dimensions;
    C3dParameter parameter;
    if (type == -1) {
        for (std::size_t i = 0; first > 0 && i < count / first && next < bytes.size(); ++i) {
            parameter.words.emplace_back(trimmed(bytes.text(next, first)));
            next += first;
        }
        return parameter;
    }
    for (std::size_t i = 0; i < count && next < bytes.size(); ++i) {
        parameter.numbers.push_back(type == 4   ? bytes.number(next)
                                    : type == 2 ? static_cast<double>(bytes.word(next))
                                                : static_cast<double>(bytes.byte(next)));
        next += type == 4 ? 4 : type == 2 ? 2 : 1;
    }
    return parameter;
}

}  // namespace

std::uint8_t C3dBytes::byte(std::size_t at) const noexcept {
    return at < bytes_.size() ? static_cast<std::uint8_t>(bytes_[at]) : std::uint8_t{0};
}

std::uint16_t C3dBytes::word(std::size_t at) const noexcept {
    const bool is_big = processor_ == C3dProcessor::mips;
    const unsigned low = byte(is_big ? at + 1 : at);
    const unsigned high = byte(is_big ? at : at + 1);
    return static_cast<std::uint16_t>(high << 8U | low);
}

double C3dBytes::number(std::size_t at) const noexcept {
    const std::uint32_t first = word(at);
    const std::uint32_t second = word(at + 2);
    switch (processor_) {
        case C3dProcessor::intel:
            return static_cast<double>(std::bit_cast<float>(second << 16U | first));
        case C3dProcessor::mips:
            return static_cast<double>(std::bit_cast<float>(first << 16U | second));
        case C3dProcessor::dec:
            break;
    }
    // DEC's exponent counts from 129 with the point before the first digit: four times too large.
    return static_cast<double>(std::bit_cast<float>(first << 16U | second)) / 4.0;
}

std::string_view C3dBytes::text(std::size_t at, std::size_t length) const noexcept {
    return at < bytes_.size() ? bytes_.substr(at, length) : std::string_view();
}

Expected<C3dProcessor> c3d_processor(std::string_view bytes) {
    const C3dBytes head(bytes, C3dProcessor::intel);
    if (bytes.size() < 2 * kC3dBlock || head.byte(1) != kKey || head.byte(0) == 0) {
        return fail("is not C3D, or is cut off in its header");
    }
    const std::size_t section = (std::size_t{head.byte(0)} - 1) * kC3dBlock;
    const std::uint8_t processor = head.byte(section + 3);
    if (processor < 84 || processor > 86) {
        return fail(
            "is a C3D file of an unknown kind of computer; those of Intel, DEC and MIPS are read");
    }
    return static_cast<C3dProcessor>(processor);
}

C3dParameters c3d_parameters(const C3dBytes& bytes) {
    std::map<int, std::string> groups;
    std::vector<Record> records;
    std::size_t at = (std::size_t{bytes.byte(0)} - 1) * kC3dBlock + 4;
    while (at + 4 < bytes.size()) {
        // A negative length: locked.
        const auto length = static_cast<std::size_t>(std::abs(int{signed_byte(bytes, at)}));
        Record record;
        record.group = signed_byte(bytes, at + 1);
        if (length == 0 || record.group == 0) {
            break;
        }
        record.name = capitals(trimmed(bytes.text(at + 2, length)));
        const std::size_t way = at + 2 + length;  // of the distance to the next record
        const std::uint16_t distance = bytes.word(way);
        record.content = way + 2;
        record.next = distance == 0 ? 0 : way + distance;
        if (record.group < 0) {
            groups[-record.group] = record.name;
        }
        records.push_back(record);
        // Never back: each record is at least as long as its head.
        if (record.next <= at) {
            break;
        }
        at = record.next;
    }
    C3dParameters parameters;
    for (const Record& record : records) {
        if (record.group > 0) {
            parameters[groups[record.group] + ":" + record.name] =
                parameter_at(bytes, record.content);
        }
    }
    return parameters;
}

}  // namespace raks::motion
