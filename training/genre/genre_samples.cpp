#include "training/genre/genre_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include "audio/evaluate/genre_scores.hpp"
#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/genre_scorer.hpp"
#include "base/dice.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSamplesFormat = "raks-genre-samples-";  // without the version
constexpr std::string_view kSamplesMagic = "raks-genre-samples-3\n";
constexpr std::size_t kMostBytes = std::size_t{64} << 20U;  // of a file, 64 MiB
constexpr std::size_t kStretch = 1'200;                     // hops of a stretch, 12 s
constexpr std::size_t kShortestStretch = 600;  // hops that a further stretch of a piece must have
constexpr std::size_t kMostPieces = 4'096;     // bounds what a damaged file can allocate
constexpr float kQuietest = 1e-7F;             // mel magnitude: floor of the logarithm
constexpr float kMostNumber = 1e9F;            // larger numbers in a file mean damage
constexpr std::size_t kMel = BarPatterns::kMelBands;
constexpr std::size_t kPatterns = BarPatterns::kFeatures;

/// Rows of numbers in 8 bits each: value = low + step * byte, with a scale for each column.
struct Table {
    struct Column {
        float low = 0.0F;
        float step = 0.0F;
    };
    std::vector<Column> columns;
    std::vector<std::uint8_t> bytes;
};

/// Quantizes rows x columns numbers, given by `at(row, column)`.
template <class At>
Table table_of(std::size_t rows, std::size_t columns, const At& at) {
    Table table;
    table.columns.resize(columns);
    table.bytes.resize(rows * columns);
    for (std::size_t c = 0; c < columns && rows > 0; ++c) {
        float low = std::numeric_limits<float>::max();
        float high = std::numeric_limits<float>::lowest();
        for (std::size_t r = 0; r < rows; ++r) {
            low = std::min(low, at(r, c));
            high = std::max(high, at(r, c));
        }
        // 255 steps between the column's extremes; a constant column has step 0.
        const float step = (high - low) / 255.0F;
        table.columns[c] = {low, step};
        for (std::size_t r = 0; r < rows; ++r) {
            table.bytes[r * columns + c] =
                static_cast<std::uint8_t>(step > 0.0F ? std::lround((at(r, c) - low) / step) : 0);
        }
    }
    return table;
}

// The quantized number, restored.
float number_in(const Table& table, std::size_t row, std::size_t column) {
    const Table::Column& scale = table.columns[column];
    return scale.low +
           scale.step * static_cast<float>(table.bytes[row * table.columns.size() + column]);
}

void pack_table(const Table& table, Packer& packer) {
    packer.put_list(table.columns);
    packer.put_list(table.bytes);
}

// Checks the scales too: a damaged one would yield infinite features.
Expected<Table> unpack_table(std::size_t rows, std::size_t columns, Unpacker& unpacker) {
    Table table;
    table.columns = unpacker.take_list<std::vector<Table::Column>>();
    table.bytes = unpacker.take_list<std::vector<std::uint8_t>>();
    const bool is_sane =
        std::all_of(table.columns.begin(), table.columns.end(), [](const Table::Column& column) {
            return std::abs(column.low) < kMostNumber && column.step >= 0.0F &&
                   column.step < kMostNumber;
        });
    if (!unpacker.is_good() || table.columns.size() != columns ||
        table.bytes.size() != rows * columns || !is_sane) {
        return fail("is cut short or damaged");
    }
    return table;
}

// One stretch in the file's order; unpack_stretch reads the same. Mel magnitudes go in as
// logarithms, because 8 linear bits would lose the quiet ones.
void pack_stretch(const PieceFeatures& piece, Packer& packer) {
    packer.put_list(piece.name);
    packer.put_list(piece.group);
    packer.put_list(piece.genre);
    packer.put(piece.kind);
    const std::size_t hops = piece.frames.size();
    packer.put(static_cast<std::uint32_t>(hops));
    pack_table(
        table_of(
            hops, kMfccFeatures, [&](std::size_t r, std::size_t c) { return piece.frames[r][c]; }),
        packer);
    pack_table(table_of(hops,
                        kMel,
                        [&](std::size_t r, std::size_t c) {
                            return std::log(std::max(piece.mel[r * kMel + c], kQuietest));
                        }),
               packer);
    packer.put(static_cast<std::uint32_t>(piece.windows.size()));
    for (const WindowFeatures& window : piece.windows) {
        packer.put(static_cast<std::uint16_t>(window.segments));
        packer.put(static_cast<std::uint16_t>(window.end_frame));
    }
    pack_table(table_of(piece.windows.size(),
                        kPatterns,
                        [&](std::size_t r, std::size_t c) { return piece.windows[r].features[c]; }),
               packer);
}

