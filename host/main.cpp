#include "host/commands.h"
#include "host/guarded.h"
#include "host/interrupt.h"

int main(int argc, char** argv)
{
    using namespace clucida;
    host::catch_interrupts();
    CLI::App app("An OpenCL renderer of true optics.", "clucida");
    app.set_version_flag("--version", "clucida " CLUCIDA_VERSION);
    app.require_subcommand(1);
    app.footer("Examples:\n"
               "  clucida render scene.clu -s 1280x720 --samples 16\n"
               "  clucida devices\n"
               "  clucida inspect scene.clu\n"
               "  clucida compare a.png b.png\n"
               "\nclucida COMMAND --help tells more.");
    host::add_render(app);
    host::add_devices(app);
    host::add_inspect(app);
    host::add_compare(app);
    host::add_stream(app);
    return host::run_guarded(app, argc, argv);
}
