#include "motion/dance/content_file.hpp"

#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "base/hash.hpp"
#include "base/packer.hpp"
#include "motion/cells/cell_file.hpp"

namespace raks::motion {
namespace {

constexpr std::string_view kBakedMagic = "raks-baked-4\n";  // format and its version
constexpr std::uint32_t kMostFigures = 10'000;              // against absurd counts

void pack_pose(const Pose& pose, Packer& packer) {
    packer.put(pose.local_rotations);
    packer.put(pose.hips_position);
    packer.put(pose.foot_contact);
}

// Whatever byte it is.
bool take_flag(Unpacker& unpacker) { return unpacker.take<std::uint8_t>() != 0; }

Pose unpack_pose(Unpacker& unpacker) {
    Pose pose;
    unpacker.take_into(pose.local_rotations);
    unpacker.take_into(pose.hips_position);
    for (bool& is_down : pose.foot_contact) {
        is_down = take_flag(unpacker);
    }
    return pose;
}

// Fields in a fixed order; unpack_figure() reads them in the same one.
void pack_figure(const LibraryFigure& figure, Packer& packer) {
    packer.put_list(figure.name);
    packer.put(figure.beats);
    packer.put(figure.move);
    packer.put(figure.place);
    packer.put(figure.turns_half);
    for (const std::vector<double>& fist : figure.fist) {
        packer.put_list(fist);
    }
    packer.put(figure.landing_delay);
    packer.put(figure.arms_mix);
    packer.put(figure.learnt_tempo);
    packer.put(figure.size_by_tempo);
    pack_pose(figure.middle.pose, packer);
    packer.put(figure.middle.ankles);
    packer.put(figure.middle.turns_about_it);
    packer.put(figure.middle.comes_back);
    packer.put(static_cast<std::uint32_t>(figure.passages.size()));
    for (const FigurePassage& passage : figure.passages) {
        passage.pack(packer);
    }
}

LibraryFigure unpack_figure(Unpacker& unpacker, const std::shared_ptr<const void>& owner) {
    LibraryFigure figure;
    figure.name = unpacker.take_list<std::string>();
    figure.beats = unpacker.take<int>();
    figure.move = unpacker.take<FloorMove>();
    figure.place = unpacker.take<FloorMove>();
    figure.turns_half = take_flag(unpacker);
    for (std::vector<double>& fist : figure.fist) {
        fist = unpacker.take_list<std::vector<double>>();
    }
    figure.landing_delay = unpacker.take<Nanos>();
    figure.arms_mix = unpacker.take<ArmMixes>();
    unpacker.take_into(figure.learnt_tempo);
    unpacker.take_into(figure.size_by_tempo);
    figure.middle.pose = unpack_pose(unpacker);
    unpacker.take_into(figure.middle.ankles);
    unpacker.take_into(figure.middle.turns_about_it);
    figure.middle.comes_back = take_flag(unpacker);
    const auto passages = unpacker.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < passages && unpacker.is_good(); ++i) {
        figure.passages.push_back(FigurePassage::unpack(unpacker, owner));
    }
    return figure;
}

}  // namespace

std::string pack_content(const DanceContent& content) {
    Packer packer(kBakedMagic);
    packer.put(static_cast<std::uint8_t>(content.cells ? 1 : 0));
    packer.put(content.generator);
    packer.put(content.metre.learnt_tempo);
    packer.put(content.metre.beats_per_bar);
    packer.put(content.couple);
    packer.put(content.stage);
    pack_pose(content.rest, packer);
    packer.put(static_cast<std::uint32_t>(content.figures.size()));
    for (const LibraryFigure& figure : content.figures) {
        pack_figure(figure, packer);
    }
    if (content.cells) {
        pack_graph(*content.cells, packer);
    }
    std::string bytes = packer.take();
    // The hash of everything before it closes the file.
    const std::uint64_t sum = fast_hash_of(bytes);
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    return bytes;
}

