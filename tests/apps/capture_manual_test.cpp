// The page for dancers shows the marker set that is shipped.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/file.hpp"
#include "motion/capture/markers/marker_set.hpp"

#include <fmt/format.h>

namespace raks::capture {
namespace {

std::string text_of(const char* document) {
    const auto text = read_file(std::filesystem::path(RAKS_SOURCE_DIR) / document);
    EXPECT_TRUE(text) << document;
    return text.value_or("");
}

/// The row of a marker in the page's table of places.
std::string row_of(const std::string& page, const std::string& marker) {
    const std::size_t begin = page.find(fmt::format("\n| {} |", marker));
    return begin == std::string::npos
               ? ""
               : page.substr(begin + 1, page.find('\n', begin + 1) - begin - 1);
}

TEST(CaptureManual, has_the_colour_of_every_marker) {
    const std::string page = text_of("docs/using/capture.md");
    const std::string drawing = text_of("docs/pictures/capture_markers.svg");
    const MarkerSet set = default_markers();
    for (const Marker& marker : set.markers) {
        EXPECT_NE(drawing.find(fmt::format("<title>{}: {}</title>", marker.name, marker.colour)),
                  std::string::npos)
            << marker.name;
        if (!marker.name.starts_with("left_")) {
            continue;
        }
        const std::string name = marker.name.substr(5);
        const auto right = set.index_of("right_" + name);
        ASSERT_TRUE(right) << name;
        EXPECT_TRUE(
            row_of(page, name)
                .ends_with(fmt::format("| {} | {} |", marker.colour, set.markers[*right].colour)))
            << row_of(page, name);
    }
    for (const char* const name : {"head", "c7", "sternum", "sacrum"}) {
        const Marker& marker = set.markers[*set.index_of(name)];
        EXPECT_TRUE(row_of(page, name).ends_with(fmt::format("| {} | |", marker.colour)))
            << row_of(page, name);
    }
}

}  // namespace
}  // namespace raks::capture
