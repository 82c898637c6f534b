// VRMC_node_constraint 1.0.
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "render/import/lenient.hpp"
#include "render/import/node_tree.hpp"
#include "render/import/vrm_parts.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kMostConstraints = 1000;

NodeConstraint read_constraint(const JsonField& extension, int node, Model& model) {
    const JsonField from = extension["constraint"];
    NodeConstraint constraint;
    constraint.node = node;
    JsonField kind = from["rotation"];
    if (from["roll"].exists()) {
        kind = from["roll"];
        constraint.kind = ConstraintKind::roll;
        constraint.axis = static_cast<NodeAxis>(kind["rollAxis"].choice_or(0, {"X", "Y", "Z"}));
    } else if (from["aim"].exists()) {
        kind = from["aim"];
        constraint.kind = ConstraintKind::aim;
        constraint.axis = static_cast<NodeAxis>(kind["aimAxis"].choice_or(
            0, {"PositiveX", "PositiveY", "PositiveZ", "NegativeX", "NegativeY", "NegativeZ"}));
    }
    constraint.source = kind["source"].index(model.nodes.size());
    constraint.weight = lenient_number(kind["weight"], {0.0F, 1.0F, 1.0F}, model);
    if (constraint.source == node) {
        kind["source"].complain("is the node itself");
    } else if (constraint.kind == ConstraintKind::aim && is_below(model, constraint.source, node)) {
        kind["source"].complain("lies below the node that is to aim at it");
    }
    return constraint;
}

/// Brings constraints into an order in which each comes after those that move its source or what
/// carries its source; one that closes a circle is left out.
class ConstraintOrder {
 public:
    ConstraintOrder(std::vector<NodeConstraint> constraints, Model& model)
        : constraints_(std::move(constraints)),
          model_(model),
          of_node_(model.nodes.size(), -1),
          states_(constraints_.size(), State::new_one) {
        for (std::size_t i = 0; i < constraints_.size(); ++i) {
            of_node_[static_cast<std::size_t>(constraints_[i].node)] = static_cast<int>(i);
        }
    }

    void sort() {
        for (std::size_t i = 0; i < constraints_.size(); ++i) {
            visit(i);
        }
    }

 private:
    enum class State : std::uint8_t { new_one, waiting, done };

    /// Those that `at` waits for: on its source, and on all that carry its source.
    std::vector<std::size_t> before(std::size_t at) const {
        std::vector<std::size_t> before;
        for (int up = constraints_[at].source; up >= 0; up = node_of(model_, up).parent) {
            const int other = of_node_[static_cast<std::size_t>(up)];
            if (other >= 0 && static_cast<std::size_t>(other) != at) {
                before.push_back(static_cast<std::size_t>(other));
            }
        }
        return before;
    }

    /// Depth first, by hand: a file may chain as many as it has nodes.
    void visit(std::size_t first) {
        std::vector<std::size_t> stack = {first};
        while (!stack.empty()) {
            const std::size_t at = stack.back();
            if (states_[at] == State::done) {
                stack.pop_back();
                continue;
            }
            const bool is_new = states_[at] == State::new_one;
            states_[at] = State::waiting;
            bool waits = false;
            bool is_circle = false;
            for (const std::size_t other : before(at)) {
                is_circle = is_circle || (is_new && states_[other] == State::waiting);
                if (states_[other] == State::new_one) {
                    stack.push_back(other);
                    waits = true;
                }
            }
            if (is_circle) {
                states_[at] = State::done;
                warn(model_,
                     "nodes[" + std::to_string(constraints_[at].node) +
                         "]: its constraint follows itself, by way of others; left out");
            } else if (!waits) {
                states_[at] = State::done;
                stack.pop_back();
                model_.character.constraints.push_back(constraints_[at]);
            }
        }
    }

    std::vector<NodeConstraint> constraints_;
    Model& model_;
    std::vector<int> of_node_;  // constraint of each node; -1: none
    std::vector<State> states_;
};

}  // namespace

void read_constraints(const JsonField& nodes, Model& model) {
    std::vector<NodeConstraint> constraints;
    const std::vector<JsonField> all = nodes.items();
    for (std::size_t i = 0; i < all.size() && i < model.nodes.size(); ++i) {
        const JsonField extension = all[i]["extensions"]["VRMC_node_constraint"];
        if (!extension.exists()) {
            continue;
        }
        if (constraints.size() == kMostConstraints) {
            warn(model, extension.line("there are more than 1000 constraints; left out"));
            break;
        }
        NodeConstraint one;
        if (read_part(extension, model, [&](const JsonField& own) {
                one = read_constraint(own, static_cast<int>(i), model);
            })) {
            constraints.push_back(one);
        }
    }
    ConstraintOrder(std::move(constraints), model).sort();
}

}  // namespace raks::render
