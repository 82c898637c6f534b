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
constexpr std::size_t kDeep = 2000;  // brackets

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
class Mutation {
 public:
    Mutation(std::string_view text, std::uint64_t seed) : text_(text), random_(seed) {}

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
        switch (below(8)) {
            case 0:
            case 1:
            case 2:
                return replace(numbers(), one_of(kNumbers));
            case 3:
                return replace(quoted(), one_of(kTexts));
            case 4:
                return change_list();
            case 5:
                return repeat_line();
            case 6:
                return remove_line();
            default:
                return change_byte();
        }
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

    // The whole of a list or table becomes another one, or its bracket is many.
    void change_list() {
        std::vector<Span> lists;
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < text_.size(); ++i) {
            if (text_[i] == '[' || text_[i] == '{') {
                open.push_back(i);
            } else if ((text_[i] == ']' || text_[i] == '}') && !open.empty()) {
                lists.push_back({open.back(), i - open.back() + 1});
                open.pop_back();
            }
        }
        if (below(4) == 0 && !lists.empty()) {
            const Span span = lists[below(lists.size())];
            text_.insert(span.at, std::string(1 + below(kDeep), text_[span.at]));
            return;
        }
        replace(lists, one_of(kLists));
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
    return Mutation(text, seed).run();
}

}  // namespace raks::fuzz
