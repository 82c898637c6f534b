// The models and the hostile files of the shared data: what independent readers and Khronos'
// validator say of them is what our reader says.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "base/file.hpp"
#include "render/import/model_reader.hpp"
#include "render/model/model_survey.hpp"
#include "tests/render/import/table.hpp"
#include "tests/support/process.hpp"
#include "tests/support/shared_data.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;
using namespace raks;
using namespace raks::render;
using test::TableRow;

fs::path avatars() { return test::shared_data() / "avatars"; }

/// Models that lie in the repository.
const fs::path kOwnModels = fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "avatars";

class SharedModels : public testing::Test {
 protected:
    void SetUp() override {
        if (!fs::exists(avatars() / "expected.tsv")) {
            GTEST_SKIP() << "no shared data";
        }
    }
};

void expect_count(const TableRow& row, const std::string& column, std::size_t count) {
    if (row.at(column) != "-") {
        EXPECT_EQ(row.at(column), std::to_string(count)) << column;
    } else {
        EXPECT_EQ(count, 0U) << column;
    }
}

/// Three numbers, within 0.1 % of `size`.
void expect_point(const std::string& text, const glm::vec3& point, float size) {
    std::istringstream stream(text);
    glm::vec3 wanted(0.0F);
    stream >> wanted.x >> wanted.y >> wanted.z;
    EXPECT_LT(glm::length(wanted - point), 1e-3F * size) << text;
}

void expect_row(const TableRow& row, const ModelSurvey& found) {
    EXPECT_EQ(found.format, row.at("format"));
    expect_count(row, "nodes", found.nodes);
    expect_count(row, "joints_or_bones", found.joints);
    expect_count(row, "skins", found.skins);
    expect_count(row, "meshes", found.meshes);
    expect_count(row, "primitives", found.primitives);
    expect_count(row, "vertices", found.vertices);
    expect_count(row, "triangles", found.triangles);
    expect_count(row, "max_morphs", found.max_morphs);
    expect_count(row, "images", found.images);
    expect_count(row, "animations", found.animations);
    expect_count(row, "springs", found.springs);
    expect_count(row, "expressions", found.expressions);
    if (row.at("rest_minus_bind_m") != "-") {
        const float wanted = std::stof(row.at("rest_minus_bind_m"));
        EXPECT_NEAR(found.rest_minus_bind.value_or(-1.0F), wanted, 2e-4F + 1e-2F * wanted);
    }
    if (row.at("bbox_min") != "-") {
        ASSERT_TRUE(found.box);
        const float size = glm::length(found.box->high - found.box->low);
        expect_point(row.at("bbox_min"), found.box->low, size);
        expect_point(row.at("bbox_max"), found.box->high, size);
    }
}

/// Every row of the table against the model that it names. Returns how many there were.
int expect_measures(const fs::path& table, const fs::path& models) {
    int found_models = 0;
    for (const TableRow& row : test::read_table(table)) {
        const fs::path file = models / row.at("file");
        if (!is_model_name(file)) {
            continue;
        }
        SCOPED_TRACE(row.at("file"));
        const auto model = load_model(file);
        if (!model) {
            ADD_FAILURE() << model.error().message;
            continue;
        }
        ++found_models;
        expect_row(row, survey(*model));
    }
    return found_models;
}

TEST(OwnModels, are_counted_and_measured_as_by_an_independent_reader) {
    EXPECT_EQ(expect_measures(kOwnModels / "expected.tsv", kOwnModels), 7);
}

TEST_F(SharedModels, are_counted_and_measured_as_by_independent_readers) {
    EXPECT_GE(expect_measures(avatars() / "expected.tsv", avatars() / "models"), 26);
}

/// What a file is said to do: any of what the words of `expected` allow.
void expect_as_told(const fs::path& file, const std::string& expected) {
    const auto model = load_model(file);
    const bool may_be_refused = expected.find("reject") != std::string::npos;
    const bool may_be_read = expected.find("accept") != std::string::npos ||
                             expected.find("repair") != std::string::npos;
    if (!model) {
        EXPECT_TRUE(may_be_refused) << model.error().message;
        EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
        EXPECT_EQ(model.error().message.rfind(file.string() + ": ", 0), 0U)
            << model.error().message;
        return;
    }
    EXPECT_TRUE(may_be_read) << "was read";
    // As it is stored its chunk has 44 bytes, and there is nothing to say.
    const bool is_whole = file.filename() == "zero-sized-bin-chunk-issue-440.glb";
    if (expected.find("warning") != std::string::npos && !is_whole) {
        EXPECT_FALSE(model->warnings.empty()) << "nothing was said";
    }
    (void)survey(*model);
}

TEST_F(SharedModels, that_are_bad_are_refused_or_mended_as_their_index_says) {
    int files = 0;
    for (const TableRow& row : test::read_table(avatars() / "bad" / "INDEX.tsv")) {
        const fs::path file = avatars() / "bad" / row.at("file");
        if (is_model_name(file)) {
            SCOPED_TRACE(row.at("file") + ": " + row.at("what is wrong"));
            expect_as_told(file, row.at("expected"));
            ++files;
        }
    }
    EXPECT_GE(files, 200);
}

TEST_F(SharedModels, that_khronos_validator_finds_faults_in_are_not_read_silently) {
    const test::TemporaryFolder folder;
    const fs::path archive = avatars() / "bad" / "khronos-validator-base.tar.xz";
    test::ProcessPlan unpack;
    unpack.command = {"tar", "xf", archive.string(), "-C", folder.path().string()};
    ASSERT_EQ(test::run_process(unpack).exit_code, 0);
    for (const TableRow& row : test::read_table(avatars() / "bad" / "khronos.tsv")) {
        const fs::path file = folder.path() / row.at("file");
        if (!is_model_name(file)) {
            continue;
        }
        SCOPED_TRACE(row.at("file") + ": " + row.at("error_codes"));
        const auto model = load_model(file);
        if (row.at("errors") != "0") {
            EXPECT_TRUE(!model || !model->warnings.empty()) << "read without a word";
        } else if (row.at("warnings") == "0") {
            // Two are whole but for the bytes of their meshes.
            const bool has_no_bytes =
                !model && model.error().message.find("are not in the file") != std::string::npos;
            EXPECT_TRUE(model || has_no_bytes) << model.error().message;
        }
    }
}

}  // namespace
