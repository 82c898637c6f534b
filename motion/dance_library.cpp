#include "motion/dance_library.hpp"

#include <algorithm>
#include <utility>

#include "motion/dance/content_file.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/library_content.hpp"

namespace raks::motion {

DanceLibrary::DanceLibrary(std::unique_ptr<const Content> content) : content_(std::move(content)) {}
DanceLibrary::~DanceLibrary() = default;

std::vector<std::string_view> DanceLibrary::figure_names() const {
    std::vector<std::string_view> names;
    for (const LibraryFigure& figure : content_->figures) {
        names.emplace_back(figure.name);
    }
    return names;
}

StillPart DanceLibrary::still_part(std::string_view figure) const noexcept {
    const auto& figures = content_->figures;
    const auto found = std::find_if(figures.begin(), figures.end(), [&](const LibraryFigure& one) {
        return one.name == figure;
    });
    return found != figures.end() ? found->still : StillPart::nothing;
}

const CellGraph* DanceLibrary::cells() const noexcept { return content_->cells.get(); }

Pose DanceLibrary::pose_at(std::size_t figure, double beat) const {
    FigureChoice choice;
    choice.figure = figure;
    return pose_of(*content_, choice, beat);
}

Expected<std::shared_ptr<const DanceLibrary>> DanceLibrary::build(
    std::span<const FigureModel> figures,
    const Skeleton& skeleton,
    const FigureGrammar* grammar,
    Generator generator) {
    if (figures.empty()) {
        return fail("a dance needs at least one figure");
    }
    auto content = make_content(figures, skeleton, grammar, generator);
    if (!content) {
        return fail(std::move(content.error()));
    }
    return std::shared_ptr<const DanceLibrary>(
        new DanceLibrary(std::make_unique<const Content>(Content{std::move(*content)})));
}

Expected<std::shared_ptr<const DanceLibrary>> DanceLibrary::build(const CellDance& dance,
                                                                  const Skeleton& skeleton,
                                                                  const DanceHabits& habits) {
    auto content = make_cell_content(dance, skeleton);
    if (!content) {
        return fail(std::move(content.error()));
    }
    take_habits(habits, *content);
    return std::shared_ptr<const DanceLibrary>(
        new DanceLibrary(std::make_unique<const Content>(Content{std::move(*content)})));
}

std::string DanceLibrary::packed() const { return pack_content(*content_); }

Expected<std::shared_ptr<const DanceLibrary>> DanceLibrary::unpack(
    const std::shared_ptr<const std::string>& bytes,
    const Skeleton& skeleton,
    const FigureGrammar& grammar) {
    auto content = unpack_content(bytes, skeleton, grammar);
    if (!content) {
        return fail(std::move(content.error()));
    }
    return std::shared_ptr<const DanceLibrary>(
        new DanceLibrary(std::make_unique<const Content>(Content{std::move(*content)})));
}

Expected<std::shared_ptr<const DanceLibrary>> DanceLibrary::unpack(
    const std::shared_ptr<const std::string>& bytes,
    const Skeleton& skeleton,
    const DanceHabits& habits) {
    auto content = unpack_cell_content(bytes, skeleton);
    if (!content) {
        return fail(std::move(content.error()));
    }
    take_habits(habits, *content);
    return std::shared_ptr<const DanceLibrary>(
        new DanceLibrary(std::make_unique<const Content>(Content{std::move(*content)})));
}

}  // namespace raks::motion
