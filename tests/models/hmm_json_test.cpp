#include "models/hmm_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "base/random.hpp"
#include "models/json_fields.hpp"
#include "tests/support/text.hpp"

namespace raks::models {
namespace {

// A document that holds a model and nothing else.
std::string hmm_text(const GaussianHmm& model) {
    nlohmann::ordered_json json = {{"format", "raks-hmm"}, {"version", 1}};
    json.update(hmm_json(model));
    return json_text(json);
}

Expected<GaussianHmm> parse_hmm(std::string_view text) {
    Expected<JsonDocument> document = JsonDocument::parse(text, "raks-hmm", 1);
    if (!document) {
        return fail(std::move(document.error()));
    }
    GaussianHmm model = read_hmm(document->root());
    if (auto ok = document->finish(); !ok) {
        return fail(std::move(ok.error()));
    }
    if (auto ok = validate(model); !ok) {
        return fail(std::move(ok.error()));
    }
    return model;
}

GaussianHmm small_model(CovarianceType type) {
    GaussianHmm model = left_to_right(2, 2, type, 3.0);
    model.means << 0.1, -1.0 / 3.0, 1e-17, 12345.678901234567;
    model.covariances[0](0, 0) = 0.7;
    return model;
}

TEST(HmmJson, reads_back_the_same_bits) {
    for (const CovarianceType type : {CovarianceType::diagonal,
                                      CovarianceType::full,
                                      CovarianceType::tied,
                                      CovarianceType::spherical}) {
        const GaussianHmm model = small_model(type);
        const Expected<GaussianHmm> again = parse_hmm(hmm_text(model));
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(again->means, model.means);
        EXPECT_EQ(again->transition, model.transition);
        EXPECT_EQ(again->exit, model.exit);
        EXPECT_EQ(again->covariances, model.covariances);
        EXPECT_EQ(hmm_text(*again), hmm_text(model));
    }
}

TEST(HmmJson, refuses_bad_files_with_one_line_that_names_the_field) {
    const std::string good = hmm_text(small_model(CovarianceType::full));
    const auto replaced = [&](const std::string& from, const std::string& to) {
        return raks::test::replaced(good, from, to);
    };
    const struct {
        std::string text;
        std::string message;
    } table[] = {
        {"", "not JSON (line 1): cut off or edited by hand? fetch or train it again"},
        {"[1, 2]", "not a raks-hmm file"},
        {"{}", "not a raks-hmm file (no \"format\": \"raks-hmm\")"},
        {replaced("raks-hmm", "raks-figure"), "not a raks-hmm file (no \"format\": \"raks-hmm\")"},
        {replaced("\"version\": 1", "\"version\": 2"),
         "version 2 is newer than 1, the newest this program reads; update Raks"},
        {replaced("\"version\": 1", "\"version\": 0.5"),
         "version is 0.5, must be a whole number from 1 to 1000000"},
        {replaced("\"full\"", "\"round\""),
         "covariance_type must be diagonal, full, tied or spherical"},
        {replaced("0.1", "1e999"), "holds a number that is out of range"},
        {replaced("0.1", "null"), "means[0][0] is not a number"},
        {replaced("\"means\"", "\"maens\""), "means is missing"},
        {replaced("0.7", "-0.7"), "covariances[0] is not positive definite (or not symmetric)"},
        {std::string(100, '['), "brackets nest too deep: not a file of Raks"},
    };
    for (const auto& row : table) {
        const Expected<GaussianHmm> model = parse_hmm(row.text);
        ASSERT_FALSE(model) << row.message;
        EXPECT_EQ(model.error().message, row.message);
    }
}

TEST(HmmJson, names_what_is_wrong_in_a_model) {
    const struct {
        void (*spoil)(GaussianHmm&);
        std::string message;
    } table[] = {
        {[](GaussianHmm& m) { m.transition(1, 1) = 0.5; },
         "transition[1] sums to 0.833333 with its exit, must be 1"},
        {[](GaussianHmm& m) { m.initial[0] = -1.0; }, "initial[0] is -1, must lie in [0, 1]"},
        {[](GaussianHmm& m) { m.covariances[1](1, 0) = 0.0; },
         "covariances[1][1] is 0, must lie in [1e-30, 1e+30]"},
        {[](GaussianHmm& m) { m.covariances.pop_back(); },
         "covariances has 1 entries, must have 2"},
        {[](GaussianHmm& m) { m.means(0, 0) = std::nan(""); },
         "means have an entry that is not a finite number"},
        {[](GaussianHmm& m) { m.exit.resize(1); }, "exit has 1 entries, must have 2 or none"},
    };
    for (const auto& row : table) {
        GaussianHmm model = small_model(CovarianceType::diagonal);
        row.spoil(model);
        const Expected<void> ok = validate(model);
        ASSERT_FALSE(ok) << row.message;
        EXPECT_EQ(ok.error().message, row.message);
    }
}

TEST(HmmJson, survives_cuts_at_every_byte_and_flipped_bytes) {
    const std::string good = hmm_text(small_model(CovarianceType::full));
    for (std::size_t length = 0; length + 2 < good.size(); ++length) {
        const Expected<GaussianHmm> model = parse_hmm(std::string_view(good).substr(0, length));
        ASSERT_FALSE(model) << length;
        EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
    }
    const CounterRandom random(11);
    for (std::uint64_t i = 0; i < 2000; ++i) {
        std::string text = good;
        text[random.below(3 * i, text.size())] = static_cast<char>(random.below(3 * i + 1, 256));
        const Expected<GaussianHmm> model = parse_hmm(text);
        if (model) {
            EXPECT_TRUE(validate(*model));
        } else {
            EXPECT_EQ(model.error().message.find('\n'), std::string::npos) << model.error().message;
        }
    }
}

}  // namespace
}  // namespace raks::models
