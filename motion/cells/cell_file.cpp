#include "motion/cells/cell_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/packer.hpp"
#include "motion/figures/figure_hmm.hpp"

namespace raks::motion {
namespace {

constexpr std::string_view kMagic = "raks-cells\n";
constexpr std::uint16_t kVersion = 2;
constexpr std::uint32_t kMostTakes = 1000;
constexpr std::size_t kMostLicenceBytes = 4000;  // each take has it again

// IEEE 754 binary16 by rounding to nearest, ties to even.
std::uint16_t half_of(double number) {
    const float value = static_cast<float>(std::clamp(number, -65504.0, 65504.0));
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    const auto sign = static_cast<std::uint16_t>((bits >> 16U) & 0x8000U);
    const float size = std::abs(value);
    if (size < 6.103515625e-05F) {  // subnormal: steps of 2^-24
        return static_cast<std::uint16_t>(
            sign | static_cast<std::uint16_t>(std::nearbyint(size * 16777216.0F)));
    }
    int exponent = 0;
    const float mantissa = std::frexp(size, &exponent);  // [0.5, 1)
    auto steps = static_cast<std::uint32_t>(std::nearbyint(mantissa * 2048.0F));
    if (steps == 2048U) {
        steps = 1024U;
        ++exponent;
    }
    return static_cast<std::uint16_t>(
        sign | ((static_cast<std::uint32_t>(exponent + 14) << 10U) + (steps - 1024U)));
}

double number_of(std::uint16_t half) {
    const double sign = (half & 0x8000U) != 0 ? -1.0 : 1.0;
    const int exponent = (half >> 10U) & 0x1F;
    const int mantissa = half & 0x3FF;
    return exponent == 0 ? sign * std::ldexp(mantissa, -24)
                         : sign * std::ldexp(1024 + mantissa, exponent - 25);
}

void put_halves(const std::vector<double>& values, Packer& packer) {
    for (const double value : values) {
        packer.put(half_of(value));
    }
}

std::vector<double> take_halves(Unpacker& unpacker, std::size_t count) {
    std::vector<double> values;
    values.reserve(std::min<std::size_t>(count, 4096));
    for (std::size_t i = 0; i < count && unpacker.is_good(); ++i) {
        values.push_back(number_of(unpacker.take<std::uint16_t>()));
    }
    return values;
}

// By part: joints with their mean rotations, the variances that all states share, then the means of
// every state.
void put_part(const PartModel& part, Packer& packer) {
    packer.put(static_cast<std::uint8_t>(part.joints.size()));
    for (const JointFeature& joint : part.joints) {
        packer.put(static_cast<std::uint8_t>(joint.bone));
        packer.put(std::array<double, 4>{joint.mean.w, joint.mean.x, joint.mean.y, joint.mean.z});
    }
    const FigureState& any = part.states.front();
    for (const auto* variances : {&any.variance, &any.delta_variance, &any.delta_delta_variance}) {
        for (const double variance : *variances) {
            packer.put(variance);
        }
    }
    for (const FigureState& state : part.states) {
        put_halves(state.mean, packer);
        put_halves(state.delta_mean, packer);
        put_halves(state.delta_delta_mean, packer);
    }
}

// What a chain of states on equal slices of the phase has besides: it goes on after as many samples
// as its slice has.
void complete(PartModel& part, int samples) {
    const std::size_t n = part.states.size();
    const std::size_t d = part.dimension();
    const double stay = 1.0 - static_cast<double>(n) / samples;
    part.initial.assign(n, 0.0);
    part.initial[0] = 1.0;
    part.exit.assign(n, 0.0);
    part.exit[n - 1] = 1.0 - stay;
    part.transition.assign(n, std::vector<double>(n, 0.0));
    for (std::size_t k = 0; k < n; ++k) {
        part.transition[k][k] = stay;
        if (k + 1 < n) {
            part.transition[k][k + 1] = 1.0 - stay;
        }
    }
    part.covariance.assign(d, std::vector<double>(d, 0.0));
    for (std::size_t i = 0; i < d; ++i) {
        part.covariance[i][i] = part.states.front().variance[i];
    }
    part.global_variance.assign(d, 1e-10);
}

PartModel take_part(Part which, int beats, Unpacker& unpacker) {
    PartModel part;
    part.part = which;
    const std::size_t joints = std::min<std::size_t>(unpacker.take<std::uint8_t>(), kBoneCount);
    for (std::size_t j = 0; j < joints; ++j) {
        JointFeature joint;
        joint.bone = static_cast<Bone>(
            std::min<std::uint8_t>(unpacker.take<std::uint8_t>(), kBoneCount - 1));
        const auto mean = unpacker.take<std::array<double, 4>>();
        joint.mean = {mean[0], mean[1], mean[2], mean[3]};
        part.joints.push_back(joint);
    }
    const std::size_t d = part.dimension();
    std::array<std::vector<double>, 3> variances;
    for (std::vector<double>& own : variances) {
        for (std::size_t i = 0; i < d; ++i) {
            own.push_back(unpacker.take<double>());
        }
    }
    for (int k = 0; k < kStatesPerBeat * beats && unpacker.is_good(); ++k) {
        FigureState& state = part.states.emplace_back();
        state.mean = take_halves(unpacker, d);
        state.delta_mean = take_halves(unpacker, d);
        state.delta_delta_mean = take_halves(unpacker, d);
        state.variance = variances[0];
        state.delta_variance = variances[1];
        state.delta_delta_variance = variances[2];
    }
    return part;
}

void put_take(const FigureModel& take, Packer& packer) {
    packer.put_list(take.name);
    packer.put(static_cast<std::uint16_t>(take.beats));
    for (const double value : {take.learnt_tempo.bpm(),
                               take.net_displacement.x,
                               take.net_displacement.y,
                               take.net_turn,
                               take.source_hips_height,
                               take.peak_toe_speed}) {
        packer.put(value);
    }
    for (const auto& chances : take.contact) {
        for (const double chance : chances) {
            packer.put(static_cast<std::uint8_t>(chance > 0.5 ? 1 : 0));
        }
    }
    for (const PartModel& part : take.parts) {
        put_part(part, packer);
    }
}

FigureModel take_take(const CellDance& dance, Unpacker& unpacker) {
    FigureModel take;
    take.name = unpacker.take_list<std::string>();
    take.dance = dance.dance;
    take.attribution = dance.licence;
    take.beats = std::clamp<int>(unpacker.take<std::uint16_t>(), 1, 64);
    take.samples_per_beat = kCellSamples;
    take.repeats = 1;
    take.learnt_tempo = Bpm(unpacker.take<double>());
    take.net_displacement.x = unpacker.take<double>();
    take.net_displacement.y = unpacker.take<double>();
    take.net_turn = unpacker.take<double>();
    take.source_hips_height = unpacker.take<double>();
    take.peak_toe_speed = unpacker.take<double>();
    for (auto& chances : take.contact) {
        chances.resize(std::size_t{kContactBinsPerBeat} * static_cast<std::size_t>(take.beats));
        for (double& chance : chances) {
            chance = unpacker.take<std::uint8_t>() != 0 ? 1.0 : 0.0;
        }
    }
    for (auto& landings : take.landings) {
        landings.resize(static_cast<std::size_t>(take.beats));  // see give_landings()
    }
    for (const Part which : kParts) {
        take.parts.push_back(take_part(which, take.beats, unpacker));
        if (!unpacker.is_good()) {
            break;
        }
        complete(take.parts.back(), static_cast<int>(take.samples()));
        set_sliced_timing(take.beats, take.samples_per_beat, take.parts.back());
    }
    return take;
}

}  // namespace

void pack_graph(const CellGraph& graph, Packer& packer) {
    packer.put(graph.beat_seconds);
    packer.put(static_cast<std::uint32_t>(graph.cells.size()));
    for (const Cell& cell : graph.cells) {
        packer.put(cell.take);
        packer.put(cell.beat);
        packer.put(std::array<float, 5>{
            cell.energy, cell.turn, cell.way.x, cell.way.y, cell.speed_at_end});
        packer.put(cell.landings);
        packer.put(static_cast<std::uint8_t>((cell.is_second_half ? 1U : 0U) |
                                             (cell.stands_at_end ? 2U : 0U)));
    }
    packer.put_list(graph.first_arc);
    for (const CellArc& arc : graph.arcs) {
        packer.put(arc.to);
        // Millimetres, with the side in the lowest bit.
        const auto distance =
            static_cast<std::uint16_t>(std::clamp(std::lround(arc.distance * 10.0F), 0L, 32767L));
        packer.put(static_cast<std::uint16_t>(2U * distance + (arc.is_mirrored ? 1U : 0U)));
    }
}

Expected<CellGraph> unpack_graph(std::vector<CellTake> takes, Unpacker& unpacker) {
    CellGraph graph;
    graph.takes = std::move(takes);
    graph.beat_seconds = unpacker.take<double>();
    const auto cells = unpacker.take<std::uint32_t>();
    if (cells > kMostCells) {
        return fail(fmt::format("has {} cells, must be {} at most", cells, kMostCells));
    }
    for (std::uint32_t i = 0; i < cells && unpacker.is_good(); ++i) {
        Cell cell;
        cell.take = unpacker.take<std::uint16_t>();
        cell.beat = unpacker.take<std::uint16_t>();
        const auto values = unpacker.take<std::array<float, 5>>();
        cell.energy = values[0];
        cell.turn = values[1];
        cell.way = {values[2], values[3]};
        cell.speed_at_end = values[4];
        cell.landings = unpacker.take<std::array<float, 2>>();
        const auto flags = unpacker.take<std::uint8_t>();
        cell.is_second_half = (flags & 1U) != 0;
        cell.stands_at_end = (flags & 2U) != 0;
        graph.cells.push_back(cell);
    }
    graph.first_arc = unpacker.take_list<std::vector<std::uint32_t>>();
    const std::uint32_t arcs = graph.first_arc.empty() ? 0 : graph.first_arc.back();
    for (std::uint32_t i = 0; i < arcs && unpacker.is_good(); ++i) {
        CellArc arc;
        arc.to = unpacker.take<std::uint16_t>();
        const auto packed = unpacker.take<std::uint16_t>();
        arc.is_mirrored = (packed & 1U) != 0;
        const std::uint32_t millimetres = packed / 2U;
        arc.distance = static_cast<float>(millimetres) * 0.1F;
        graph.arcs.push_back(arc);
    }
    if (!unpacker.is_good()) {
        return fail("is damaged or cut off");
    }
    if (auto ok = validate(graph); !ok) {
        return fail(std::move(ok.error()));
    }
    sort_energies(graph);
    return graph;
}

std::string cell_text(const CellDance& dance) {
    Packer packer(kMagic);
    packer.put(kVersion);
    packer.put_list(dance.dance);
    packer.put_list(dance.licence);
    packer.put(static_cast<std::uint32_t>(dance.takes.size()));
    for (const FigureModel& take : dance.takes) {
        put_take(take, packer);
    }
    pack_graph(dance.graph, packer);
    std::string bytes = packer.take();
    const std::uint64_t sum = fast_hash_of(bytes);
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    return bytes;
}

Expected<CellDance> parse_cells(std::string_view bytes, const std::string& name) {
    std::uint64_t sum = 0;
    if (!bytes.starts_with(kMagic) || bytes.size() < kMagic.size() + sizeof kVersion + sizeof sum) {
        return fail(name + ": is no dance of cells (raks-cells)");
    }
    std::uint16_t version = 0;
    std::memcpy(&version, bytes.data() + kMagic.size(), sizeof version);
    if (version != kVersion) {
        return fail(
            fmt::format("{}: is of version {}, this program reads {}", name, version, kVersion));
    }
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    bytes.remove_suffix(sizeof sum);
    if (fast_hash_of(bytes) != sum) {
        return fail(name + ": is damaged or cut off");
    }
    Unpacker unpacker(bytes.substr(kMagic.size() + sizeof version));
    CellDance dance;
    dance.dance = unpacker.take_list<std::string>();
    dance.licence = unpacker.take_list<std::string>();
    const auto takes = unpacker.take<std::uint32_t>();
    if (dance.licence.size() > kMostLicenceBytes) {
        return fail(fmt::format("{}: has a licence of {} bytes, must be {} at most",
                                name,
                                dance.licence.size(),
                                kMostLicenceBytes));
    }
    if (takes > kMostTakes) {
        return fail(fmt::format("{}: has {} takes, must be {} at most", name, takes, kMostTakes));
    }
    std::vector<CellTake> stretches;
    int beats = 0;
    for (std::uint32_t i = 0; i < takes && unpacker.is_good(); ++i) {
        dance.takes.push_back(take_take(dance, unpacker));
        if (!unpacker.is_good()) {
            break;
        }
        const FigureModel& take = dance.takes.back();
        stretches.push_back({take.name, take.beats});
        beats += take.beats;
        if (beats > kMostTakeBeats) {
            return fail(fmt::format(
                "{}: its takes have more than {} beats together", name, kMostTakeBeats));
        }
        if (auto ok = validate(take); !ok) {
            return fail(std::move(ok.error()).in(fmt::format("{}: takes[{}]", name, i)));
        }
    }
    auto graph = unpack_graph(std::move(stretches), unpacker);
    if (!graph) {
        return fail(std::move(graph.error()).in(name));
    }
    if (!unpacker.at_end()) {
        return fail(name + ": is damaged or cut off");
    }
    dance.graph = std::move(*graph);
    give_landings(dance);
    return dance;
}

Expected<CellDance> load_cells(const std::filesystem::path& path) {
    const auto bytes = read_file(path, kMostCellBytes);
    return bytes ? parse_cells(*bytes, path.filename().string()) : fail(bytes.error());
}

}  // namespace raks::motion
