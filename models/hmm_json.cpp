#include "models/hmm_json.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace raks::models {
namespace {

using Json = nlohmann::ordered_json;

// A row or column of a matrix as an array of numbers.
template <typename Row>
Json list_of(const Row& row) {
    Json list = Json::array();
    for (Eigen::Index i = 0; i < row.size(); ++i) {
        list.push_back(row(i));
    }
    return list;
}

// A matrix as an array of rows.
Json table_of(const Eigen::MatrixXd& matrix) {
    Json rows = Json::array();
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        rows.push_back(list_of(matrix.row(i)));
    }
    return rows;
}

// The numbers of a field, which may be none.
Eigen::VectorXd vector_of(const JsonDocument::Field& field) {
    const std::vector<double> numbers = field.numbers();
    return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                             static_cast<Eigen::Index>(numbers.size()));
}

// Rows of equal length; an empty matrix after a fault.
Eigen::MatrixXd matrix_of(const JsonDocument::Field& field) {
    std::vector<Eigen::VectorXd> rows(field.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i] = vector_of(field[i]);
        if (rows[i].size() != rows[0].size()) {
            field[i].complain(fmt::format(
                "has {} numbers, the first row has {}", rows[i].size(), rows[0].size()));
            return {};  // before anything of rows x columns is allocated
        }
    }
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()),
                           rows.empty() ? 0 : rows[0].size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        matrix.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
    }
    return matrix;
}

// Names are compared exactly. After a fault the type is diagonal; the document keeps the fault.
CovarianceType type_of(const JsonDocument::Field& field) {
    const std::string name = field.text();
    const auto* const found =
        std::find(std::begin(kCovarianceNames), std::end(kCovarianceNames), name);
    if (found == std::end(kCovarianceNames)) {
        field.complain("must be diagonal, full, tied or spherical");
        return CovarianceType::diagonal;
    }
    return static_cast<CovarianceType>(found - std::begin(kCovarianceNames));
}

}  // namespace

nlohmann::ordered_json hmm_json(const GaussianHmm& model) {
    Json json;
    json["covariance_type"] = kCovarianceNames[static_cast<std::size_t>(model.covariance_type)];
    json["initial"] = list_of(model.initial);
    json["transition"] = table_of(model.transition);
    // Empty where the model has no exits; read_hmm gives that back.
    json["exit"] = list_of(model.exit);
    json["weights"] = table_of(model.weights);
    json["means"] = table_of(model.means);
    json["covariances"] = Json::array();
    for (const Eigen::MatrixXd& covariance : model.covariances) {
        json["covariances"].push_back(table_of(covariance));
    }
    return json;
}

GaussianHmm read_hmm(const JsonDocument::Field& fields) {
    GaussianHmm model;
    model.covariance_type = type_of(fields["covariance_type"]);
    model.initial = vector_of(fields["initial"]);
    model.transition = matrix_of(fields["transition"]);
    model.exit = vector_of(fields["exit"]);
    model.weights = matrix_of(fields["weights"]);
    model.means = matrix_of(fields["means"]);
    const JsonDocument::Field covariances = fields["covariances"];
    for (std::size_t i = 0; i < covariances.size(); ++i) {
        model.covariances.push_back(matrix_of(covariances[i]));
    }
    return model;
}

}  // namespace raks::models
