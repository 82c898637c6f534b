#include "models/weight_file.hpp"

#include <bit>
#include <cmath>
#include <utility>

#include "base/half_float.hpp"
#include "base/hash.hpp"
#include "base/printable.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::models {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

constexpr float kLargestWeight = 1e6F;  // the shipped ones stay below 100

std::string words_of(const WeightReader::Sizes& sizes) {
    return fmt::format("{}", fmt::join(sizes, " x "));
}

}  // namespace

Expected<WeightReader> WeightReader::open(std::string_view bytes,
                                          std::string_view format,
                                          int version,
                                          std::string_view what) {
    const std::string first = std::string(format) + "\n";
    if (!bytes.starts_with(first)) {
        return fail(fmt::format("is not {}; install Raks again", what));
    }
    Unpacker head(bytes.substr(first.size()));
    const int found = head.take<std::uint16_t>();
    const int arrays = head.take<std::uint16_t>();
    // The hash is behind it, else what was read is of the hash.
    if (!head.is_good() || head.left() < sizeof(std::uint64_t)) {
        return fail("is cut short at its head; install Raks again");
    }
    if (found != version) {
        return fail(fmt::format("is of version {}, this program reads version {}", found, version));
    }
    const std::string_view hashed = bytes.substr(0, bytes.size() - sizeof(std::uint64_t));
    const auto hash = Unpacker(bytes.substr(hashed.size())).take<std::uint64_t>();
    return WeightReader(hashed.substr(bytes.size() - head.left()), arrays, hash == hash_of(hashed));
}

std::vector<float> WeightReader::take(const std::string& name, const Sizes& sizes) {
    std::size_t count = 1;
    for (const std::size_t size : sizes) {
        count *= size;
    }
    std::vector<float> values(count);
    if (!fault_.empty()) {
        return values;
    }
    ++taken_;
    std::string found_name(bytes_.take<std::uint8_t>(), ' ');
    for (char& letter : found_name) {
        letter = bytes_.take<char>();
    }
    const char kind = bytes_.take<char>();
    Sizes found(bytes_.take<std::uint8_t>());
    for (std::size_t& size : found) {
        size = bytes_.take<std::uint32_t>();
    }
    if (!bytes_.is_good()) {
        fault_ = "is cut short at " + name;
    } else if (found_name != name) {
        fault_ = fmt::format("has an array '{}' where {} must be", printable(found_name), name);
    } else if (found != sizes) {
        fault_ = fmt::format("{} is {}, must be {}", name, words_of(found), words_of(sizes));
    } else if (kind != 'h' && kind != 'f') {
        fault_ = name + " is neither of halves nor of floats";
    } else {
        fill(name, kind, values);
    }
    return values;
}

std::vector<std::size_t> WeightReader::take_whole(const std::string& name,
                                                  std::size_t count,
                                                  std::size_t below) {
    const std::vector<float> numbers = take(name, {count});
    std::vector<std::size_t> whole(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float number = numbers[i];
        const bool is_good =
            number >= 0.0F && number < static_cast<float>(below) && number == std::floor(number);
        if (!is_good) {
            complain(fmt::format(
                "{}[{}] is {}, must be a whole number below {}", name, i, number, below));
        }
        whole[i] = is_good ? static_cast<std::size_t>(number) : 0;
    }
    return whole;
}

void WeightReader::complain(std::string fault) {
    fault_ = fault_.empty() ? std::move(fault) : fault_;
}

// The hash comes last: a fault before it says more.
Expected<void> WeightReader::finish() const {
    std::string fault = fault_;
    if (fault.empty() && !bytes_.at_end()) {
        fault = "goes on after its last array";
    } else if (fault.empty() && taken_ != arrays_) {
        fault = fmt::format("says that it has {} arrays, must be {}", arrays_, taken_);
    } else if (fault.empty() && !is_whole_) {
        fault = "is damaged: the hash at its end is of other bytes";
    }
    return fault.empty() ? Expected<void>{} : fail(fault + "; install Raks again");
}

void WeightReader::fill(const std::string& name, char kind, std::vector<float>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] =
            kind == 'h' ? float_of_half(bytes_.take<std::uint16_t>()) : bytes_.take<float>();
        if (!(std::abs(values[i]) <= kLargestWeight)) {
            fault_ = fmt::format("{}[{}] is {}, must be a number up to 1e6", name, i, values[i]);
            return;
        }
    }
    if (!bytes_.is_good()) {
        fault_ = "is cut short in " + name;
    }
}

}  // namespace raks::models
