#include "host/commands.h"
#include "host/devices.h"
#include "host/selftest.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <memory>

namespace clucida::host {
namespace {

struct DevicesOptions {
    bool json = false, test = true;
    std::string device;
};

/// The self-test's finding as a word or sentence.
std::string test(const Device& device)
{
    try {
        const std::string wrong = self_test(device);
        return wrong.empty() ? "exact" : wrong;
    } catch (const std::exception& e) {
        return fmt::format("failed: {}", e.what());
    }
}

nlohmann::ordered_json to_json(const DeviceInfo& d, bool is_default, const std::string& arithmetic)
{
    nlohmann::ordered_json j = {{"id", place(d)},
                                {"default", is_default},
                                {"name", d.name},
                                {"kind", kind_name(d.kind)},
                                {"vendor", d.vendor},
                                {"version", d.version},
                                {"driver", d.driver},
                                {"platform", d.platform_name},
                                {"platform_version", d.platform_version},
                                {"usable", d.usable},
                                {"compute_units", d.compute_units},
                                {"global_bytes", d.global_bytes},
                                {"max_allocation_bytes", d.max_allocation_bytes},
                                {"max_work_group", d.max_group},
                                {"double", d.has_double},
                                {"correctly_rounded_division", d.rounds_division}};
    if (!arithmetic.empty()) j["arithmetic"] = arithmetic;
    return j;
}

void print(const DeviceInfo& d, bool is_default, const std::string& arithmetic)
{
    const auto yes = [](bool b) { return b ? "yes" : "no"; };
    constexpr double gib = 1 << 30;
    fmt::print("{} {}  {}{}\n", is_default ? '*' : ' ', place(d), d.name, d.usable ? "" : "  (not usable)");
    if (!d.native) fmt::print("       platform     {}, {}\n", d.platform_name, d.platform_version);
    fmt::print("       driver       {}, {}\n", d.driver, d.version);
    if (d.native) {
        fmt::print("       kind         {}, {} threads\n", kind_name(d.kind), d.compute_units);
        fmt::print("       memory       {:.1f} GiB\n", static_cast<double>(d.global_bytes) / gib);
    } else {
        fmt::print("       kind         {}, {} compute units, work-groups of up to {}\n", kind_name(d.kind),
                   d.compute_units, d.max_group);
        fmt::print("       memory       {:.1f} GiB, {:.1f} GiB in one piece\n",
                   static_cast<double>(d.global_bytes) / gib, static_cast<double>(d.max_allocation_bytes) / gib);
    }
    fmt::print("       double       {}\n", yes(d.has_double));
    fmt::print("       exact / and sqrt  {}\n", yes(d.rounds_division));
    if (!arithmetic.empty()) fmt::print("       arithmetic   {}\n", arithmetic);
}

void run(const DevicesOptions& options)
{
    const std::vector<Device> devices = list_devices();
    const std::vector<DeviceInfo> known = infos(devices);
    const std::vector<std::size_t> chosen = choose_devices(known, device_selector(options.device));
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const bool is_chosen = std::ranges::find(chosen, i) != chosen.end();
        const std::string arithmetic = options.test && devices[i].info.usable ? test(devices[i]) : "";
        if (options.json)
            all.push_back(to_json(devices[i].info, is_chosen, arithmetic));
        else
            print(devices[i].info, is_chosen, arithmetic);
    }
    if (options.json) std::cout << all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

} // namespace

void add_devices(CLI::App& app)
{
    auto options = std::make_shared<DevicesOptions>();
    CLI::App* command = app.add_subcommand("devices", "List what can render here; * marks what `render` would use");
    command->add_flag("--json", options->json, "as JSON");
    command->add_flag("!--no-test", options->test, "do not test each device's arithmetic (which compiles a kernel)");
    command
        ->add_option("--device", options->device,
                     "mark this one: P:D, a part of a name, cpu, gpu, native, all, or several with commas "
                     "between")
        ->option_text("WHICH");
    command->footer("Example:\n  clucida devices --json\n\nThe environment's CLUCIDA_DEVICE chooses like --device.");
    command->callback([options] { run(*options); });
}

} // namespace clucida::host
