#include "host/commands.h"
#include "host/compare.h"
#include "host/errors.h"
#include "host/picture_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>

namespace clucida::host {
namespace {

struct CompareOptions {
    std::string a, b;
    bool json = false, eight_bit = false, linear = false;
    double threshold = 1.0 / 255;
    std::optional<double> fail_above;
};

double share(std::uint64_t part, std::uint64_t whole)
{
    return whole ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

constexpr const char* channels[] = {"red", "green", "blue"};

void print(const Comparison& c, const std::optional<ByteComparison>& bytes, const CompareOptions& options)
{
    fmt::print("rmse       {:.9g}\n", c.rmse);
    fmt::print("psnr       {:.2f} dB\n", c.psnr);
    fmt::print("mean       {:.9g}\n", c.mean_error);
    fmt::print("max        {:.9g} at {},{} {}\n", c.max_error, c.max_x, c.max_y, channels[c.max_channel]);
    fmt::print("over       {} of {} pixels by more than {:.6g} ({:.6g})\n", c.over, c.pixels, options.threshold,
               share(c.over, c.pixels));
    if (bytes) {
        fmt::print("steps      {} at most, {:.6g} in the mean, of 255\n", bytes->max_steps, bytes->mean_steps);
        fmt::print("equal      {} of {} pixels ({:.6g})\n", bytes->equal, c.pixels, share(bytes->equal, c.pixels));
    }
    if (c.not_numbers) fmt::print("nan        {} channels are not numbers\n", c.not_numbers);
}

void print_json(const Comparison& c, const std::optional<ByteComparison>& bytes, const CompareOptions& options)
{
    nlohmann::ordered_json j = {{"a", options.a},
                                {"b", options.b},
                                {"pixels", c.pixels},
                                {"rmse", c.rmse},
                                {"psnr", nullptr},
                                {"mean_error", c.mean_error},
                                {"max_error", c.max_error},
                                {"max_at", {{"x", c.max_x}, {"y", c.max_y}, {"channel", channels[c.max_channel]}}},
                                {"threshold", options.threshold},
                                {"over", c.over},
                                {"over_fraction", share(c.over, c.pixels)},
                                {"not_numbers", c.not_numbers}};
    if (std::isfinite(c.psnr)) j["psnr"] = c.psnr;
    if (bytes)
        j["eight_bit"] = {{"max_steps", bytes->max_steps},
                          {"mean_steps", bytes->mean_steps},
                          {"equal", bytes->equal},
                          {"equal_fraction", share(bytes->equal, c.pixels)}};
    std::cout << j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

void run(const CompareOptions& options)
{
    const Transfer transfer = options.linear ? Transfer::linear : Transfer::srgb;
    const Picture a = read_picture(options.a, transfer), b = read_picture(options.b, transfer);
    const Comparison c = compare(a, b, options.threshold);
    std::optional<ByteComparison> bytes;
    if (options.eight_bit) bytes = compare_bytes(a, b, transfer);
    if (options.json)
        print_json(c, bytes, options);
    else
        print(c, bytes, options);
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
    command->add_option("--threshold", options->threshold, "count pixels that differ by more than this (1/255)")
        ->check(number_within(0, std::numeric_limits<double>::max()))
        ->option_text("X");
    command->add_option("--fail-above", options->fail_above, "exit with 1 if the RMSE is greater")
        ->check(number_within(0, std::numeric_limits<double>::max()))
        ->option_text("RMSE");
    command->footer("Example:\n  clucida compare a.png b.png --fail-above 0.001");
    command->callback([options] { run(*options); });
}

} // namespace clucida::host
