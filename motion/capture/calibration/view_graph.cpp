#include "motion/capture/calibration/view_graph.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>

#include "base/printable.hpp"

namespace raks::capture {

namespace {

std::string view_count(std::size_t count) {
    return fmt::format("{} view{}", count, count == 1 ? "" : "s");
}

// The strongest join between a camera that is reached and one that is not.
std::optional<Join> strongest_join(const SharedViews& shared, const std::vector<bool>& is_reached) {
    std::optional<Join> best;
    for (std::size_t from = 0; from < shared.cameras(); ++from) {
        for (std::size_t to = 0; to < shared.cameras(); ++to) {
            if (is_reached[from] && !is_reached[to] &&
                (!best || shared.between(from, to) > best->shared)) {
                best = Join{from, to, shared.between(from, to)};
            }
        }
    }
    return best;
}

}  // namespace

SharedViews::SharedViews(const std::vector<Sighting>& sightings, std::size_t cameras)
    : cameras_(cameras), counts_(cameras * cameras, 0) {
    std::map<std::size_t, std::set<std::size_t>> seen_by;
    for (const Sighting& sighting : sightings) {
        seen_by[sighting.moment].insert(sighting.camera);
    }
    for (const auto& [moment, who] : seen_by) {
        for (const std::size_t a : who) {
            for (const std::size_t b : who) {
                counts_[a * cameras_ + b] += a != b ? 1U : 0U;
            }
        }
    }
}

Expected<std::vector<Join>> joins_of(const SharedViews& shared,
                                     const std::vector<std::string>& names) {
    std::vector<Join> joins;
    std::vector<bool> is_reached(shared.cameras(), false);
    if (!is_reached.empty()) {
        is_reached[0] = true;
    }
    while (joins.size() + 1 < shared.cameras()) {
        const Join join = *strongest_join(shared, is_reached);
        if (join.shared < kFewestShared) {
            return fail(fmt::format(
                "cameras \"{}\" and \"{}\" share {}, {} or more are needed to join them; film the "
                "board where both see it",
                printable(names[join.from]),
                printable(names[join.to]),
                view_count(join.shared),
                kFewestShared));
        }
        is_reached[join.to] = true;
        joins.push_back(join);
    }
    return joins;
}

std::vector<std::string> weak_joins(const std::vector<Join>& joins,
                                    const std::vector<std::string>& names) {
    std::vector<std::string> lines;
    for (const Join& join : joins) {
        if (join.shared < kFewShared) {
            lines.push_back(
                fmt::format("cameras \"{}\" and \"{}\" share {} only; {} or more are better",
                            printable(names[join.from]),
                            printable(names[join.to]),
                            view_count(join.shared),
                            kFewShared));
        }
    }
    return lines;
}

}  // namespace raks::capture
