#include "training/cells/take_grid.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace raks::motion {

std::vector<TakeGrid> grids_of(std::span<const TakeBeat> beats) {
    std::vector<TakeGrid> grids;
    for (const TakeBeat& beat : beats) {
        const auto found = std::find_if(grids.begin(), grids.end(), [&](const TakeGrid& grid) {
            return grid.take == beat.take;
        });
        TakeGrid& grid =
            found != grids.end() ? *found : grids.emplace_back(TakeGrid{beat.take, {}});
        grid.beats.push_back({beat.time, beat.half, beat.is_used});
    }
    return grids;
}

std::string grids_text(std::span<const TakeGrid> grids, std::span<const std::string> remarks) {
    std::string text;
    for (const std::string& remark : remarks) {
        text += "# " + remark + "\n";
    }
    text += "take\ttime\thalf\tused\n";
    for (const TakeGrid& grid : grids) {
        for (const GridBeat& beat : grid.beats) {
            text += fmt::format(
                "{}\t{}\t{}\t{}\n", grid.take, beat.time, beat.half, beat.is_used ? 1 : 0);
        }
    }
    return text;
}

Expected<void> check_grid(const TakeGrid& grid, double seconds) {
    const auto beyond = std::find_if(grid.beats.begin(),
                                     grid.beats.end(),
                                     [&](const GridBeat& beat) { return beat.time > seconds; });
    if (beyond == grid.beats.end()) {
        return {};
    }
    return fail(fmt::format("{}: beat {} lies at {:.3f} s, the clip ends at {:.3f} s",
                            grid.take,
                            beyond - grid.beats.begin() + 1,
                            beyond->time,
                            seconds));
}

}  // namespace raks::motion
