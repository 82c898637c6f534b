#include "apps/raks_capture/label_session.hpp"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

using capture::MarkerLabel;
using Labels = std::vector<MarkerLabel>;

glm::dvec2 rounded(const glm::dvec2& pixel) { return glm::round(pixel * 100.0) / 100.0; }

/// Changes a session by one action.
class LabelChange {
 public:
    explicit LabelChange(LabelSession& session) : session_(session) {}

    void operator()(const ShowCamera& show) {
        session_.camera = std::min(show.camera, session_.cameras.size() - 1);
        session_.picked.reset();
        session_.moved.reset();
    }
    void operator()(const ShowPicture& show) {
        session_.pictures[session_.camera] = show.picture;
        session_.picked.reset();
        session_.moved.reset();
    }
    void operator()(const PickPixel& pick) {
        if (!session_.chosen) {
            session_.picked = rounded(pick.pixel);
            return;
        }
        Labels labels = session_.labels.now();
        put(*session_.chosen, pick.pixel, labels);
        commit(std::move(labels));
        session_.chosen = next_without_label(*session_.chosen);
    }
    void operator()(const ChooseName& choose) {
        if (!session_.picked) {
            session_.chosen =
                session_.chosen == choose.marker ? std::nullopt : std::optional(choose.marker);
            return;
        }
        Labels labels = session_.labels.now();
        name(choose.marker, *session_.picked, labels);
        commit(std::move(labels));
        session_.picked.reset();
    }
    void operator()(const MoveLabel& move) { session_.moved = move.label; }
    void operator()(const LetGoOfLabel& /*action*/) {
        const std::optional<MovedLabel> moved = std::exchange(session_.moved, std::nullopt);
        if (!moved) {
            return;
        }
        if (!moved->has_moved) {
            const MarkerLabel* const label = session_.label_of(moved->marker);
            session_.picked = label != nullptr ? std::optional(label->pixel) : std::nullopt;
            return;
        }
        Labels labels = session_.labels.now();
        put(moved->marker, moved->pixel, labels);
        commit(std::move(labels));
    }
    void operator()(const RemoveLabel& remove) {
        Labels labels = session_.labels.now();
        std::erase_if(labels, [&](const MarkerLabel& label) {
            return is_here(label) && label.marker == name_of(remove.marker);
        });
        commit(std::move(labels));
        session_.picked.reset();
    }
    void operator()(const AcceptProposals& accept) {
        Labels labels = session_.labels.now();
        for (const LabelProposal& proposal : accept.proposals) {
            if (proposal.marker) {
                put(*proposal.marker, proposal.pixel, labels);
            }
        }
        commit(std::move(labels));
        session_.picked.reset();
    }
    void operator()(const ForgetChoice& /*action*/) {
        session_.picked.reset();
        session_.chosen.reset();
        session_.moved.reset();
    }
    void operator()(const UndoLabels& /*action*/) {
        session_.labels.undo();
        session_.picked.reset();
    }
    void operator()(const RedoLabels& /*action*/) {
        session_.labels.redo();
        session_.picked.reset();
    }

 private:
    [[nodiscard]] const std::string& name_of(std::size_t marker) const {
        return session_.markers.markers[marker].name;
    }
    [[nodiscard]] bool is_here(const MarkerLabel& label) const {
        return label.camera == session_.cameras[session_.camera] &&
               label.picture == session_.picture();
    }

    // A marker is at a place of this picture.
    void put(std::size_t marker, const glm::dvec2& pixel, Labels& labels) const {
        for (MarkerLabel& label : labels) {
            if (is_here(label) && label.marker == name_of(marker)) {
                label.pixel = rounded(pixel);
                return;
            }
        }
        labels.push_back({session_.cameras[session_.camera],
                          session_.picture(),
                          name_of(marker),
                          rounded(pixel)});
    }

    // What is at a place is this marker: a label there changes its name, and whoever has the name
    // takes the old one.
    void name(std::size_t marker, const glm::dvec2& pixel, Labels& labels) const {
        constexpr double kSame = 0.005;  // pixels
        const auto there =
            std::find_if(labels.begin(), labels.end(), [&](const MarkerLabel& label) {
                return is_here(label) && glm::distance(label.pixel, pixel) < kSame;
            });
        if (there == labels.end()) {
            put(marker, pixel, labels);
            return;
        }
        const std::string before = std::exchange(there->marker, name_of(marker));
        for (auto other = labels.begin(); other != labels.end(); ++other) {
            if (other != there && is_here(*other) && other->marker == name_of(marker)) {
                other->marker = before;
            }
        }
    }

    [[nodiscard]] std::optional<std::size_t> next_without_label(std::size_t marker) const {
        const std::size_t count = session_.markers.markers.size();
        for (std::size_t step = 1; step < count; ++step) {
            const std::size_t next = (marker + step) % count;
            if (session_.label_of(next) == nullptr) {
                return next;
            }
        }
        return std::nullopt;
    }

    void commit(Labels labels) const {
        const auto place = [this](const MarkerLabel& label) {
            const auto camera =
                std::find(session_.cameras.begin(), session_.cameras.end(), label.camera);
            return std::tuple(camera - session_.cameras.begin(),
                              label.picture,
                              session_.markers.index_of(label.marker));
        };
        std::sort(labels.begin(), labels.end(), [&](const auto& one, const auto& other) {
            return place(one) < place(other);
        });
        session_.labels.change(std::move(labels));
    }

    LabelSession& session_;
};

}  // namespace

const MarkerLabel* LabelSession::label_of(std::size_t marker) const {
    const auto& all = labels.now();
    const auto found = std::find_if(all.begin(), all.end(), [&](const MarkerLabel& label) {
        return label.camera == cameras[camera] && label.picture == picture() &&
               label.marker == markers.markers[marker].name;
    });
    return found != all.end() ? &*found : nullptr;
}

std::size_t LabelSession::cameras_of(std::size_t marker) const {
    std::set<std::string> found;
    for (const MarkerLabel& label : labels.now()) {
        if (label.marker == markers.markers[marker].name) {
            found.insert(label.camera);
        }
    }
    return found.size();
}

std::size_t LabelSession::labelled_in(std::size_t of_camera) const {
    const auto& all = labels.now();
    return static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [&](const MarkerLabel& label) {
            return label.camera == cameras[of_camera] && label.picture == pictures[of_camera];
        }));
}

LabelSession label_session(std::vector<std::string> cameras,
                           capture::MarkerSet markers,
                           std::vector<MarkerLabel> labels,
                           std::vector<std::size_t> first_pictures) {
    LabelSession session;
    session.cameras = std::move(cameras);
    session.markers = std::move(markers);
    session.pictures = std::move(first_pictures);
    session.pictures.resize(session.cameras.size(), 0);
    // Where a camera is labelled already one goes on with that picture.
    for (std::size_t camera = 0; camera < session.cameras.size(); ++camera) {
        const auto first = std::find_if(labels.begin(), labels.end(), [&](const auto& label) {
            return label.camera == session.cameras[camera];
        });
        if (first != labels.end()) {
            session.pictures[camera] = first->picture;
        }
    }
    session.labels = History<Labels>(std::move(labels));
    return session;
}

void apply(const LabelAction& action, LabelSession& session) {
    std::visit(LabelChange(session), action);
}

}  // namespace raks::apps
