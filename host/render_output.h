/// Where `render` puts its picture, and what it tells of it.
#pragma once

#include "host/atomic_file.h"
#include "host/picture_writer.h"
#include "host/renderer.h"
#include "host/scene_source.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <optional>
#include <span>
#include <string>

namespace clucida::host {

struct Output {
    std::string file; ///< "-": standard output
    FileFormat format = FileFormat::png;
};

/// file is --output (empty: the scene's stem and .png, in the working folder), format_out is --format-out or empty.
/// @throws UsageError for an ending that means nothing, Failure for a place that cannot be written
Output choose_output(const std::string& file, const std::string& format_out, const std::string& stem);

/// The picture's file, growing while the picture is rendered; there or not at all.
class OutputStream {
public:
    /// @throws UsageError if the format cannot hold such a picture
    OutputStream(const Output& output, Shape size, const EncodeOptions& options);
    /// Rows from row y, as RenderHooks::rows tells them. @throws Failure
    void add(unsigned y, std::span<const float> rgb);
    /// After the last row. @throws Failure, Interrupted if `cancelled` says so last of all
    void commit(const std::function<bool()>& cancelled);

private:
    Output output_;
    Shape size_;
    EncodeOptions options_;
    std::optional<PendingFile> file_;
    std::optional<PictureWriter> writer_;
};

/// @throws Failure
void write_output(const Output& output, const std::string& bytes);

/// Seconds that a picture took beside those of Timings.
struct Stages {
    double read = 0;    ///< the scene's text
    double compile = 0; ///< the scene to buffers, photographs included
    double devices = 0; ///< asking OpenCL, which loads its implementations
    double context = 0;
    double write = 0; ///< the file, after the last launch
    double total = 0;
};

/// What took how long: a line.
std::string timing_line(const std::string& name, const Frame& frame, unsigned samples, const Stages& stages);

/// On standard error, unless quiet.
void tell_notes(std::span<const std::string> notes, bool quiet);

nlohmann::ordered_json statistics_json(const Statistics& statistics);

/// The frame's statistics, timings and capacities.
nlohmann::ordered_json frame_json(const Frame& frame, const Stages& stages);

} // namespace clucida::host