// A window must end within its stretch and have its full length of frames before that end.
Expected<void> unpack_windows(PieceFeatures& piece, Unpacker& unpacker) {
    const std::size_t count = unpacker.take<std::uint32_t>();
    if (count > kStretch) {
        return fail("is damaged");
    }
    piece.windows.resize(count);
    for (WindowFeatures& window : piece.windows) {
        window.segments = unpacker.take<std::uint16_t>();
        window.end_frame = unpacker.take<std::uint16_t>();
        if (window.segments < 1 || window.segments > BarPatterns::kSegments ||
            window.end_frame < window.segments * BarPatterns::kSegmentHops ||
            window.end_frame > static_cast<int>(piece.frames.size())) {
            return fail("is cut short or damaged");
        }
    }
    const auto features = unpack_table(count, kPatterns, unpacker);
    if (!features) {
        return fail(features.error());
    }
    for (std::size_t r = 0; r < count; ++r) {
        for (std::size_t c = 0; c < kPatterns; ++c) {
            piece.windows[r].features[c] = number_in(*features, r, c);
        }
    }
    return {};
}

// Counterpart of pack_stretch; every count is checked before memory is taken.
Expected<PieceFeatures> unpack_stretch(Unpacker& unpacker) {
    PieceFeatures piece;
    piece.name = unpacker.take_list<std::string>();
    piece.group = unpacker.take_list<std::string>();
    piece.genre = unpacker.take_list<std::string>();
    piece.kind = unpacker.take<PieceFeatures::Kind>();
    const std::size_t hops = unpacker.take<std::uint32_t>();
    if (hops > kStretch || (!piece.genre.empty() && !is_dance_name(piece.genre)) ||
        piece.kind > PieceFeatures::Kind::written_held_out) {
        return fail("is damaged");
    }
    const auto frames = unpack_table(hops, kMfccFeatures, unpacker);
    const auto mel = unpack_table(hops, kMel, unpacker);
    if (!frames || !mel) {
        return fail("is cut short or damaged");
    }
    piece.frames.resize(hops);
    piece.mel.resize(hops * kMel);
    for (std::size_t r = 0; r < hops; ++r) {
        for (std::size_t c = 0; c < kMfccFeatures; ++c) {
            piece.frames[r][c] = number_in(*frames, r, c);
        }
        for (std::size_t c = 0; c < kMel; ++c) {
            piece.mel[r * kMel + c] = std::min(std::exp(number_in(*mel, r, c)), kMostNumber);
        }
    }
    if (auto done = unpack_windows(piece, unpacker); !done) {
        return fail(done.error());
    }
    return piece;
}

/// Hops [from, from + kStretch) of a piece, and the windows that lie wholly in them.
PieceFeatures stretch_of(const PieceFeatures& piece, std::size_t from) {
    const std::size_t until = std::min(from + kStretch, piece.frames.size());
    const auto at = [](std::size_t index) { return static_cast<std::ptrdiff_t>(index); };
    PieceFeatures stretch;
    stretch.name = piece.name;
    stretch.group = piece.group;
    stretch.genre = piece.genre;
    stretch.kind = piece.kind;
    stretch.frames.assign(piece.frames.begin() + at(from), piece.frames.begin() + at(until));
    stretch.mel.assign(piece.mel.begin() + at(from * kMel), piece.mel.begin() + at(until * kMel));
    for (WindowFeatures window : piece.windows) {
        // Frame numbers within the stretch; may be negative for windows before it.
        window.end_frame -= static_cast<int>(from);
        if (window.end_frame >= window.segments * BarPatterns::kSegmentHops &&
            window.end_frame <= static_cast<int>(until - from)) {
            stretch.windows.push_back(window);
        }
    }
    return stretch;
}

