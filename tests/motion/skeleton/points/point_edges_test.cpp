#include "motion/skeleton/points/point_edges.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace raks::motion {
namespace {

using Names = std::vector<std::string>;

TEST(PointEdges, are_two_names_a_line_however_they_are_apart) {
    const auto edges =
        parse_edges("# leg\r\nRHip RKnee # thigh\nRKnee,RAnkle\n\n\t\"a b\" ; c#\n", "x.txt");
    ASSERT_TRUE(edges) << edges.error().message;
    ASSERT_EQ(edges->size(), 3U);
    EXPECT_EQ((*edges)[0].from + "-" + (*edges)[0].to, "RHip-RKnee");
    EXPECT_EQ((*edges)[1].line, 3U);
    EXPECT_EQ((*edges)[2].from + "-" + (*edges)[2].to, "a b-c");
}

TEST(PointEdges, that_are_none_are_refused_with_their_line) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "x.txt: has no edges; give two names a line"},
        {"# only this\n", "x.txt: has no edges; give two names a line"},
        {"a b\nc\n",
         "x.txt: line 2: 1 name, must be two: the points that are joined, such as \"RHip RKnee\""},
        {"a b c\n",
         "x.txt: line 1: 3 names, must be two: the points that are joined, such as \"RHip RKnee\""},
        {"a a\n", "x.txt: line 1: joins \"a\" with itself"},
        {"a \"b\n", "x.txt: line 1: a quote is not closed"},
        {std::string("a\0b c\n", 6), "x.txt: is not a text; an edges file has two names a line"},
    };
    for (const auto& [text, message] : cases) {
        const auto edges = parse_edges(text, "x.txt");
        ASSERT_FALSE(edges) << text;
        EXPECT_EQ(edges.error().message, message);
    }
    std::string many;
    for (int i = 0; i <= 10'000; ++i) {
        many += "a b" + std::to_string(i) + "\n";
    }
    EXPECT_EQ(parse_edges(many, "x.txt").error().message,
              "x.txt: line 10001: more than 10000 edges");
}

TEST(PointEdges, that_name_no_point_are_named_and_the_rest_is_kept) {
    const auto edges = parse_edges("b a\na b\na x\ny x\nb c\n", "x.txt");
    ASSERT_TRUE(edges);
    const FoundEdges found = find_edges(*edges, Names{"a", "b", "c", "a"});
    EXPECT_EQ(found.edges, (std::vector<PointEdge>{{0, 1}, {1, 2}}));
    EXPECT_EQ(found.unknown, (Names{"x", "y"}));
    EXPECT_EQ(found.left_out, 2U);
}

TEST(PointEdges, of_known_sets_are_found_under_many_ways_of_writing) {
    for (const std::string_view set : known_edge_sets()) {
        const auto edges = edges_of_set(set);
        ASSERT_TRUE(edges);
        Names names;
        for (const NamedEdge& edge : *edges) {
            names.push_back(edge.from);
            names.push_back(edge.to);
        }
        EXPECT_EQ(find_set_edges(set, names).edges.size(), edges->size()) << set;
    }
    EXPECT_FALSE(edges_of_set("body26"));
    EXPECT_EQ(find_set_edges("coco", Names{"left_knee", "Left-Ankle", "r.knee", "RAnkle"}).edges,
              (std::vector<PointEdge>{{0, 1}, {2, 3}}));
    EXPECT_EQ(find_set_edges("body25", Names{"CHip", "Neck", "tail"}).edges,
              (std::vector<PointEdge>{{0, 1}}));
    EXPECT_EQ(find_set_edges("coco", Names{"13", "15"}).edges, (std::vector<PointEdge>{{0, 1}}))
        << "points that are but numbers";
    EXPECT_TRUE(find_set_edges("coco", Names{"tail"}).edges.empty());
}

}  // namespace
}  // namespace raks::motion
