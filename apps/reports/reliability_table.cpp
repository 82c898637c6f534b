#include "apps/reports/reliability_table.hpp"

#include "apps/reports/text_table.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// ".3-.4"; the last one ends at 1.
std::string bin_name(std::size_t bin) {
    const bool is_last = bin + 1 == audio::kReliabilityBins;
    return is_last ? fmt::format(".{}-1", bin) : fmt::format(".{}-.{}", bin, bin + 1);
}
static_assert(audio::kReliabilityBins == 10, "the names are of tenths");

std::string right_of(const audio::ReliabilityBin& bin) {
    if (bin.claims == 0) {
        return "-";
    }
    return fmt::format("{:.1f}",
                       100.0 * static_cast<double>(bin.right) / static_cast<double>(bin.claims));
}

}  // namespace

std::string reliability_table(const std::string& head,
                              const std::vector<ReliabilityColumn>& columns) {
    std::vector<Row> rows = {{head}};
    for (std::size_t bin = 0; bin < audio::kReliabilityBins; ++bin) {
        rows.push_back({bin_name(bin)});
    }
    for (const ReliabilityColumn& column : columns) {
        rows.front().insert(rows.front().end(), {column.name, "right"});
        const audio::ReliabilityCurve curve = audio::reliability_of(column.claims);
        for (std::size_t bin = 0; bin < curve.size(); ++bin) {
            Row& row = rows[bin + 1];
            row.insert(row.end(), {std::to_string(curve[bin].claims), right_of(curve[bin])});
        }
    }
    return text_table(rows);
}

Json reliability_json(const std::vector<audio::Claim>& claims) {
    Json bins = Json::array();
    for (const audio::ReliabilityBin& bin : audio::reliability_of(claims)) {
        bins.push_back({{"claims", bin.claims}, {"right", bin.right}});
    }
    return bins;
}

}  // namespace raks::apps