// A stretch that may be taken.
struct Place {
    const PieceFeatures* piece;
    std::size_t from;
};

// Fisher-Yates with the sample's own random numbers.
void shuffle(std::vector<Place>& places, Dice& dice) {
    for (std::size_t i = places.size(); i > 1; --i) {
        const int other = dice.whole(0, static_cast<int>(i) - 1);
        std::swap(places[i - 1], places[static_cast<std::size_t>(other)]);
    }
}

/// Takes one place of each group, then the next of each, until all are taken: no artist dominates.
std::vector<Place> groups_in_turn(std::map<std::string, std::vector<Place>>& groups, Dice& dice) {
    std::size_t most = 0;
    for (auto& [name, places] : groups) {
        shuffle(places, dice);
        most = std::max(most, places.size());
    }
    std::vector<Place> order;
    for (std::size_t round = 0; round < most; ++round) {
        for (const auto& [name, places] : groups) {
            if (round < places.size()) {
                order.push_back(places[round]);
            }
        }
    }
    return order;
}

/// All places of one genre in the order in which they are taken: groups in turn, recordings and
/// written music alternating.
std::vector<Place> order_of(const std::vector<const PieceFeatures*>& pieces, Dice& dice) {
    std::array<std::map<std::string, std::vector<Place>>, 2> groups;
    for (const PieceFeatures* piece : pieces) {
        // Every piece gives at least one stretch, a further one only if it is half as long as a
        // full one.
        for (std::size_t from = 0; from == 0 || from + kShortestStretch <= piece->frames.size();
             from += kStretch) {
            groups.at(piece->is_recorded() ? 0 : 1)[piece->group].push_back({piece, from});
        }
    }
    const std::vector<Place> recorded = groups_in_turn(groups[0], dice);
    const std::vector<Place> written = groups_in_turn(groups[1], dice);
    std::vector<Place> order;
    for (std::size_t i = 0; i < std::max(recorded.size(), written.size()); ++i) {
        for (const auto* places : {&recorded, &written}) {
            if (i < places->size()) {
                order.push_back((*places)[i]);
            }
        }
    }
    return order;
}

// Checks the shape before the network is built by it.
Expected<std::shared_ptr<const models::RecurrentNetwork>> unpack_network(Unpacker& unpacker,
                                                                         std::size_t outputs) {
    const models::RecurrentNetwork::Shape shape{unpacker.take<std::uint32_t>(),
                                                unpacker.take<std::uint32_t>(),
                                                unpacker.take<std::uint32_t>(),
                                                outputs};
    const auto weights = unpacker.take_list<std::vector<float>>();
    const bool is_sane =
        unpacker.is_good() && shape.inputs == NetworkInput::kSize && shape.units >= 1 &&
        shape.units <= models::RecurrentNetwork::kMaxUnits && shape.layers >= 1 &&
        shape.layers <= models::RecurrentNetwork::kMaxLayers &&
        std::all_of(weights.begin(), weights.end(), [](float w) { return std::abs(w) < 1e6F; });
    if (!is_sane) {
        return fail("is cut short or damaged");
    }
    auto network = std::make_shared<models::RecurrentNetwork>(shape);
    if (network->parameters().size() != weights.size()) {
        return fail("is damaged");
    }
    std::copy(weights.begin(), weights.end(), network->parameters().begin());
    return network;
}

