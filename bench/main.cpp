#include "bench/commands.h"
#include "host/guarded.h"
#include "host/interrupt.h"

int main(int argc, char** argv)
{
    using namespace clucida;
    host::catch_interrupts();
    CLI::App app("How far from right, how fast: figures for clucida.", "clucida-bench");
    app.set_version_flag("--version", "clucida-bench " CLUCIDA_VERSION);
    app.require_subcommand(1);
    app.footer("Examples:\n"
               "  clucida-bench error scene.clu -s 320x180 -o where.png\n"
               "  clucida-bench speed scene.clu --threads 1,all --native\n"
               "  clucida-bench profile scene.clu\n"
               "  clucida-bench report -o figures\n"
               "\nclucida-bench COMMAND --help tells more.");
    bench::add_agreement(app);
    bench::add_agreement_worker(app);
    bench::add_error(app);
    bench::add_speed(app);
    bench::add_profile(app);
    bench::add_compare(app);
    bench::add_report(app);
    bench::add_speed_worker(app);
    return host::run_guarded(app, argc, argv);
}
