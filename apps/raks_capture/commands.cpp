#include "apps/raks_capture/commands.hpp"

namespace raks::apps {

void add_commands(CommandTable& table) {
    table.app().require_subcommand(1);
    add_run(table);
    add_simulate(table);
    add_board(table);
    add_calibrate(table);
    add_sync(table);
    add_label(table);
    add_track(table);
    add_correct(table);
    add_solve(table);
    add_report(table);
    add_compare(table);
}

}  // namespace raks::apps
