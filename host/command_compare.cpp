#include "host/commands.h"
#include "host/compare.h"
#include "host/errors.h"
#include "host/false_color.h"
#include "host/flip.h"
#include "host/render_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

namespace clucida::host {
namespace {

struct CompareOptions {
    std::string a, b, output, map = "error", format_out;
    bool json = false, eight_bit = false, linear = false, flip = false;
    double threshold = 1.0 / 255, pixels_per_degree = flip_pixels_per_degree;
    std::optional<double> fail_above;
};

/// What was measured; bytes and flip only if they were asked for.
struct Measures {
    Comparison plain;
    std::optional<ByteComparison> bytes;
    std::optional<Flip> flip;
};

constexpr Scale flip_scale = {.least = 0, .most = 1};
constexpr Scale error_scale = {.least = 1e-6, .most = 1, .logarithmic = true}; ///< always, so that maps compare

double share(std::uint64_t part, std::uint64_t whole)
{
    return whole ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

constexpr const char* channels[] = {"red", "green", "blue"};

void print(std::FILE* to, const Measures& m, const CompareOptions& options)
{
    const Comparison& c = m.plain;
    fmt::print(to, "rmse       {:.9g}\n", c.rmse);
    fmt::print(to, "psnr       {:.2f} dB\n", c.psnr);
    fmt::print(to, "mean       {:.9g}\n", c.mean_error);
    fmt::print(to, "p50        {:.9g}\n", c.p50);
    fmt::print(to, "p99        {:.9g}\n", c.p99);
    fmt::print(to, "p99.9      {:.9g}\n", c.p999);
    fmt::print(to, "max        {:.9g} at {},{} {}\n", c.max_error, c.max_x, c.max_y, channels[c.max_channel]);
    fmt::print(to, "over       {} of {} pixels by more than {:.6g} ({:.6g})\n", c.over, c.pixels, options.threshold,
               share(c.over, c.pixels));
    if (m.bytes) {
        fmt::print(to, "steps      {} at most, {:.6g} in the mean, of 255\n", m.bytes->max_steps, m.bytes->mean_steps);
        fmt::print(to, "equal      {} of {} pixels ({:.6g})\n", m.bytes->equal, c.pixels,
                   share(m.bytes->equal, c.pixels));
    }
    if (m.flip) fmt::print(to, "flip       {:.6f}\n", m.flip->mean);
    if (c.not_numbers) fmt::print(to, "nan        {} channels are not numbers\n", c.not_numbers);
}

void print_json(std::FILE* to, const Measures& m, const CompareOptions& options)
{
    const Comparison& c = m.plain;
    nlohmann::ordered_json j = {{"a", options.a},
                                {"b", options.b},
                                {"pixels", c.pixels},
                                {"rmse", c.rmse},
                                {"psnr", nullptr},
                                {"mean_error", c.mean_error},
                                {"p50", c.p50},
                                {"p99", c.p99},
                                {"p999", c.p999},
                                {"max_error", c.max_error},
                                {"max_at", {{"x", c.max_x}, {"y", c.max_y}, {"channel", channels[c.max_channel]}}},
                                {"threshold", options.threshold},
                                {"over", c.over},
                                {"over_fraction", share(c.over, c.pixels)},
                                {"not_numbers", c.not_numbers}};
    if (std::isfinite(c.psnr)) j["psnr"] = c.psnr;
    if (m.bytes)
        j["eight_bit"] = {{"max_steps", m.bytes->max_steps},
                          {"mean_steps", m.bytes->mean_steps},
                          {"equal", m.bytes->equal},
                          {"equal_fraction", share(m.bytes->equal, c.pixels)}};
    if (m.flip) j["flip"] = m.flip->mean;
    fmt::print(to, "{}\n", j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

/// The name without folders, as render gives its scene's: the same pictures make the same map anywhere.
std::string own_name(const std::string& file)
{
    return std::filesystem::path(file).filename().string();
}

/// Where the pictures differ, in false colours, as a file.
std::string encode_map(const Picture& a, const Picture& b, const Measures& m, const CompareOptions& options,
                       FileFormat format)
{
    const bool flip = options.map == "flip";
    const Scale& scale = flip ? flip_scale : error_scale;
    const Picture picture = with_legend(false_color(flip ? m.flip->error : error_map(a, b), scale), scale);
    EncodeOptions o;
    o.metadata = {
        {"Software", "clucida " CLUCIDA_VERSION},
        {"Command", fmt::format("clucida compare {} {} --map {}{}{}", own_name(options.a), own_name(options.b),
                                options.map, flip ? fmt::format(" --ppd {}", options.pixels_per_degree) : "",
                                options.linear ? " --linear" : "")}};
    return encode(picture, format, o);
}

void run(const CompareOptions& options)
{
    const Transfer transfer = options.linear ? Transfer::linear : Transfer::srgb;
    std::optional<Output> output;
    if (!options.output.empty()) output = choose_output(options.output, options.format_out, "");
    const Picture a = read_picture(options.a, transfer), b = read_picture(options.b, transfer);
    Measures m{compare(a, b, options.threshold), {}, {}};
    if (options.eight_bit) m.bytes = compare_bytes(a, b, transfer);
    if (options.flip || (output && options.map == "flip")) m.flip = flip(a, b, options.pixels_per_degree);
    if (output) write_output(*output, encode_map(a, b, m, options, output->format));
    std::FILE* const to = output && output->file == "-" ? stderr : stdout;
    if (options.json)
        print_json(to, m, options);
    else
        print(to, m, options);

    const Comparison& c = m.plain;
    if (!options.fail_above) return;
    if (c.not_numbers) throw Failure("the pictures hold what is not a number");
    if (!(c.rmse <= *options.fail_above))
        throw Failure(fmt::format("the pictures differ by {:.9g}, more than {:.9g}", c.rmse, *options.fail_above));
}

} // namespace

void add_compare(CLI::App& app)
{
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand("compare", "Tell how far two pictures are apart, in linear light");
    command->add_option("a", options->a, "a picture: png, jpg, hdr, pfm, ppm, ...")->required()->option_text("A");
    command->add_option("b", options->b, "another of the same size")->required()->option_text("B");
    command->add_flag("--json", options->json, "as JSON");
    command->add_flag("--eight-bit", options->eight_bit, "also in steps of 8-bit pictures");
    command->add_flag("--linear", options->linear, "integer samples are linear, not sRGB");
    command->add_flag("--flip", options->flip, "also the mean of FLIP, 0 to 1: the difference as people see it");
    command->add_option("--ppd", options->pixels_per_degree, "pixels per degree of visual angle, for FLIP (67.02)")
        ->check(number_within(1, 1000))
        ->option_text("X");
    CLI::Option* output =
        command->add_option("-o,--output", options->output, "write a picture of where they differ; -: standard output")
            ->option_text("FILE");
    command->add_option("--map", options->map, "what that shows: error (the default; 1e-6 to 1, logarithmic) or flip")
        ->check(CLI::IsMember({"error", "flip"}))
        ->needs(output)
        ->option_text("NAME");
    command->add_option("--format-out", options->format_out, "of that picture, else by the file's ending (png)")
        ->needs(output)
        ->option_text("NAME");
    command->add_option("--threshold", options->threshold, "count pixels that differ by more than this (1/255)")
        ->check(number_within(0, std::numeric_limits<double>::max()))
        ->option_text("X");
    command->add_option("--fail-above", options->fail_above, "exit with 1 if the RMSE is greater")
        ->check(number_within(0, std::numeric_limits<double>::max()))
        ->option_text("RMSE");
    command->footer("Example:\n  clucida compare a.png b.png --fail-above 0.001\n"
                    "  clucida compare a.png b.png --flip -o where.png --map flip");
    command->callback([options] { run(*options); });
}

} // namespace clucida::host
