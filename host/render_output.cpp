#include "host/render_output.h"

#include "host/errors.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace clucida::host {
namespace {

double rays_per_second(const Frame& frame)
{
    const auto rays = static_cast<double>(frame.statistics.rays + frame.statistics.shadow);
    return frame.timings.trace > 0 ? rays / frame.timings.trace : 0;
}

FileFormat named_format(const std::string& ending, const std::string& what)
{
    const auto format = file_format(ending);
    if (!format) throw UsageError(fmt::format("{}; expected one of {}", what, file_endings()));
    return *format;
}

} // namespace

Output choose_output(const std::string& file, const std::string& format_out, const std::string& stem)
{
    Output out;
    out.file = file.empty() ? stem + "." + (format_out.empty() ? "png" : format_out) : file;
    if (!format_out.empty())
        out.format = named_format(format_out, fmt::format("there is no picture format '{}'", format_out));
    else if (out.file != "-")
        out.format = named_format(out.file.find('.') == std::string::npos ? "." : out.file,
                                  fmt::format("the ending of '{}' names no picture format", out.file));
    if (out.file != "-")
        require_writable(out.file);
    else if (::isatty(STDOUT_FILENO))
        throw UsageError("a picture is not written to a terminal; redirect standard output");
    return out;
}

OutputStream::OutputStream(const Output& output, Shape size, const EncodeOptions& options)
    : output_(output), size_(size), options_(options)
{
    require_encodable(size.width, size.height, output.format, options);
}

void OutputStream::add(unsigned y, std::span<const float> rgb)
{
    if (y == 0) { // the first time, or anew
        writer_.reset();
        file_.reset();
        file_.emplace(output_.file);
        writer_.emplace(size_.width, size_.height, output_.format, options_,
                        [this](std::uint64_t offset, std::string_view bytes) { file_->write(offset, bytes); });
    }
    writer_->add(rgb);
}

void OutputStream::commit(const std::function<bool()>& cancelled)
{
    writer_->finish();
    if (cancelled()) throw Interrupted();
    file_->commit();
}

void write_output(const Output& output, const std::string& bytes)
{
    if (output.file == "-")
        write_all(STDOUT_FILENO, bytes, "standard output");
    else
        write_file(output.file, bytes);
}

std::string timing_line(const std::string& name, const Frame& frame, unsigned samples, const Stages& stages)
{
    const Timings& t = frame.timings;
    return fmt::format("{}: {}x{}, {} sample{}, {:.2f} s (build {:.2f}, first launch {:.2f}, upload {:.3f}, trace "
                       "{:.3f}), {:.1f} Mrays/s",
                       name, frame.picture.width, frame.picture.height, samples, samples == 1 ? "" : "s", stages.total,
                       t.build, t.first_enqueue, t.upload, t.trace, rays_per_second(frame) / 1e6);
}

void tell_notes(std::span<const std::string> notes, bool quiet)
{
    if (quiet) return;
    for (const std::string& note : notes) fmt::print(stderr, "clucida: note: {}\n", note);
}

nlohmann::ordered_json statistics_json(const Statistics& statistics)
{
    nlohmann::ordered_json out;
    for (const StatisticsField& f : statistics_fields()) out[f.name] = statistics.*f.value;
    return out;
}

nlohmann::ordered_json frame_json(const Frame& frame, const Stages& stages)
{
    const Timings& t = frame.timings;
    const scene::Needs& needs = frame.needs;
    return {{"device", frame.device},
            {"kernel", frame.kernel == KernelShape::packets ? "packets" : "pixels"},
            {"width", frame.picture.width},
            {"height", frame.picture.height},
            {"work_group", fmt::format("{}x{}", frame.group.width, frame.group.height)},
            {"tile", fmt::format("{}x{}", frame.tile.width, frame.tile.height)},
            {"launches", frame.launches},
            {"retries", frame.retries},
            {"capacities", {{"interior", needs.interior}, {"stack", needs.stack}, {"groups", needs.groups}}},
            {"seconds",
             {{"total", stages.total},
              {"read", stages.read},
              {"compile", stages.compile},
              {"devices", stages.devices},
              {"context", stages.context},
              {"build", t.build},
              {"first_launch", t.first_enqueue},
              {"upload", t.upload},
              {"trace", t.trace},
              {"write", t.rows + stages.write}}},
            {"trace_processor_seconds", t.trace_cpu},
            {"rays_per_second", rays_per_second(frame)},
            {"statistics", statistics_json(frame.statistics)}};
}

} // namespace clucida::host
