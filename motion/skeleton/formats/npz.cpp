#include "motion/skeleton/formats/npz.hpp"

#include <algorithm>
#include <utility>

#include "base/printable.hpp"
#include "motion/skeleton/formats/npy.hpp"
#include "motion/skeleton/formats/zip_archive.hpp"

namespace raks::motion {

Expected<NpzContent> read_npz(std::string_view bytes, std::span<const std::string_view> names) {
    const auto entries = zip_entries(bytes);
    if (!entries) {
        return fail(entries.error());
    }
    constexpr std::string_view kEnding = ".npy";
    std::size_t left = std::size_t{512} << 20U;  // bytes that may still be unpacked
    NpzContent content;
    for (const ZipEntry& entry : *entries) {
        if (entry.name.size() <= kEnding.size() || !entry.name.ends_with(kEnding)) {
            continue;
        }
        const std::string name = entry.name.substr(0, entry.name.size() - kEnding.size());
        content.names.push_back(name);
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            continue;
        }
        if (content.arrays.contains(name)) {
            return fail(printable(name) + " is packed twice; save the file again");
        }
        const auto packed = unzipped(bytes, entry, left);
        if (!packed) {
            return fail(packed.error());
        }
        left -= packed->size();
        auto array = parse_npy(*packed);
        if (!array) {
            return fail(std::move(array.error()).in(printable(name)));
        }
        content.arrays[name] = std::move(*array);
    }
    return content;
}

}  // namespace raks::motion
