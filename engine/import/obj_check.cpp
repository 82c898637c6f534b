#include "engine/import/obj_check.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

#include "base/printable.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr std::size_t kMostCorners = 4096;  // of a face; cutting it up takes their square

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

/// Takes the next word off a line; empty: there is none.
std::string_view next_word(std::string_view& line) {
    while (!line.empty() && is_blank(line.front())) {
        line.remove_prefix(1);
    }
    std::size_t size = 0;
    while (size < line.size() && !is_blank(line[size])) {
        ++size;
    }
    const std::string_view word = line.substr(0, size);
    line.remove_prefix(size);
    return word;
}

/// How much of each kind there is, in the order in which a corner names them.
struct Counts {
    std::array<std::int64_t, 3> of{};  // vertices, texture coordinates, normals
};

/// Whether an index is of one that was there before: from 1 on, or from the last one back.
bool is_there(std::string_view index, std::int64_t count) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(index.data(), index.data() + index.size(), number);
    return error == std::errc() && end == index.data() + index.size() &&
           ((number >= 1 && number <= count) || (number < 0 && number >= -count));
}

bool is_good_corner(std::string_view corner, const Counts& counts) {
    for (std::size_t kind = 0; kind < counts.of.size(); ++kind) {
        const std::size_t slash = std::min(corner.find('/'), corner.size());
        const std::string_view index = corner.substr(0, slash);
        const bool may_lack = kind == 1;  // "1//2"
        if (!(index.empty() && may_lack) && !is_there(index, counts.of[kind])) {
            return false;
        }
        if (slash == corner.size()) {
            return true;
        }
        corner.remove_prefix(slash + 1);
        if (corner.empty()) {
            return kind == 0;  // "1/"
        }
    }
    return false;
}

bool is_good_vertex(std::string_view line) {
    for (int i = 0; i < 3; ++i) {
        const std::string word(next_word(line));
        char* end = nullptr;
        const float number = std::strtof(word.c_str(), &end);
        if (word.empty() || end != word.c_str() + word.size() || !std::isfinite(number)) {
            return false;
        }
    }
    return true;
}

/// The file, line after line; one that ends with a backslash goes on in the next.
class Lines {
 public:
    explicit Lines(std::string_view text) : text_(text) {}

    bool next(std::string& line) {
        line.clear();
        bool goes_on = at_ < text_.size();
        if (!goes_on) {
            return false;
        }
        number_ = next_number_;
        while (goes_on && at_ < text_.size()) {
            const std::size_t end = std::min(text_.find('\n', at_), text_.size());
            std::string_view part = text_.substr(at_, end - at_);
            at_ = end + 1;
            ++next_number_;
            if (!part.empty() && part.back() == '\r') {
                part.remove_suffix(1);
            }
            goes_on = !part.empty() && part.back() == '\\';
            line += goes_on ? part.substr(0, part.size() - 1) : part;
        }
        return true;
    }

    [[nodiscard]] std::size_t number() const { return number_; }

 private:
    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t number_ = 1;
    std::size_t next_number_ = 1;
};

/// What is wrong with a face; empty: nothing.
std::string fault_of_face(std::string_view line, const Counts& counts) {
    std::size_t corners = 0;
    for (std::string_view corner = next_word(line); !corner.empty() && corner.front() != '#';
         corner = next_word(line)) {
        if (!is_good_corner(corner, counts)) {
            return fmt::format("\"{}\" names a corner that does not exist", printable(corner, 40));
        }
        if (++corners > kMostCorners) {
            return fmt::format("has a face of more than {} corners", kMostCorners);
        }
    }
    return {};
}

}  // namespace

Expected<void> check_obj(std::string_view text) {
    if (text.find('\0') != std::string_view::npos) {
        return fail("is not OBJ: it is not text");
    }
    Counts counts;
    Lines lines(text);
    std::string storage;
    while (lines.next(storage)) {
        std::string_view line = storage;
        const std::string_view word = next_word(line);
        std::string fault;
        if (word == "v") {
            ++counts.of[0];
            fault = is_good_vertex(line) ? "" : "is a vertex without three numbers";
        } else if (word == "vt") {
            ++counts.of[1];
        } else if (word == "vn") {
            ++counts.of[2];
        } else if (word == "f" || word == "fo") {
            fault = fault_of_face(line, counts);
        }
        if (!fault.empty()) {
            return fail(fmt::format("line {}: {}", lines.number(), fault));
        }
    }
    return counts.of[0] > 0 ? Expected<void>() : fail("is not OBJ: there are no vertices in it");
}

}  // namespace raks::engine