namespace {

constexpr std::string_view kCutShort = "is cut short or of another program";
constexpr std::string_view kOtherFigures = "has other figures than the grammar";

// What lies between the magic and the hash. Errors: it is no such file, or damaged.
Expected<std::string_view> body_of(std::string_view bytes) {
    std::uint64_t sum = 0;
    if (!bytes.starts_with(kBakedMagic) || bytes.size() < kBakedMagic.size() + sizeof sum) {
        return fail("is not a dance that was solved");
    }
    // The hash is compared before anything is parsed.
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    bytes.remove_suffix(sizeof sum);
    if (fast_hash_of(bytes) != sum) {
        return fail("is damaged");
    }
    return bytes.substr(kBakedMagic.size());
}

// All before the figures; the skeleton is that which it was solved for.
DanceContent unpack_head(const Skeleton& skeleton, Unpacker& unpacker) {
    DanceContent content;
    content.skeleton = skeleton;
    content.generator = unpacker.take<Generator>();
    unpacker.take_into(content.metre.learnt_tempo);
    unpacker.take_into(content.metre.beats_per_bar);
    content.couple = unpacker.take<FloorMove>();
    content.stage = unpacker.take<FloorMove>();
    content.rest = unpack_pose(unpacker);
    return content;
}

}  // namespace

Expected<DanceContent> unpack_content(const std::shared_ptr<const std::string>& file,
                                      const Skeleton& skeleton,
                                      const FigureGrammar& grammar) {
    const auto body = body_of(*file);
    if (!body) {
        return fail(body.error());
    }
    Unpacker unpacker(*body);
    if (unpacker.take<std::uint8_t>() != 0) {
        return fail(std::string(kOtherFigures));
    }
    DanceContent content = unpack_head(skeleton, unpacker);
    const auto figures = unpacker.take<std::uint32_t>();
    if (figures > kMostFigures || figures != grammar.rules.size()) {
        return fail(std::string(kOtherFigures));
    }
    std::vector<bool> turns_half;
    for (std::uint32_t i = 0; i < figures && unpacker.is_good(); ++i) {
        content.figures.push_back(unpack_figure(unpacker, file));
        turns_half.push_back(content.figures.back().turns_half);
        if (content.figures.back().name != grammar.rules[i].figure ||
            content.figures.back().passages.size() !=
                static_cast<std::size_t>(DanceContent::kPassages)) {
            return fail(std::string(kOtherFigures));
        }
    }
    if (!unpacker.is_good() || !unpacker.at_end()) {
        return fail(std::string(kCutShort));
    }
    content.chooser = FigureChooser(grammar, std::move(turns_half));
    take_rules(grammar, content);
    return content;
}

Expected<DanceContent> unpack_cell_content(const std::shared_ptr<const std::string>& file,
                                           const Skeleton& skeleton) {
    const auto body = body_of(*file);
    if (!body) {
        return fail(body.error());
    }
    Unpacker unpacker(*body);
    if (unpacker.take<std::uint8_t>() != 1) {
        return fail("is not a dance of cells");
    }
    DanceContent content = unpack_head(skeleton, unpacker);
    const auto figures = unpacker.take<std::uint32_t>();
    std::vector<CellTake> takes;
    for (std::uint32_t i = 0; i < figures && unpacker.is_good(); ++i) {
        const LibraryFigure& take = content.figures.emplace_back(unpack_figure(unpacker, file));
        // A piece of a take is read where its samples lie: they must be there.
        if (take.passages.size() != 1 || !take.passages.front().covers(take.beats)) {
            return fail(std::string(kCutShort));
        }
        takes.push_back({take.name, take.beats});
    }
    auto graph = unpack_graph(std::move(takes), unpacker);
    if (!graph) {
        return fail(std::move(graph.error()));
    }
    if (!unpacker.at_end()) {
        return fail(std::string(kCutShort));
    }
    content.cells = std::make_shared<const CellGraph>(std::move(*graph));
    content.stands = cell_stands(content);
    return content;
}

}  // namespace raks::motion
