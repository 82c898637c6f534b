#include "motion/skeleton/formats/json_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/printable.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kMostNesting = 8;

// Takes the parser's events: no document is built, as it would take many times the text's memory.
class ArrayTaker : public nlohmann::json_sax<nlohmann::json> {
 public:
    explicit ArrayTaker(std::span<const std::string_view> names) : names_(names) {}

    [[nodiscard]] NpzContent& content() noexcept { return content_; }
    [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

    bool null() override { return value(std::nan("")); }
    bool boolean(bool value_) override { return value(value_ ? 1.0 : 0.0); }
    bool number_integer(number_integer_t value_) override {
        return value(static_cast<double>(value_));
    }
    bool number_unsigned(number_unsigned_t value_) override {
        return value(static_cast<double>(value_));
    }
    bool number_float(number_float_t value_, const string_t& /*text*/) override {
        return value(value_);
    }
    bool string(string_t& /*text*/) override { return other(); }
    bool binary(binary_t& /*bytes*/) override { return other(); }

    bool start_object(std::size_t /*size*/) override { return enter(false); }
    bool end_object() override { return leave(false); }
    bool start_array(std::size_t /*size*/) override { return enter(true); }
    bool end_array() override { return leave(true); }

    bool key(string_t& name) override {
        if (level_ == 1) {
            name_ = name;
            content_.names.push_back(printable(name, 60));
            is_wanted_ = std::find(names_.begin(), names_.end(), name) != names_.end();
            array_ = {};
            shape_.clear();
            counts_.clear();
            depth_ = 0;
        }
        return true;
    }

    bool parse_error(std::size_t position,
                     const std::string& /*token*/,
                     const nlohmann::detail::exception& /*why*/) override {
        problem_ = fmt::format("is damaged: no JSON from byte {} on", position);
        return false;
    }

 private:
    bool fault(std::string what) {
        problem_ = fmt::format("{}: {}", printable(name_, 60), what);
        return false;
    }

    // Text or an object where numbers are wanted.
    bool other() {
        if (level_ == 0) {
            return no_object();
        }
        if (!is_wanted_) {
            return true;
        }
        if (counts_.empty() && level_ == 1) {
            return true;  // a text in a number's place: as if it were not there
        }
        return fault("holds something that is not a number");
    }
    bool no_object() {
        problem_ = "is JSON, but not an object with arrays of numbers";
        return false;
    }

    bool enter(bool is_array) {
        if (level_ == 0 && is_array) {
            return no_object();
        }
        ++level_;
        if (level_ == 1 || !is_wanted_) {
            return true;
        }
        if (!is_array) {
            return fault("holds an object, not numbers");
        }
        if (counts_.size() == kMostNesting) {
            return fault("is nested too deeply");
        }
        // An array after numbers in the same one has no shape.
        if (depth_ != 0 && counts_.size() >= depth_) {
            return fault("has rows of different lengths");
        }
        if (!counts_.empty()) {
            ++counts_.back();
        }
        counts_.push_back(0);
        return true;
    }

    bool leave(bool is_array) {
        --level_;
        if (!is_array || !is_wanted_ || counts_.empty()) {
            return true;
        }
        const std::size_t dimension = counts_.size() - 1;
        if (shape_.size() < counts_.size()) {
            shape_.resize(counts_.size(), kUnknown);
        }
        if (shape_[dimension] == kUnknown) {
            shape_[dimension] = counts_.back();
        } else if (shape_[dimension] != counts_.back()) {
            return fault(fmt::format(
                "has rows of different lengths: {} and {}", shape_[dimension], counts_.back()));
        }
        counts_.pop_back();
        if (counts_.empty()) {
            array_.shape = shape_;
            keep();
        }
        return true;
    }

    bool value(double number) {
        if (level_ == 0) {
            return no_object();
        }
        if (!is_wanted_) {
            return true;
        }
        if (counts_.empty()) {
            array_.values.push_back(number);
            keep();
            return true;
        }
        if (depth_ == 0) {
            depth_ = counts_.size();
        }
        if (counts_.size() != depth_) {
            return fault("has rows of different lengths");
        }
        ++counts_.back();
        array_.values.push_back(number);
        return true;
    }

    void keep() {
        content_.arrays[name_] = std::move(array_);
        array_ = {};
        shape_.clear();
        depth_ = 0;
    }

    static constexpr std::size_t kUnknown = static_cast<std::size_t>(-1);

    std::span<const std::string_view> names_;
    NpzContent content_;
    std::string problem_;
    std::size_t level_ = 0;  // open objects and arrays
    std::string name_;       // of the member that is read
    bool is_wanted_ = false;
    NumberArray array_;
    std::vector<std::size_t> shape_;   // as far as it is known
    std::vector<std::size_t> counts_;  // members so far of each open array of this member
    std::size_t depth_ = 0;            // of arrays in which numbers lie; 0: none met yet
};

}  // namespace

Expected<NpzContent> read_json_arrays(std::string_view text,
                                      std::span<const std::string_view> names) {
    ArrayTaker taker(names);
    if (!nlohmann::json::sax_parse(text.begin(), text.end(), &taker)) {
        return fail(taker.problem());
    }
    return std::move(taker.content());
}

}  // namespace raks::motion