// Counterpart of save_samples.
Expected<GenreSamples> unpack_samples(Unpacker& unpacker) {
    GenreSamples samples;
    samples.feature_key = unpacker.take_list<std::string>();
    const std::size_t genres = unpacker.take<std::uint32_t>();
    if (!unpacker.is_good() || genres < 1 || genres > kMostGenres) {
        return fail("is cut short or damaged");
    }
    for (std::size_t i = 0; i < genres; ++i) {
        samples.genres.push_back(unpacker.take_list<std::string>());
        if (!is_dance_name(samples.genres.back())) {
            return fail("is cut short or damaged");
        }
    }
    const std::size_t networks = unpacker.take<std::uint32_t>();
    if (networks < 1 || networks > GenreScorer::kMostNetworks) {
        return fail("is cut short or damaged");
    }
    for (std::size_t i = 0; i < networks; ++i) {
        auto network = unpack_network(unpacker, samples.genres.size() + 1);
        if (!network) {
            return fail(network.error());
        }
        samples.written_networks.push_back(std::move(*network));
    }
    const std::size_t pieces = unpacker.take<std::uint32_t>();
    if (!unpacker.is_good() || pieces > kMostPieces) {
        return fail("is cut short or damaged");
    }
    for (std::size_t i = 0; i < pieces; ++i) {
        auto piece = unpack_stretch(unpacker);
        if (!piece) {
            return fail(piece.error());
        }
        samples.pieces.push_back(std::move(*piece));
    }
    return unpacker.at_end() && unpacker.is_good() ? Expected<GenreSamples>(std::move(samples))
                                                   : fail("is cut short or damaged");
}

}  // namespace

std::vector<PieceFeatures> sample_pieces(std::span<const PieceFeatures* const> pieces,
                                         std::span<const std::string> genres,
                                         std::size_t bytes,
                                         std::uint64_t seed) {
    std::map<std::size_t, std::vector<const PieceFeatures*>> of_class;
    for (const PieceFeatures* piece : pieces) {
        if (piece->frames.size() >= static_cast<std::size_t>(BarPatterns::kSegmentHops)) {
            of_class[class_of(piece->genre, genres)].push_back(piece);
        }
    }
    std::vector<PieceFeatures> sample;
    // A stream of draws for each class: a genre more does not change the sample of the others.
    for (const auto& [genre, own] : of_class) {
        Dice dice(seed, 700 + static_cast<std::uint64_t>(genre));
        std::size_t left = bytes;
        for (const Place& place : order_of(own, dice)) {
            PieceFeatures stretch = stretch_of(*place.piece, place.from);
            // The size in the file is known only after packing.
            Packer packer("");
            pack_stretch(stretch, packer);
            const std::size_t size = packer.take().size();
            if (size > left) {
                break;
            }
            left -= size;
            sample.push_back(std::move(stretch));
        }
    }
    return sample;
}

fs::path samples_path(const fs::path& model) {
    return fs::path(model).replace_extension(".samples");
}

Expected<void> save_samples(const GenreSamples& samples, const fs::path& path) {
    Packer packer(kSamplesMagic);
    packer.put_list(samples.feature_key);
    packer.put(static_cast<std::uint32_t>(samples.genres.size()));
    for (const std::string& genre : samples.genres) {
        packer.put_list(genre);
    }
    packer.put(static_cast<std::uint32_t>(samples.written_networks.size()));
    for (const auto& network : samples.written_networks) {
        // The outputs are not stored: they follow from the genres.
        const models::RecurrentNetwork::Shape& shape = network->shape();
        for (const std::size_t number : {shape.inputs, shape.units, shape.layers}) {
            packer.put(static_cast<std::uint32_t>(number));
        }
        packer.put_list(network->parameters());
    }
    packer.put(static_cast<std::uint32_t>(samples.pieces.size()));
    for (const PieceFeatures& piece : samples.pieces) {
        pack_stretch(piece, packer);
    }
    return write_file(path, packer.take());
}

Expected<GenreSamples> load_samples(const fs::path& path) {
    const auto bytes = read_file(path, kMostBytes);
    if (!bytes) {
        return fail(bytes.error());
    }
    if (!bytes->starts_with(kSamplesMagic)) {
        return fail(path.string() +
                    (bytes->starts_with(kSamplesFormat)
                         ? ": is of another version of this program; train the model again"
                         : ": was not made by raks train genre"));
    }
    Unpacker unpacker(std::string_view(*bytes).substr(kSamplesMagic.size()));
    auto samples = unpack_samples(unpacker);
    if (!samples) {
        return fail(
            fmt::format("{}: {}; train the model again", path.string(), samples.error().message));
    }
    return samples;
}

}  // namespace raks::audio
