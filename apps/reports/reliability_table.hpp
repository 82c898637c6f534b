#pragma once

#include <string>
#include <vector>

#include "audio/evaluate/reliability.hpp"
#include "base/json.hpp"

/// How often what is said with some confidence is right, as a table and in JSON.
/// Threads: any. Real-time: no.
namespace raks::apps {

/// Claims of one kind: two columns of the table.
struct ReliabilityColumn {
    std::string name;  ///< what was said: "beats"
    std::vector<audio::Claim> claims;
};

/// A table in Markdown. Rows: the bins of audio/evaluate/reliability.hpp, by confidence; columns:
/// of each kind how many claims were made with it, and how many of these were right, in per cent.
/// `head`: of the first column.
[[nodiscard]] std::string reliability_table(const std::string& head,
                                            const std::vector<ReliabilityColumn>& columns);

/// A list of the bins, each with `claims` and `right`.
[[nodiscard]] Json reliability_json(const std::vector<audio::Claim>& claims);

}  // namespace raks::apps
