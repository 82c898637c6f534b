// The file of a dance of cells: what is written is read, and nothing else is.
#include "motion/cells/cell_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "base/hash.hpp"
#include "base/packer.hpp"
#include "tests/support/made_cells.hpp"

namespace raks::motion {
namespace {

constexpr std::string_view kModels = RAKS_SOURCE_DIR "/models/trained";
// Magic and version; then the dance's name of one letter and the licence, each behind its length.
constexpr std::size_t kLicenceAt = 11 + 2 + 4 + 1;

CellDance made() { return test::made_cells(std::string(kModels), "x"); }

std::size_t takes_at() { return kLicenceAt + 4 + made().licence.size(); }

// Where the number of cells lies: in the graph, which ends the file, behind the length of a beat.
std::size_t cells_at(const std::string& good) {
    Packer packer("");
    pack_graph(made().graph, packer);
    return good.size() - sizeof(std::uint64_t) - packer.take().size() + sizeof(double);
}

// With the hash that its bytes have.
std::string closed(std::string bytes) {
    const std::size_t body = bytes.size() - sizeof(std::uint64_t);
    const std::uint64_t sum = fast_hash_of(std::string_view(bytes).substr(0, body));
    std::memcpy(bytes.data() + body, &sum, sizeof sum);
    return bytes;
}

template <typename Number>
std::string with(std::string bytes, std::size_t at, Number number) {
    std::memcpy(bytes.data() + at, &number, sizeof number);
    return closed(std::move(bytes));
}

std::string error_of(const std::string& bytes) {
    const auto read = parse_cells(bytes, "x.cells");
    return read ? std::string() : read.error().message;
}

TEST(CellFile, gives_back_what_was_written) {
    const CellDance before = made();
    const auto after = parse_cells(cell_text(before), "x.cells");
    ASSERT_TRUE(after) << after.error().message;
    EXPECT_EQ(after->licence, before.licence);
    ASSERT_EQ(after->graph.cells.size(), before.graph.cells.size());
    EXPECT_EQ(after->graph.cells[3].beat, before.graph.cells[3].beat);
    EXPECT_EQ(after->graph.cells[3].energy, before.graph.cells[3].energy);
    EXPECT_EQ(after->graph.first_arc, before.graph.first_arc);
    EXPECT_EQ(after->graph.arcs[0].is_mirrored, before.graph.arcs[0].is_mirrored);
    // The rounding is done once.
    EXPECT_TRUE(cell_text(*after) == cell_text(*parse_cells(cell_text(*after), "x.cells")));
}

TEST(CellFile, is_refused_wherever_it_is_cut) {
    const std::string good = cell_text(made());
    for (std::size_t length = 0; length < good.size(); length += 97) {
        std::string cut = good.substr(0, length);
        EXPECT_NE(error_of(cut), "") << length;
        // The end of the file looks right, as if it had been written so.
        if (length > 32) {
            EXPECT_EQ(error_of(closed(cut)).find("x.cells: "), 0U) << length;
            EXPECT_EQ(error_of(closed(cut)).find('\n'), std::string::npos) << length;
        }
    }
}

TEST(CellFile, is_refused_where_a_count_is_absurd) {
    const std::string good = cell_text(made());
    EXPECT_EQ(error_of(with(good, takes_at(), std::uint32_t{0xFFFFFFFF})),
              "x.cells: has 4294967295 takes, must be 1000 at most");
    EXPECT_EQ(error_of(with(good, cells_at(good), std::uint32_t{0xFFFFFFFF})),
              "x.cells: has 4294967295 cells, must be 2048 at most");
    EXPECT_EQ(error_of(with(good, kLicenceAt, std::uint32_t{0xFFFFFFF0})),
              "x.cells: is damaged or cut off");
    // first_arc, and what it says of the arcs
    EXPECT_EQ(error_of(with(good, good.size() - 8 - 4 - 4 - 7 * 4, std::uint32_t{0xFFFFFFF0})),
              "x.cells: is damaged or cut off");
    EXPECT_EQ(error_of(with(good, good.size() - 8 - 4 - 4, std::uint32_t{0xFFFFFFF0})),
              "x.cells: is damaged or cut off");
}

TEST(CellFile, is_refused_where_its_takes_would_fill_the_memory) {
    CellDance many = made();
    many.licence.assign(5000, 'x');
    EXPECT_EQ(error_of(cell_text(many)),
              "x.cells: has a licence of 5000 bytes, must be 4000 at most");
    many = made();
    while (many.takes.size() < 513) {  // of 8 beats
        many.takes.push_back(many.takes.front());
    }
    EXPECT_EQ(error_of(cell_text(many)), "x.cells: its takes have more than 4096 beats together");
}

TEST(CellFile, names_the_version_that_it_does_not_know) {
    const std::string good = cell_text(made());
    const std::string error = error_of(with(good, 11, std::uint16_t{999}));
    EXPECT_EQ(error.find("x.cells: is of version 999, this program reads "), 0U) << error;
}

}  // namespace
}  // namespace raks::motion
