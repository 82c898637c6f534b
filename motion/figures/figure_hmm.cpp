#include "motion/figures/figure_hmm.hpp"

#include <cmath>
#include <numeric>

namespace raks::motion {
namespace {

Eigen::VectorXd vector_of(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
}

// A row or vector of Eigen as a list.
template <typename Row>
std::vector<double> list_of(const Row& row) {
    std::vector<double> list;
    for (Eigen::Index i = 0; i < row.size(); ++i) {
        list.push_back(row(i));
    }
    return list;
}

std::vector<std::vector<double>> rows_of(const Eigen::MatrixXd& matrix) {
    std::vector<std::vector<double>> rows;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        rows.push_back(list_of(matrix.row(i)));
    }
    return rows;
}

// The inverse of covariance_type_of().
CovarianceKind kind_of(models::CovarianceType type) noexcept {
    switch (type) {
        case models::CovarianceType::full:
            return CovarianceKind::full;
        case models::CovarianceType::diagonal:
            return CovarianceKind::diagonal;
        case models::CovarianceType::tied:
        case models::CovarianceType::spherical:  // no figure is learnt with it
            break;
    }
    return CovarianceKind::tied;
}

}  // namespace

models::CovarianceType covariance_type_of(CovarianceKind kind) noexcept {
    switch (kind) {
        case CovarianceKind::full:
            return models::CovarianceType::full;
        case CovarianceKind::diagonal:
            return models::CovarianceType::diagonal;
        case CovarianceKind::tied:
            break;
    }
    return models::CovarianceType::tied;
}

Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows) {
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()),
                           rows.empty() ? 0 : static_cast<Eigen::Index>(rows[0].size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        matrix.row(static_cast<Eigen::Index>(i)) = vector_of(rows[i]).transpose();
    }
    return matrix;
}

models::GaussianHmm hmm_of(const PartModel& part) {
    models::GaussianHmm hmm;
    hmm.initial = vector_of(part.initial);
    hmm.transition = matrix_of(part.transition);
    hmm.exit = vector_of(part.exit);
    // One Gaussian a state: its mixture weight is 1.
    hmm.weights = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(part.states.size()), 1);
    hmm.means.resize(static_cast<Eigen::Index>(part.states.size()),
                     static_cast<Eigen::Index>(part.dimension()));
    for (std::size_t k = 0; k < part.states.size(); ++k) {
        hmm.means.row(static_cast<Eigen::Index>(k)) = vector_of(part.states[k].mean).transpose();
    }
    hmm.covariance_type = covariance_type_of(part.covariance_kind);
    if (part.covariance_kind == CovarianceKind::tied) {
        hmm.covariances = {matrix_of(part.covariance)};
    }
    for (const std::vector<std::vector<double>>& rows : part.state_covariances) {
        const Eigen::MatrixXd matrix = matrix_of(rows);
        // The file keeps a diagonal as one row, models/ as a column.
        const bool is_row = part.covariance_kind == CovarianceKind::diagonal;
        hmm.covariances.emplace_back(is_row ? Eigen::MatrixXd(matrix.transpose()) : matrix);
    }
    return hmm;
}

void take_hmm(const models::GaussianHmm& hmm, const Eigen::MatrixXd& tied, PartModel& part) {
    part.initial = list_of(hmm.initial);
    part.exit = list_of(hmm.exit);
    part.states.resize(static_cast<std::size_t>(hmm.states()));
    for (Eigen::Index k = 0; k < hmm.states(); ++k) {
        part.states[static_cast<std::size_t>(k)].mean = list_of(hmm.means.row(k));
    }
    part.transition = rows_of(hmm.transition);
    // Kept for all kinds: variation and detail draw from it.
    part.covariance = rows_of(tied);
    part.covariance_kind = kind_of(hmm.covariance_type);
    part.state_covariances.clear();
    if (part.covariance_kind == CovarianceKind::tied) {
        return;
    }
    for (const Eigen::MatrixXd& covariance : hmm.covariances) {
        const bool is_column = part.covariance_kind == CovarianceKind::diagonal;
        part.state_covariances.push_back(
            rows_of(is_column ? Eigen::MatrixXd(covariance.transpose()) : covariance));
    }
}

models::Frames frames_of(const FeatureTrack& track, std::size_t first, std::size_t count) {
    models::Frames frames(static_cast<Eigen::Index>(count),
                          static_cast<Eigen::Index>(track.columns));
    for (std::size_t t = 0; t < count; ++t) {
        const std::span<const double> row = track.row(first + t);
        for (std::size_t i = 0; i < row.size(); ++i) {
            frames(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(i)) = row[i];
        }
    }
    return frames;
}

namespace {

// Mean and standard deviation over the repeats.
StateStay stay_of(const std::vector<double>& lengths) {
    const double count = static_cast<double>(lengths.size());
    const double mean = std::accumulate(lengths.begin(), lengths.end(), 0.0) / count;
    double square = 0.0;
    for (const double length : lengths) {
        square += (length - mean) * (length - mean);
    }
    return {Beats(mean), Beats(std::sqrt(square / count))};
}

}  // namespace

std::vector<std::vector<double>> count_occurrence(const StatePaths& paths,
                                                  int beats,
                                                  int samples_per_beat,
                                                  std::size_t states) {
    const std::size_t a_beat = static_cast<std::size_t>(samples_per_beat);
    const double samples_of_count = static_cast<double>(paths.size() * a_beat);
    std::vector<std::vector<double>> table(static_cast<std::size_t>(beats),
                                           std::vector<double>(states, 0.0));
    for (const std::vector<std::size_t>& path : paths) {
        for (std::size_t t = 0; t < path.size(); ++t) {
            // Each sample adds its share of the count, over all repeats; so rows sum to 1.
            table[t / a_beat][path[t]] += 1.0 / samples_of_count;
        }
    }
    return table;
}

std::vector<std::vector<double>> state_lengths(const StatePaths& paths,
                                               int samples_per_beat,
                                               std::size_t states) {
    std::vector<std::vector<double>> lengths(states, std::vector<double>(paths.size(), 0.0));
    for (std::size_t r = 0; r < paths.size(); ++r) {
        for (const std::size_t state : paths[r]) {
            lengths[state][r] += 1.0 / static_cast<double>(samples_per_beat);
        }
    }
    return lengths;
}

void set_timing(const StatePaths& paths, int beats, int samples_per_beat, PartModel& part) {
    part.occurrence = count_occurrence(paths, beats, samples_per_beat, part.states.size());
    part.stays.clear();
    for (const auto& lengths : state_lengths(paths, samples_per_beat, part.states.size())) {
        part.stays.push_back(stay_of(lengths));
    }
}

void set_sliced_timing(int beats, int samples_per_beat, PartModel& part) {
    const auto samples =
        static_cast<std::size_t>(beats) * static_cast<std::size_t>(samples_per_beat);
    std::vector<std::size_t> path(samples);
    for (std::size_t t = 0; t < samples; ++t) {
        path[t] = part.state_at(t, samples);
    }
    set_timing({path}, beats, samples_per_beat, part);
}

}  // namespace raks::motion
