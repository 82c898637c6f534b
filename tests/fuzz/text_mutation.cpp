#include "tests/fuzz/mutation.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "base/random.hpp"

namespace raks::fuzz {
namespace {

constexpr std::array<std::string_view, 20> kNumbers = {
    "0",     "-1",     "1",      "-0.0",   "2147483648", "-2147483649", "4294967296",
    "1e308", "1e-321", "1e-308", "-1e308", "1e-12",      "1e12",        "9223372036854775807",
    "0.5",   "255",    "65536",  "nan",    "inf",        "1e999"};
constexpr std::array<std::string_view, 10> kTexts = {"\"\"",
                                                     "\"..\"",
                                                     "\"../../x\"",
                                                     "\"/etc/x\"",
                                                     "\"a\\\\b\"",
                                                     "\"\\u001b[2J\"",
                                                     "\"\\n\"",
                                                     "\"\\u0000\"",
                                                     "\"none\"",
                                                     "\"a\""};
constexpr std::array<std::string_view, 5> kLists = {"[]", "{}", "[[]]", "[0]", "[1, 2, 3]"};
// What is put in the place of values of any kind.
constexpr std::array<std::string_view, 7> kForeign = {
    "0", "-1", "2147483648", "1e308", "1e-321", "\"\"", "[]"};
constexpr std::size_t kDeep = 20'000;  // levels

// What is nested, with what comes before and behind a value on each level.
struct Nest {
    std::string_view before;
    std::string_view behind;
};
constexpr std::array<Nest, 5> kNests = {
    {{"[", "]"}, {"{\"a\":", "}"}, {"{a=", "}"}, {"[", ""}, {"{\"a\":[", "]}"}}};

std::string repeated(std::string_view text, std::size_t times) {
    std::string all;
    all.reserve(text.size() * times);
    for (std::size_t i = 0; i < times; ++i) {
        all += text;
    }
    return all;
}

/// A stretch of the text.
struct Span {
    std::size_t at = 0;
    std::size_t size = 0;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_of_number(char c) {
    return is_digit(c) || c == '.' || c == 'e' || c == 'E' || c == '-' || c == '+';
}
bool is_of_word(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Draws of one mutation.
class TextMutation {
 public:
    TextMutation(std::string_view text, std::uint64_t seed) : text_(text), random_(seed) {}

    std::string run() {
        const std::uint64_t changes = 1 + below(3);
        for (std::uint64_t i = 0; i < changes; ++i) {
            change();
        }
        return std::move(text_);
    }

 private:
    std::size_t below(std::size_t count) {
        return count == 0 ? 0 : static_cast<std::size_t>(random_.below(draw_++, count));
    }
    template <std::size_t Count>
    std::string_view one_of(const std::array<std::string_view, Count>& texts) {
        return texts[below(Count)];
    }

    void change() {
        switch (below(12)) {
            case 0:
            case 1:
            case 2:
                return replace(numbers(), one_of(kNumbers));
            case 3:
                return replace(quoted(), one_of(kTexts));
            case 4:
                return replace(lists(), one_of(kLists));
            case 5:
                return swap_kinds();
            case 6:
                return nest();
            case 7:
                return lengthen_key();
            case 8:
                return repeat_line();
            case 9:
                return repeat_member();
            case 10:
                return remove_line();
            default:
                return change_byte();
        }
    }

    // Values of any one kind.
    std::vector<Span> any_values() {
        switch (below(3)) {
            case 0:
                return numbers();
            case 1:
                return quoted();
            default:
                return lists();
        }
    }
    void swap_kinds() {
        const std::vector<Span> spans = any_values();
        replace(spans, one_of(kForeign));
    }

    void replace(const std::vector<Span>& spans, std::string_view with) {
        if (!spans.empty()) {
            const Span span = spans[below(spans.size())];
            text_.replace(span.at, span.size, with);
        }
    }

    // Numbers outside of words: "x2" has none.
    [[nodiscard]] std::vector<Span> numbers() const {
        std::vector<Span> found;
        for (std::size_t i = 0; i < text_.size(); ++i) {
            const bool begins = is_digit(text_[i]) ||
                                (text_[i] == '-' && i + 1 < text_.size() && is_digit(text_[i + 1]));
            if (!begins || (i > 0 && is_of_word(text_[i - 1]))) {
                continue;
            }
            Span span{i, 1};
            while (i + span.size < text_.size() && is_of_number(text_[i + span.size])) {
                ++span.size;
            }
            i += span.size;
            found.push_back(span);
        }
        return found;
    }

    [[nodiscard]] std::vector<Span> quoted() const {
        std::vector<Span> found;
        for (std::size_t from = text_.find('"'); from != std::string::npos;) {
            const std::size_t to = text_.find('"', from + 1);
            if (to == std::string::npos) {
                break;
            }
            found.push_back({from, to - from + 1});
            from = text_.find('"', to + 1);
        }
        return found;
    }

    // Lists and tables, brackets included.
    [[nodiscard]] std::vector<Span> lists() const {
        std::vector<Span> found;
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < text_.size(); ++i) {
            if (text_[i] == '[' || text_[i] == '{') {
                open.push_back(i);
            } else if ((text_[i] == ']' || text_[i] == '}') && !open.empty()) {
                found.push_back({open.back(), i - open.back() + 1});
                open.pop_back();
            }
        }
        return found;
    }

    // A value lies in many brackets, a few or so many that a stack may not hold them.
    void nest() {
        const std::vector<Span> spans = any_values();
        if (spans.empty()) {
            return;
        }
        const Span span = spans[below(spans.size())];
        const Nest& shape = kNests[below(kNests.size())];
        const std::size_t levels = 1 + below(below(8) == 0 ? kDeep : 100);
        text_.insert(span.at + span.size, repeated(shape.behind, levels));
        text_.insert(span.at, repeated(shape.before, levels));
    }

    // A key of TOML has many parts: "a.a.a.key = 1", "[a.a.a.table]".
    void lengthen_key() {
        std::size_t at = line().at;
        while (at < text_.size() && (text_[at] == '[' || text_[at] == ' ')) {
            ++at;
        }
        text_.insert(at, repeated("a.", 1 + below(below(8) == 0 ? kDeep : 100)));
    }

    // A member of a table on one line comes twice: "{"a": 1, "a": 1}", or with another value.
    void repeat_member() {
        const std::vector<std::size_t> members = members_of_tables();
        if (members.empty()) {
            return;
        }
        const std::size_t at = members[below(members.size())];
        const std::size_t colon = text_.find(':', text_.find('"', at + 1));
        std::string copy = text_.substr(at, end_of_value(colon + 1) - at);
        if (below(2) == 0) {
            copy.resize(copy.find(':') + 1);
            copy += one_of(kForeign);
        }
        text_.insert(at, copy + ",");
    }
    // Of JSON: where keys in quotes stand that a colon follows.
    [[nodiscard]] std::vector<std::size_t> members_of_tables() const {
        std::vector<std::size_t> found;
        for (const Span& key : quoted()) {
            const std::size_t colon = text_.find_first_not_of(" \t\r\n", key.at + key.size);
            if (colon != std::string::npos && text_[colon] == ':') {
                found.push_back(key.at);
            }
        }
        return found;
    }
    // Where a comma or bracket of the same level ends a value.
    [[nodiscard]] std::size_t end_of_value(std::size_t at) const {
        std::size_t depth = 0;
        for (; at < text_.size(); ++at) {
            const char c = text_[at];
            const bool closes = c == ']' || c == '}';
            if (depth == 0 && (closes || c == ',')) {
                break;
            }
            if (c == '[' || c == '{') {
                ++depth;
            } else if (closes) {
                --depth;
            }
        }
        return at;
    }

    // The line that a random place lies in, with its end.
    Span line() {
        const std::size_t at = below(text_.size());
        const std::size_t before = at == 0 ? std::string::npos : text_.rfind('\n', at - 1);
        const std::size_t from = before == std::string::npos ? 0 : before + 1;
        const std::size_t end = text_.find('\n', at);
        return {from, (end == std::string::npos ? text_.size() : end + 1) - from};
    }
    void repeat_line() {
        const Span from = line();
        const std::string copy = text_.substr(from.at, from.size);
        // In its place a key is there twice; elsewhere it is another's.
        text_.insert(below(2) == 0 ? from.at : line().at, copy);
    }
    void remove_line() {
        const Span from = line();
        text_.erase(from.at, from.size);
    }
    void change_byte() {
        if (!text_.empty()) {
            text_[below(text_.size())] = static_cast<char>(below(256));
        }
    }

    std::string text_;
    CounterRandom random_;
    std::uint64_t draw_ = 0;
};

}  // namespace

std::string mutated(std::string_view text, std::uint64_t seed) {
    return TextMutation(text, seed).run();
}

}  // namespace raks::fuzz
